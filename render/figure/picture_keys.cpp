#include "render/figure/picture_keys.h"

#include <Eigen/Geometry>

namespace automorph::config {
namespace {

constexpr Range kShare{0, 1};
constexpr Range kRadiance{0, 1e6};

Section<MaterialConfig> material_section() {
    using M = MaterialConfig;
    Section<M> table;
    table.keys = {
        value("metallic", &M::metallic, kShare, "share of metal, whose reflectance is the albedo"),
        value("roughness", &M::roughness, kShare, "of metal, glass and coat: 0 mirrors, 1 is dull"),
        value("specular", &M::specular, kShare,
              "weight of the clear coat over the diffuse body: 0 is plain diffuse, 1 plastic"),
        value("transmission", &M::transmission, kShare,
              "share of glass in what is not metal; the albedo tints it"),
        value("ior", &M::ior, {1, 4}, "refractive index of glass and coat"),
        vector3("emission", &M::emission, kRadiance, "linear radiance that the surface gives off by itself"),
    };
    return table;
}

void check_light(const LightConfig& light, const YAML::Node& node, const Place& place) {
    using Kind = LightConfig::Kind;
    if (light.kind == Kind::Sky && light.map.empty())
        place.fail(node.Mark(), place.at("map") + " is missing: 'kind: sky' needs a picture of the sky");
    if (light.rim > 0 && light.kind != Kind::Studio)
        place.fail(mark_of(node, "rim"), place.at("rim") + " has a meaning only beside 'kind: studio'");
    if (light.visible && light.kind == Kind::Studio)
        place.fail(mark_of(node, "visible"),
                   place.at("visible") + " has no meaning beside 'kind: studio', which has no sky to see");
}

Section<LightConfig> light_section() {
    using L = LightConfig;
    Section<L> table;
    table.keys = {
        choice("kind", &L::kind, kLights,
               "key and fill of a studio, the light of the figures; a sky between three colours; a picture "
               "of a sky. `light: gradient` is short for it"),
        value("strength", &L::strength, {0, 1e4}, "factor on all light"),
        value("rim", &L::rim, {0, 4},
              "strength of the studio's light from behind, relative to its key: outlines dark and shining "
              "materials"),
        only_with("kind: sky", path("map", &L::map,
                                    "latitude-longitude picture, EXR or HDR; its middle lies behind the "
                                    "shape, its upper edge in the direction `up`")),
        only_with("kind: sky", value("rotation", &L::rotation, {-3600, 3600},
                                     "turns the sky about `up`, degrees, counter-clockwise seen from above")),
        only_with("kind: gradient", vector3("zenith", &L::zenith, kRadiance, "linear radiance above")),
        only_with("kind: gradient",
                  vector3("horizon", &L::horizon, kRadiance, "linear radiance at eye level")),
        only_with("kind: gradient",
                  vector3("ground", &L::ground, kRadiance, "linear radiance below the horizon")),
        flag("visible", &L::visible, "the camera sees the sky in place of `background`"),
    };
    table.shorthand = "kind";
    table.check = check_light;
    return table;
}

Section<LensConfig> lens_section() {
    using L = LensConfig;
    Section<L> table;
    table.keys = {
        value("radius", &L::radius, {0, 0.5},
              "of a thin lens, relative to its distance from the middle of the shape; 0: all is sharp"),
        value("focus", &L::focus, {-1, 1},
              "what is sharp: -1 the nearest part of the shape, 0 its middle, 1 the farthest"),
    };
    return table;
}

Section<WireframeConfig> wireframe_section() {
    using W = WireframeConfig;
    Section<W> table;
    table.keys = {
        value("width", &W::width, {0, 100}, "of the triangles' drawn edges, pixels; 0: none are drawn"),
        vector3("color", &W::color, kShare, "of the edges, linear red, green, blue"),
    };
    table.shorthand = "width";
    return table;
}

Section<MarkersConfig> markers_section() {
    using M = MarkersConfig;
    Section<M> table;
    table.keys = {
        choice("kind", &M::kind, kMarkers,
               "on the source's curvature features that were matched (rows of `alignment: features`), or "
               "spread evenly over the source's vertices"),
        only_with("kind: spread", value("count", &M::count, {1, 500}, "how many spheres")),
        value("radius", &M::radius, {1e-4, 0.5}, "relative to half the diagonal of the frames' box"),
    };
    table.shorthand = "kind";
    return table;
}

Key<PictureConfig> albedo_key() {
    return vector3("albedo", &PictureConfig::albedo, kShare,
                   "base colour: diffuse reflectance, or that of metal; linear red, green, blue");
}
Key<PictureConfig> material_key() {
    return section("material", &PictureConfig::material, material_section(),
                   "beside the albedo, as in glTF and Blender's Principled BSDF; plain diffuse by default");
}
Key<PictureConfig> light_key() {
    return section("light", &PictureConfig::light, light_section(), "where the light comes from");
}
Key<PictureConfig> wireframe_key() {
    return section("wireframe", &PictureConfig::wireframe, wireframe_section(),
                   "edges of the triangles; `wireframe: 1.5` is short for its width");
}
Key<PictureConfig> background_key() {
    return vector3("background", &PictureConfig::background, kShare,
                   "linear red, green, blue; white merges with the sheet");
}
Key<PictureConfig> ground_key() {
    return choice("ground", &PictureConfig::ground, kGrounds,
                  "a floor below all frames: none (or false); one that shows their shadow only (or true); "
                  "paper in the colour of the background, in the studio rising behind the shape; the same "
                  "with squares");
}
Key<PictureConfig> normals_key() {
    return choice("normals", &PictureConfig::normals, kNormals,
                  "shading normals: interpolated, or one per triangle");
}

void check_picture(const PictureConfig& picture, const YAML::Node& node, const Place& place) {
    if (picture.view.norm() == 0)
        place.fail(mark_of(node, "view"), place.at("view") + ": found a vector of length 0");
    // A degree off the view direction is enough to say what is upwards.
    constexpr double kSineOfADegree = 0.017;
    if (picture.view.cross(picture.up).norm() <= kSineOfADegree * picture.view.norm() * picture.up.norm()) {
        place.fail(
            mark_of(node, node["up"] ? "up" : "view"),
            place.at("up") + ": found a vector parallel to 'view' or of length 0, expected one across it");
    }
}

void check_ground(const PictureConfig& picture, const YAML::Node& node, const Place& place) {
    if (picture.light.visible && picture.ground == render::Ground::Shadow) {
        place.fail(mark_of(node, node["ground"] ? "ground" : "light"),
                   place.at("ground") +
                       ": found shadow beside a visible sky, expected none, plain or checker: a shadow alone "
                       "needs an even background");
    }
}

/// A key of a look or a stage: what it leaves out is `picture`'s, not the table's default.
template <class T>
Key<T> inherited(Key<PictureConfig> inner) {
    inner.info.fallback.clear();
    return of(&T::picture, std::move(inner));
}

}  // namespace

Section<PictureConfig> picture_section() {
    using P = PictureConfig;
    Section<P> table;
    table.keys = {
        value("width", &P::width, {16, 16384}, "of one cell, pixels"),
        value("height", &P::height, {16, 16384}, "of one cell, pixels"),
        value("spp", &P::spp, {1, 65536}, "light paths per pixel; noise falls with its square root"),
        value("adaptive", &P::adaptive, kShare,
              "relative standard error, such as 0.01, at which a pixel has paths enough: `spp` are then the "
              "most it takes; 0: all take `spp`"),
        choice("filter", &P::filter, kFilters,
               "how a pixel weighs its surroundings: a window three pixels wide, or the pixel alone"),
        value("seed", &P::seed, kSeed, "of the light paths"),
        vector3("view", &P::view, kAny,
                "direction the camera looks in; the distance follows from the frames"),
        vector3("up", &P::up, kAny, "direction that is upwards in the picture"),
        value("fov", &P::fov, {1, 120}, "vertical field of view, degrees"),
        value("margin", &P::margin, {0, 0.9},
              "free border on each side of a cell, as a fraction of half the cell"),
        albedo_key(),
        material_key(),
        light_key(),
        section("lens", &P::lens, lens_section(), "blurs what is nearer or farther than the sharp plane"),
        wireframe_key(),
        background_key(),
        ground_key(),
        normals_key(),
        choice(
            "color", &P::color, kColorFields,
            "colours the frames of `show: morph` by a number per vertex, with a legend: the mean curvature "
            "of the frame; how far a vertex has travelled from the source, less the rigid motion of all; "
            "how much triangles are stretched or shrunk against the source"),
        section("markers", &P::markers, markers_section(),
                "small spheres that go along with `show: morph`; `markers: features` is short for the kind"),
        flag("denoise", &P::denoise, "smooths the noise away, for previews"),
        choice("curve", &P::curve, kToneCurves,
               "how radiance becomes PNG codes: the plain curve, clamped at white, or one whose highlights "
               "roll off"),
        choice("bits", &P::bits, kBits, "per channel of PNG files"),
    };
    table.check = [](const P& picture, const YAML::Node& node, const Place& place) {
        check_picture(picture, node, place);
        check_ground(picture, node, place);
    };
    return table;
}

Section<LookConfig> look_section() {
    using L = LookConfig;
    Section<L> table;
    table.keys = {
        required(text("label", &L::label, "what stands above the column")),
        inherited<L>(albedo_key()),
        inherited<L>(material_key()),
        inherited<L>(wireframe_key()),
        inherited<L>(normals_key()),
    };
    return table;
}

Section<StageConfig> stage_section() {
    using S = StageConfig;
    Section<S> table;
    table.keys = {
        required(text("label", &S::label, "what the sheet calls the row")),
        inherited<S>(light_key()),
        inherited<S>(background_key()),
        inherited<S>(ground_key()),
    };
    table.check = [](const S& stage, const YAML::Node& node, const Place& place) {
        check_ground(stage.picture, node, place);
    };
    return table;
}

}  // namespace automorph::config
