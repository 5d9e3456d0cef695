#include "render/figure/config_keys.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "render/figure/picture_keys.h"

namespace automorph::config {
namespace {

constexpr Range kPositive{1e-9, 1e12};

constexpr std::array kShapes{Named<MeshConfig::Shape>{"ellipsoid", MeshConfig::Shape::Ellipsoid},
                             Named<MeshConfig::Shape>{"star", MeshConfig::Shape::Star},
                             Named<MeshConfig::Shape>{"head", MeshConfig::Shape::Head}};

Section<MeshConfig::Turn> rotation_section() {
    using Turn = MeshConfig::Turn;
    Section<Turn> table;
    table.keys = {
        vector3("axis", &Turn::axis, kAny, "axis of the turn, of any length, through the origin"),
        value("degrees", &Turn::degrees, {-3600, 3600}, "angle, counter-clockwise seen against the axis"),
    };
    table.check = [](const Turn& turn, const YAML::Node& node, const Place& place) {
        if (turn.axis.norm() == 0)
            place.fail(mark_of(node, "axis"), place.at("axis") + ": found a vector of length 0");
    };
    return table;
}

void check_mesh(const MeshConfig& mesh, const YAML::Node& node, const Place& place) {
    const bool is_shape = mesh.shape != MeshConfig::Shape::None;
    if (mesh.file.empty() != is_shape) {
        place.fail(node.Mark(), fmt::format("{}: expected either 'file' or 'shape', found {}", place.path,
                                            is_shape ? "both" : "neither"));
    }
    if (!is_shape && node.IsMap()) {
        for (const char* name : {"triangles", "seed"}) {
            if (node[name]) {
                place.fail(mark_of(node, name), place.at(name) + " has a meaning only beside 'shape'");
            }
        }
    }
    if (is_shape && node["fit"]) {
        place.fail(mark_of(node, "fit"), place.at("fit") + " has a meaning only beside 'file'");
    }
    if (mesh.star.inner > mesh.star.outer) {
        place.fail(mark_of(node, "inner"), fmt::format("{}: found {}, expected at most 'outer', which is {}",
                                                       place.at("inner"), mesh.star.inner, mesh.star.outer));
    }
}

Key<MeshConfig> of_star(Key<StarParameters> inner) {
    return only_with("shape: star", of(&MeshConfig::star, inner));
}

Section<HeadParameters> proportions_section() {
    Section<HeadParameters> table;
    for (const HeadParameter& each : kHeadParameters) {
        table.keys.push_back(value(each.name, each.member, {each.least, each.most}, each.meaning));
    }
    return table;
}

/// A preset sets all proportions; those of the config come after it.
Key<MeshConfig> preset_key() {
    Key<MeshConfig> key =
        choice("preset", &MeshConfig::preset, kHeadPresets, "which average or type the head is");
    key.read = [read = key.read](MeshConfig& into, const YAML::Node& node, const Place& place) {
        read(into, node, place);
        into.proportions = head_parameters(into.preset);
    };
    return only_with("shape: head", key);
}

Section<MeshConfig> mesh_section() {
    using M = MeshConfig;
    using S = StarParameters;
    Section<M> table;
    table.keys = {
        path("file", &M::file, "mesh file (.off, .obj, .ply, .stl); `source: FILE` is short for it"),
        flag("fit", &M::fit,
             "first centres a file's mesh and scales it to unit size, since files come in any unit; false "
             "keeps "
             "its own coordinates"),
        choice("shape", &M::shape, kShapes, "a generated shape in place of a file"),
        only_with("shape: ellipsoid", vector3("semi_axes", &M::semi_axes, kPositive,
                                              "half the extent of the ellipsoid in x, y and z")),
        only_with("shape: ellipsoid", value("opening", &M::opening, {0, 0.9},
                                            "share of the ellipsoid's height along z that is cut off "
                                            "below; 0: closed")),
        of_star(value("arms", &S::arms, {3, 12}, "how many arms the star has, in its xy-plane")),
        of_star(value("outer", &S::outer, kPositive, "distance of the star's tips from its centre")),
        of_star(value("inner", &S::inner, kPositive, "distance of the star's valleys from its centre")),
        of_star(
            value("depth", &S::depth, kPositive, "half the thickness of the star at its centre, along z")),
        preset_key(),
        only_with("shape: head",
                  section("proportions", &M::proportions, proportions_section(),
                          "what differs from the preset; the defaults below are the neutral head's")),
        only_with("shape: head",
                  choice("crop", &M::crop, kHeadCrops,
                         "the whole head closed below, cut at the neck, or the face in front of "
                         "the ears")),
        value("triangles", &M::triangles, {64, 10'000'000}, "of the generated shape, about"),
        value("seed", &M::seed, kSeed, "another seed gives another tessellation of the same shape"),
        section("rotation", &M::rotation, rotation_section(), "turns the mesh, after scaling"),
        value("scale", &M::scale, kPositive, "scales the mesh about the origin"),
        vector3("translation", &M::translation, kAny, "moves the mesh, last"),
    };
    table.shorthand = "file";
    table.check = check_mesh;
    return table;
}

Section<NonRigidOptions> nonrigid_section() {
    using N = NonRigidOptions;
    constexpr Range kShare = {0, 1}, kFactor = {0, 1e6};
    Section<N> table;
    table.keys = {
        value("stiffness", &N::stiffness, {1e-6, 1e6},
              "factor on how much smoothness weighs against matches"),
        value("rounds", &N::rounds, {0, 1000}, "of matching on each of the six levels; 0: 3 or 4"),
        value("membrane", &N::membrane, kFactor, "smoothness: against stretching"),
        value("bending", &N::bending, kFactor, "smoothness: against bending"),
        value("border_bending", &N::border_bending, kFactor, "smoothness: against bends of the borders"),
        value("border", &N::border, kFactor, "weight of the pull of borders onto one another"),
        value("slide", &N::slide, kShare, "share of that pull which is not felt along the border"),
        value("plastic", &N::plastic, kShare, "how much of the motion so far becomes the shape at rest"),
        value("limbs", &N::limbs, kFactor,
              "pull of arms, legs, horns onto those of the other shape at the coarse levels; 0: none"),
        value("similarity_rounds", &N::similarity_rounds, {0, 1000},
              "of turning, shifting and scaling before anything bends"),
        value("coarse_levels", &N::coarse_levels, {0, 6},
              "so many of the levels, from the first, are fitted on meshes of 2500 vertices, the others on "
              "5000"),
        flag("normals", &N::normals, "matches heed normals"),
        flag("directional_trust", &N::directional_trust,
             "matches pull weakly along surfaces that look alike along them"),
    };
    return table;
}

Section<AlignOptions> features_section() {
    using A = AlignOptions;
    using F = FeatureOptions;
    using W = WarpOptions;
    Section<A> table;
    table.keys = {
        of(&A::matching,
           value("largest_gaussian", &F::largest_gaussian, {-1e9, 0},
                 "c: a candidate's Gaussian curvature lies below; free of scale, the sphere has "
                 "12.6")),
        of(&A::matching,
           value("radius", &F::radius, {0, 2},
                 "r: how far from a candidate its match may lie in the map, at mean density of points")),
        of(&A::matching, value("largest_difference", &F::largest_difference, {0, 1e12},
                               "m: curvatures of a match differ by less in sum")),
        of(&A::matching, choice("targets", &F::targets, kFeatureTargets,
                                "what a candidate may be matched with: any vertex, as in the paper, or "
                                "candidates only")),
        of(&A::matching, numbers("scales", &F::scales, {0, 1},
                                 "widths over which curvature is smoothed, relative to the root of the area; "
                                 "[0] is the paper's curvature as it comes")),
        value("rematches", &A::rematches, {0, 100},
              "how often features are matched again on the warped maps"),
        of(&A::warping,
           value("reach", &W::reach, {0, 2}, "d: how far a feature drags its neighbours at first")),
        of(&A::warping,
           value("shrink", &W::shrink, {0.01, 0.99}, "factor on d while features are not in place")),
    };
    return table;
}

Section<RowConfig> row_section() {
    using R = RowConfig;
    Section<R> table;
    table.keys = {
        required(text("label", &R::label, "what the sheet calls the row")),
        choice("alignment", &R::alignment, kAlignments,
               "how the maps are brought together: not at all (Section 3 alone), by EM-ICP (4.1, 4.2), by "
               "EM-ICP "
               "and curvature features (4.3), or by a dense non-rigid alignment"),
        choice("interpolation", &R::interpolation, kInterpolations,
               "how vertices move: Eq. (12), (13) or (14)"),
        choice("openings", &R::openings, kOpenings,
               "what happens to openings other than the border (eyes, mouth)"),
        choice("domain", &R::domain, kDomains,
               "what both shapes are mapped onto: the disk (Section 3) or the sphere; cut makes two disks of "
               "closed "
               "shapes (Section 6); auto takes the sphere for closed shapes and where the disk map squeezes "
               "open ones"),
        section("features", &R::features, features_section(), "of the alignment `features`"),
        section("nonrigid", &R::nonrigid, nonrigid_section(), "of the alignment `dense`"),
        flag("lift", &R::lift, "curved placement of merged vertices, Eq. (9)-(11); flat facets otherwise"),
    };
    return table;
}

/// Colours and markers follow a morph.
void check_morph_only(const FigureConfig& figure, const YAML::Node& node, const Place& place) {
    const PictureConfig& picture = figure.picture;
    const auto refuse = [&](const char* name, const std::string& why) {
        place.fail(mark_of(node["picture"], name), fmt::format("picture.{} {}", name, why));
    };
    if (figure.show != Show::Morph) {
        const char* why = "has a meaning only beside 'show: morph'";
        if (picture.color != ColorField::None) refuse("color", why);
        if (picture.markers.kind != MarkersConfig::Kind::None) refuse("markers", why);
    } else if (picture.markers.kind == MarkersConfig::Kind::Features) {
        const bool any = std::any_of(figure.rows.begin(), figure.rows.end(), [](const RowConfig& row) {
            return row.alignment == Alignment::Features;
        });
        if (!any) refuse("markers", "marks features, but no row has 'alignment: features'");
    }
}

Section<VideoConfig> video_section() {
    using V = VideoConfig;
    Section<V> table;
    table.keys = {
        value("frames", &V::frames, {0, 100000},
              "of each row's loop from the source to the target and back; 0: no videos of rows"),
        value("fps", &V::fps, {1, 240}, "frames per second"),
        value("size", &V::size, {16, 8192}, "longer side in pixels; the other follows from the cell's"),
        value("spp", &V::spp, {1, 65536}, "light paths per pixel"),
        value(
            "shutter", &V::shutter, {0, 1},
            "motion blur: share of the time between two frames during which the shutter is open, around the "
            "frame's moment; 0: none"),
        value("turntable", &V::turntable, {0, 100000},
              "frames of one turn about picture.up, on which a row morphs there and back; 0: no such video"),
        value("turntable_row", &V::turntable_row, {0, 100000},
              "which row turns, counting from 1; 0: the last"),
    };
    return table;
}

void check_figure(const FigureConfig& figure, const YAML::Node& node, const Place& place) {
    const char* shown = name_of(kShows, figure.show);
    const auto expect = [&](const char* name, bool wanted) {
        if (node[name] && !wanted)
            place.fail(mark_of(node, name),
                       fmt::format("'{}' has no meaning beside 'show: {}'", name, shown));
        if (!node[name] && wanted)
            place.fail(node.Mark(), fmt::format("'{}' is missing in the config", name));
    };
    const bool pair = figure.show != Show::Map && figure.show != Show::Shape && figure.show != Show::Looks;
    expect("target", pair);
    expect("looks", figure.show == Show::Looks);
    check_morph_only(figure, node, place);
    expect("rows", figure.show == Show::Morph || figure.show == Show::Features);
    if (figure.show != Show::Morph) expect("video", false);
    if (figure.video.turntable_row > static_cast<int>(figure.rows.size())) {
        place.fail(mark_of(node["video"], "turntable_row"),
                   fmt::format("video.turntable_row: found {}, expected at most the number of rows, {}",
                               figure.video.turntable_row, figure.rows.size()));
    }
    for (std::size_t i = 1; i < figure.alphas.size(); ++i) {
        if (figure.alphas[i] <= figure.alphas[i - 1]) {
            place.fail(node["alphas"][i].Mark(),
                       fmt::format("alphas[{}]: found {} after {}, expected ascending numbers", i,
                                   figure.alphas[i], figure.alphas[i - 1]));
        }
    }
}

/// A list of pictures that begin as the config's `picture`, which stands before them in the table.
template <class U>
Key<FigureConfig> pictured_list(const char* name, std::vector<U> FigureConfig::*member,
                                const Section<U>& table, const char* meaning) {
    Key<FigureConfig> key = list(name, member, table, meaning);
    key.read = [member, table, info = key.info](FigureConfig& into, const YAML::Node& node,
                                                const Place& place) {
        read_list(into.*member, node, table, info, place, U{"", into.picture});
    };
    return key;
}

Section<FigureConfig> make_figure_section() {
    using C = FigureConfig;
    Section<C> table;
    table.keys = {
        text("title", &C::title, "stands above the sheet"),
        choice(
            "show", &C::show, kShows,
            "what the cells show: frames of the morph; the source from several sides; the source and its "
            "map as a drawn triangulation; "
            "both borders with the vertices inserted; both shapes with their curvature features marked; the "
            "source in several materials under several lights"),
        required(
            section("source", &C::source, mesh_section(), "the mesh at alpha = 0: a file, or a mapping")),
        section("target", &C::target, mesh_section(),
                "the mesh at alpha = 1: a file, or a mapping; of all that shows two shapes"),
        list("rows", &C::rows, row_section(),
             "one morph each, top to bottom; of `show: morph` and `show: features`"),
        numbers("alphas", &C::alphas, {0, 1}, "the columns, ascending: 0 is the source, 1 the target"),
        only_with("show: shape",
                  numbers("turns", &C::turns, {-3600, 3600},
                          "the columns: degrees by which the shape is turned about picture.up")),
        value("seed", &C::seed, kSeed, "of the registration's samples and starts"),
        section("picture", &C::picture, picture_section(), "how every cell is pictured"),
        section("video", &C::video, video_section(),
                "the films, of `show: morph`; made by the program ffmpeg"),
        path(
            "extends", &C::extends,
            "another config whose keys this one takes over: mappings are merged key by key, lists and values "
            "replaced"),
        pictured_list("looks", &C::looks, look_section(),
                      "the columns of `show: looks`: materials; what is not said is that of `picture`"),
        only_with("show: looks", pictured_list("stages", &C::stages, stage_section(),
                                               "the rows: lights; what is not said is that of `picture`")),
        path("output", &C::output,
             "folder for the results; out/<config's name> in the working directory otherwise"),
    };
    table.check = check_figure;
    return table;
}

}  // namespace

const Section<FigureConfig>& figure_section() {
    static const Section<FigureConfig> table = make_figure_section();
    return table;
}

}  // namespace automorph::config
