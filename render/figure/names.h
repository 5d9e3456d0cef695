#pragma once

#include <array>
#include <string_view>

#include "morph/morph.h"
#include "morph/shapes/head.h"
#include "render/figure/config.h"
#include "render/figure/quality.h"
#include "render/geometry/triangle_mesh.h"

/// What the values of options are called in configs, on the command line and in results.
namespace automorph {

template <class E>
struct Named {
    const char* name;
    E value;
};

inline constexpr std::array kAlignments{
    Named<Alignment>{"none", Alignment::None}, Named<Alignment>{"registration", Alignment::Registration},
    Named<Alignment>{"features", Alignment::Features}, Named<Alignment>{"dense", Alignment::Dense}};
inline constexpr std::array kInterpolations{Named<Interpolation>{"linear", Interpolation::Linear},
                                            Named<Interpolation>{"rigid-linear", Interpolation::RigidLinear},
                                            Named<Interpolation>{"slerp", Interpolation::Slerp}};
inline constexpr std::array kOpenings{Named<Openings>{"reopen", Openings::Reopen},
                                      Named<Openings>{"fill", Openings::Fill}};
inline constexpr std::array kDomains{Named<Domain>{"auto", Domain::Auto}, Named<Domain>{"disk", Domain::Disk},
                                     Named<Domain>{"sphere", Domain::Sphere},
                                     Named<Domain>{"cut", Domain::Cut}};
inline constexpr std::array kFeatureTargets{Named<FeatureTargets>{"vertices", FeatureTargets::Vertices},
                                            Named<FeatureTargets>{"candidates", FeatureTargets::Candidates}};
inline constexpr std::array kQualities{Named<Quality>{"draft", Quality::Draft},
                                       Named<Quality>{"normal", Quality::Normal},
                                       Named<Quality>{"final", Quality::Final}};
inline constexpr std::array kShows{
    Named<Show>{"morph", Show::Morph},       Named<Show>{"shape", Show::Shape},
    Named<Show>{"map", Show::Map},           Named<Show>{"borders", Show::Borders},
    Named<Show>{"features", Show::Features}, Named<Show>{"looks", Show::Looks}};
inline constexpr std::array kNormals{Named<render::Normals>{"smooth", render::Normals::Smooth},
                                     Named<render::Normals>{"flat", render::Normals::Flat}};
inline constexpr std::array kFilters{Named<render::Filter>{"blackman-harris", render::Filter::BlackmanHarris},
                                     Named<render::Filter>{"box", render::Filter::Box}};
inline constexpr std::array kGrounds{Named<render::Ground>{"none", render::Ground::None},
                                     Named<render::Ground>{"shadow", render::Ground::Shadow},
                                     Named<render::Ground>{"plain", render::Ground::Plain},
                                     Named<render::Ground>{"checker", render::Ground::Checker},
                                     Named<render::Ground>{"true", render::Ground::Shadow},
                                     Named<render::Ground>{"false", render::Ground::None}};
inline constexpr std::array kLights{Named<LightConfig::Kind>{"studio", LightConfig::Kind::Studio},
                                    Named<LightConfig::Kind>{"gradient", LightConfig::Kind::Gradient},
                                    Named<LightConfig::Kind>{"sky", LightConfig::Kind::Sky}};
inline constexpr std::array kToneCurves{Named<render::ToneCurve>{"srgb", render::ToneCurve::Srgb},
                                        Named<render::ToneCurve>{"filmic", render::ToneCurve::Filmic}};
inline constexpr std::array kColorFields{Named<ColorField>{"none", ColorField::None},
                                         Named<ColorField>{"curvature", ColorField::Curvature},
                                         Named<ColorField>{"displacement", ColorField::Displacement},
                                         Named<ColorField>{"distortion", ColorField::Distortion}};
inline constexpr std::array kMarkers{Named<MarkersConfig::Kind>{"none", MarkersConfig::Kind::None},
                                     Named<MarkersConfig::Kind>{"features", MarkersConfig::Kind::Features},
                                     Named<MarkersConfig::Kind>{"spread", MarkersConfig::Kind::Spread}};
inline constexpr std::array kBits{Named<int>{"8", 8}, Named<int>{"16", 16}};

inline constexpr std::array kHeadPresets{
    Named<HeadPreset>{"neutral", HeadPreset::Neutral},      Named<HeadPreset>{"asian", HeadPreset::Asian},
    Named<HeadPreset>{"caucasian", HeadPreset::Caucasian},  Named<HeadPreset>{"narrow", HeadPreset::Narrow},
    Named<HeadPreset>{"broad", HeadPreset::Broad},          Named<HeadPreset>{"child", HeadPreset::Child},
    Named<HeadPreset>{"caricature", HeadPreset::Caricature}};
inline constexpr std::array kHeadCrops{Named<HeadCrop>{"closed", HeadCrop::Closed},
                                       Named<HeadCrop>{"head", HeadCrop::Head},
                                       Named<HeadCrop>{"face", HeadCrop::Face}};

/// Name of a value. @pre the value is in the list
template <class E, std::size_t N>
const char* name_of(const std::array<Named<E>, N>& names, E value) {
    for (const Named<E>& each : names) {
        if (each.value == value) return each.name;
    }
    return "";
}

}  // namespace automorph
