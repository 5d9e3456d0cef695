#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "morph/interpolation/interpolation.h"
#include "morph/morph.h"
#include "morph/shapes/head.h"
#include "morph/shapes/shapes.h"
#include "render/film/filter.h"
#include "render/geometry/triangle_mesh.h"
#include "render/image/image_file.h"
#include "render/studio/studio.h"

/// What a figure is made of, read from a YAML file. The keys of the file, their types, defaults and meaning
/// are one table (config_keys.cpp); `automorph config --explain` prints it.
namespace automorph {

/// Either a mesh file or a generated shape, placed in the world by y = scale * rotation * x + translation,
/// where x is the shape, or the file's mesh after `fit`.
struct MeshConfig {
    enum class Shape { None, Ellipsoid, Star, Head };
    struct Turn {
        Eigen::Vector3d axis{0, 0, 1};  ///< any length > 0
        double degrees = 0;             ///< counter-clockwise seen against the axis
    };

    std::filesystem::path file;  ///< absolute or relative to the working directory; empty for a shape
    bool fit = true;  ///< of a file: centre of mass to the origin, root mean square distance of the surface
                      ///< from it to 1
    Shape shape = Shape::None;
    Eigen::Vector3d semi_axes{1, 1, 1};  ///< of the ellipsoid
    double opening = 0;                  ///< of the ellipsoid: share of its height cut off below
    StarParameters star;
    HeadPreset preset = HeadPreset::Neutral;  ///< of the head
    HeadParameters proportions;               ///< of the head: the preset's with the config's changes
    HeadCrop crop = HeadCrop::Closed;         ///< of the head
    int triangles = 8000;                     ///< of the shape, about
    std::uint64_t seed = 1;                   ///< of the shape's tessellation
    Turn rotation;
    double scale = 1;
    Eigen::Vector3d translation{0, 0, 0};
};

/// One row of the figure: how the morph is made and how it moves.
struct RowConfig {
    std::string label;
    Alignment alignment = Alignment::Registration;
    Interpolation interpolation = Interpolation::Slerp;
    Openings openings = Openings::Reopen;
    Domain domain = Domain::Auto;
    AlignOptions features = {};     ///< of the alignment by curvature features
    NonRigidOptions nonrigid = {};  ///< of the dense alignment
    bool lift = true;

    /// What the row says of its morph. @param seed  of the registration
    MorphOptions morph_options(std::uint64_t seed) const {
        MorphOptions options;
        options.alignment = alignment;
        options.openings = openings;
        options.domain = domain;
        options.features = features;
        options.nonrigid = nonrigid;
        options.lift = lift;
        options.seed = seed;
        return options;
    }
};

/// What a surface is made of beside its base colour, in the words of glTF 2.0 and of Blender's Principled
/// BSDF; render/README.md has the mapping. The default is plain diffuse.
struct MaterialConfig {
    double metallic = 0, roughness = 0.5, specular = 0, transmission = 0, ior = 1.5;
    Eigen::Vector3d emission{0, 0, 0};  ///< radiance, linear RGB
};

/// Where the light comes from.
struct LightConfig {
    enum class Kind {
        Studio,    ///< key, fill and an even sky
        Gradient,  ///< a sky between three colours
        Sky        ///< a latitude-longitude picture
    };
    Kind kind = Kind::Studio;
    double strength = 1;                       ///< factor on all light
    double rim = 0;                            ///< of Studio: light from behind, relative to the key
    std::filesystem::path map;                 ///< of Sky: EXR or HDR
    double rotation = 0;                       ///< of Sky: degrees about PictureConfig::up, to the left
    Eigen::Vector3d zenith{0.75, 0.85, 1.1};   ///< of Gradient: linear radiance
    Eigen::Vector3d horizon{0.9, 0.88, 0.85};  ///< likewise
    Eigen::Vector3d ground{0.3, 0.28, 0.25};   ///< likewise, below the horizon
    bool visible = false;                      ///< the camera sees the sky in place of the background
};

/// A thin lens, in proportion to the scene, so that it holds for any mesh.
struct LensConfig {
    double radius = 0;  ///< relative to the distance of the middle of the frames' box; 0: a pinhole
    double focus = 0;  ///< the sharp plane: 0 through that middle, -1 one radius of the box nearer, 1 farther
};

struct WireframeConfig {
    double width = 0;  ///< of the drawn edges, pixels of a cell of the config's width; 0: none
    Eigen::Vector3d color{0.02, 0.02, 0.02};
};

/// What the colours of a morph's frames tell.
enum class ColorField {
    None,          ///< nothing: the albedo
    Curvature,     ///< mean curvature of the frame
    Displacement,  ///< how far each vertex has travelled from the source
    Distortion     ///< how far triangles are stretched or shrunk against the source
};

/// Small spheres on the surface that go along with the morph.
struct MarkersConfig {
    enum class Kind {
        None,
        Features,  ///< on the source's curvature features that were matched
        Spread     ///< on vertices of the source, as far from one another as can be
    };
    Kind kind = Kind::None;
    int count = 24;         ///< of Spread
    double radius = 0.015;  ///< relative to half the diagonal of the frames' box
};

/// How every cell is pictured; all cells of a figure share one camera.
struct PictureConfig {
    int width = 480, height = 480;  ///< of one cell, pixels
    int spp = 64;                   ///< paths per pixel
    double adaptive = 0;            ///< standard error at which a pixel has paths enough; 0: none
    render::Filter filter = render::Filter::BlackmanHarris;
    std::uint64_t seed = 1;                    ///< of the samples
    Eigen::Vector3d view{0, 1, -0.25};         ///< direction the camera looks in, world frame
    Eigen::Vector3d up{0, 0, 1};               ///< upwards in the picture, world frame
    double fov = 20;                           ///< vertical field of view, degrees
    double margin = 0.06;                      ///< free on each side, fraction of half the picture
    Eigen::Vector3d albedo{0.72, 0.69, 0.64};  ///< base colour: diffuse reflectance, linear RGB
    MaterialConfig material;
    LightConfig light;
    LensConfig lens;
    WireframeConfig wireframe;
    Eigen::Vector3d background{1, 1, 1};  ///< linear RGB; white merges with the sheet's paper
    render::Ground ground = render::Ground::Shadow;
    render::Normals normals = render::Normals::Smooth;
    ColorField color = ColorField::None;
    MarkersConfig markers;
    bool denoise = false;                               ///< for previews
    render::ToneCurve curve = render::ToneCurve::Srgb;  ///< of the PNG files; EXR are linear
    int bits = 8;                                       ///< per channel of the PNG files

    /// Whether cells end in the background, so that they may merge with one another and with the paper.
    bool ends_in_background() const {
        return !light.visible && (ground == render::Ground::None || ground == render::Ground::Shadow);
    }
};

/// One column of Show::Looks: what the shape is made of.
struct LookConfig {
    std::string label;
    PictureConfig picture;  ///< albedo, material, wireframe and normals count
};

/// One row of Show::Looks: where the shape stands.
struct StageConfig {
    std::string label;
    PictureConfig picture;  ///< light, ground and background count
};

/// The films of a figure that shows morphs. They cost by frames x size^2 x spp; the defaults, about as much
/// as the cells.
struct VideoConfig {
    int frames = 48;        ///< of each row's loop from the source to the target and back; 0: none
    double fps = 16;        ///< frames per second
    int size = 320;         ///< longer side, pixels; the other follows from the cell's
    int spp = 24;           ///< paths per pixel
    double shutter = 0;     ///< share of the time between two frames during which the shutter is open
    int turntable = 48;     ///< frames of one turn about picture.up, morphing there and back; 0: none
    int turntable_row = 0;  ///< from 1; 0: the last
};

/// What the cells of a figure show.
enum class Show {
    Morph,     ///< frames
    Shape,     ///< the source from several sides
    Map,       ///< the source, and its map onto the disk or the sphere as a drawn triangulation
    Borders,   ///< the border insertion: both borders with each other's vertices
    Features,  ///< both shapes with their curvature features marked
    Looks,     ///< the source in several materials, under several lights
};

/// A file that a config is made of.
struct ConfigText {
    std::filesystem::path file;
    std::string text;  ///< word for word
};

struct FigureConfig {
    std::filesystem::path file;          ///< the config itself
    std::string text;                    ///< its text, word for word
    std::filesystem::path extends;       ///< the config whose keys it takes over; empty: none
    std::vector<ConfigText> bases;       ///< that config, the one it extends itself, and so on
    std::vector<std::string> overrides;  ///< KEY=VALUE, in the order they were applied
    std::string title;
    Show show = Show::Morph;
    MeshConfig source, target;
    std::vector<RowConfig> rows;
    std::vector<double> alphas{0, 0.25, 0.5, 0.75, 1};
    std::vector<double> turns{0, 45, 90};  ///< of Show::Shape: degrees about picture.up, one per cell
    std::uint64_t seed = 1;                ///< of the registration
    PictureConfig picture;
    VideoConfig video;
    std::vector<LookConfig> looks;    ///< of Show::Looks: the columns
    std::vector<StageConfig> stages;  ///< likewise: the rows
    std::filesystem::path output;     ///< folder for the pictures
};

/// Reads and checks a config. Relative paths in it are relative to the folder of the file they stand in; the
/// default output, out/<name of the config>, is relative to the working directory.
///
/// `extends: other.yaml` takes over the keys of another config: mappings are merged key by key, everything
/// else, lists too, is replaced.
/// @param overrides  KEY=VALUE with a key's path, e.g. "picture.spp=16", "rows[0].domain=disk" (from 0), and
/// any YAML
///                   value; paths in them are relative to the working directory
/// @throws ConfigError `file:line:column: what was found, what is allowed`
/// @param file  "-": standard input, as a file "stdin" in the working directory
/// @throws IoError     the file cannot be read
FigureConfig load_config(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// The same from text; `file` is what errors call it and the base of relative paths.
FigureConfig parse_config(const std::string& text, const std::filesystem::path& file,
                          const std::vector<std::string>& overrides = {});

/// FNV-1a of 64 bits over the config's text, the texts it extends and the overrides: "fnv1a64:" and 16
/// digits.
std::string config_hash(const FigureConfig& config);

/// One key of the schema, for `config --explain` and editors.
struct ConfigKey {
    enum class Type { Text, Path, Integer, Number, Boolean, Choice, Numbers, Section, List };

    std::string path;  ///< e.g. "picture.spp", "rows[].label"
    Type type = Type::Text;
    std::optional<double> least, most;  ///< inclusive range of numbers
    int count = 0;                      ///< Numbers: how many; 0 any number >= 1
    std::vector<std::string> choices;
    bool required = false;
    std::string fallback;   ///< default, as YAML; empty if required or unset
    std::string only_with;  ///< e.g. "shape: star"; empty: always allowed
    std::string shorthand;  ///< Section: the key whose value may stand in place of the mapping; empty: none
    std::string meaning;
};

/// Every key a config may hold, in the order of the documentation.
std::vector<ConfigKey> config_keys();

/// The keys as text for a terminal.
std::string explain_config();

/// The keys as a JSON Schema (draft 7), by which editors complete and check configs.
std::string config_schema();

/// What a key takes, e.g. "an integer from 1 to 65536", "one of linear, rigid-linear, slerp".
std::string allowed_values(const ConfigKey& key);

}  // namespace automorph
