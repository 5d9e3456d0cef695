#include "render/program/help_topics.h"

#include <fmt/format.h>

namespace automorph::program {
namespace {

constexpr HelpTopic kGettingStarted{"getting-started", "First steps",
                                    R"(Look whether your meshes can be morphed, and what would be mended:

    automorph info a.obj b.obj

Morph the first into the second. For Blender, three.js or a viewer, as one
animated file; for anything else, as numbered meshes:

    automorph morph a.obj b.obj --out m.glb
    automorph morph a.obj b.obj --out m_.ply --frames 25

No points have to be marked, and the meshes may differ in place, pose, size
and number of triangles. What was found and done is printed; read the lines
"note" and "registration": where it says UNSURE, look at the first frames.
'automorph help summary' explains them all.

Without meshes at hand, make some:

    automorph shape head a.ply --preset asian --crop face
    automorph shape head b.ply --preset broad --crop face
    automorph morph a.ply b.ply --out m.glb

Videos of a shape turning, or of the morph meanwhile:

    automorph turntable a.ply --out turn.mp4
    automorph turntable a.ply b.ply --out ab.mp4

Rendered rows and sheets of cells come from a config:

    automorph figure my.yaml
)"};

constexpr HelpTopic kMeshes{"meshes", "Which meshes can be morphed",
                            R"(Read are .off, .obj, .ply and .stl, text and binary. Of colours, textures and
normals nothing is used.

A mesh must be one surface without handles (genus 0): closed like a ball, or
open with one border and any number of further openings (eyes, mouth). The
longest loop is the border; other openings are filled for the maps and opened
again, or stay filled with --openings fill.

Mended, and said so: vertices that appear several times (as in every .stl),
polygons, triangles without corners of their own, triangles that face the
other way, unused vertices, a few stray triangles beside the shape.

Refused, with what was found, where, and what to do: handles, edges of three
or more triangles, several large parts, no triangles, no area.

'automorph info MESH' tells all that of a file; with --json for scripts; its
status is 1 if a mesh cannot be morphed.

What corresponds to what is found from shape alone. Two shapes of one kind
(two faces, two bottles) make the best pairs.
)"};

constexpr HelpTopic kConfigs{"configs", "Configs of figures",
                             R"(A figure is described by a YAML file:

    source: a.obj
    target: b.obj
    rows:
      - {label: plain, alignment: none, interpolation: linear}
      - {label: dense, alignment: dense}
    alphas: [0, 1/4, 1/2, 3/4, 1]
    picture: {width: 400, height: 400, spp: 64}

Paths are relative to the config. A key that does not exist, a wrong type or
a value out of range is refused with file:line:column and what is allowed.

    automorph config --explain      every key: type, default, meaning
    automorph config my.yaml        checks without rendering

Copy configs/pair.yaml to begin with; the Debian package has it, and the
configs of the paper's figures, in /usr/share/automorph/configs.

A mesh that stands otherwise than the other is turned by its own key:

    source: {file: a.obj, rotation: {axis: [1, 0, 0], degrees: 90}}
)"};

constexpr HelpTopic kFigures{"figures", "Rendered figures",
                             R"(    automorph figure my.yaml                        into out/my
    automorph figure my.yaml --out results
    automorph figure my.yaml --quality draft        a quick look
    automorph figure my.yaml --dry-run              what, and how long

Open index.html in the folder: a page with all rows, a slider through the
morph, videos and measurements, which needs no network. Beside it lie sheet.png
for print, every cell as EXR (linear; with --layers normals, depth and more)
and PNG, videos of each row and of one turning, if ffmpeg is installed, and
metrics.json with what the morph found, used and measured. The same config and
seed give the same pixels, whatever the number of threads.

picture.spp is the number of light paths per pixel: noise halves with four
times as many; picture.adaptive, e.g. 0.02, ends pixels that are good enough
before. picture.up is the direction that points up, z unless said
otherwise; scans of faces often have y, and are seen from the front with

    picture: {up: [0, 1, 0], view: [0, 0, -1]}
)"};

constexpr HelpTopic kOutputFiles{"output-files", "What 'automorph morph' writes",
                                 R"(--out m.glb is one file of glTF 2.0 with the merged mesh, the target as a
morph target, and an animation of --seconds (with --ping-pong, there and back).
The rigid part of the morph is the turn and move of a node, the rest the weight
of the morph target: exactly the frames that --out m_.ply would write, at any
time. --up says which axis of your meshes points up: y, as in most scans and in
glTF itself, or z.

--out m_.ply (.off, .obj, .stl) gives --frames numbered meshes, the first equal
to the source, the last to the target, all with the same triangles: the
vertices and edges of both shapes, and their crossings. Coordinates are those of
the mesh files. .stl has single precision, the others keep every digit.

--correspondence c.csv has a header x,y,z and then one line per vertex of the
source file, in the file's own order: where it goes on the target's surface, in
the coordinates of the target's file. Line i + 2 is vertex i (from 0), whatever
was mended: vertices that were merged have the same line, a vertex that no
triangle uses or whose triangles were dropped as stray has nan,nan,nan.

--report r.json has all that was found, used and measured.

Folders that are missing are made. Every file is written aside and renamed:
none is ever half there.
)"};

constexpr HelpTopic kSummary{"summary", "What the lines that 'automorph morph' prints mean",
                             R"(source, target   the meshes as read, and what was mended in them
registration     the turn, scale and move that lays the source onto the target.
                 The residual is the distance left between the surfaces, in
                 parts of the target's radius. UNSURE: another pose fits nearly
                 as well, and may be the right one; look at the first frames.
domain           what both shapes were laid out on: a disk, a sphere, a sphere
                 with the open shapes' borders locked, or two disks after a cut
border           vertices of the two borders, and those of both together
map              how a shape was laid out: "cotangent" (harmonic), "mean value"
                 and "uniform" are weights of disk maps, "progressive embedding"
                 is the sphere's, "dense alignment" was then moved so that
                 corresponding places meet. 0 flipped: the map is one-to-one.
                 Places shrunk a hundred times (horns, fingers) correspond only
                 roughly.
features         only with --alignment features: points of high curvature found,
                 taken for the same, and brought to one place
overlay          the merged mesh: the vertices of both, and where their edges
                 cross
openings         triangles that filled eyes, mouth and so on, taken out again
note             what you should know
time             in all and of each step, and the most memory used
written          the files

--report r.json has the same and more as numbers.
)"};

constexpr HelpTopic kBlender{"blender", "A morph in Blender, three.js and viewers",
                             R"(    automorph morph a.obj b.obj --out m.glb

Blender: File > Import > glTF 2.0, then play. The animation takes 48 frames at
24 per second (--seconds 2). Shapes stand upright; with --up z, world
coordinates are those of your mesh files. The shape key "target" is the morph,
the object's rotation and location its rigid part. Vertices that no triangle
uses are left out by Blender.

Debian's Blender reads glTF files with the package python3-numpy only.
Debian 12's Blender 3.4 stops with "module 'numpy' has no attribute 'bool'" on
any glTF file with normals. In the import dialog, set Shading to Smooth Shading;
in a script, import_scene.gltf(filepath=..., import_shading='SMOOTH').

three.js: GLTFLoader, then an AnimationMixer plays gltf.animations[0].

Windows' 3D Viewer and most others: open the file, the animation plays.
)"};

constexpr HelpTopic kTroubleshooting{
    "troubleshooting", "When something goes wrong",
    R"("cannot be morphed": the message says what to do, see 'automorph help meshes'.
In most programs for meshes: "merge by distance", "fill holes", "make manifold",
"delete loose".

The shape turns the wrong way, or front meets back: the registration found
another pose; the summary then says UNSURE. Turn one mesh roughly as the other
in any program and try again, or try --seed 2.

Features miss each other: --alignment dense (the default) is best on most pairs;
--alignment features is the paper's own.

Frames crumple on the way: pairs that differ much may do so. The report
(--report r.json) counts triangles that turn over or pass through others.

A plane that halves both closed shapes is missing: only --domain cut needs one.

It is slow: half a million triangles take minutes. Decimate first.

"the font is missing": install fonts-dejavu-core, or set AUTOMORPH_FONT to a
TrueType file.
)"};

}  // namespace

const std::vector<HelpTopic>& help_topics() {
    static const std::vector<HelpTopic> topics{kGettingStarted, kMeshes,  kConfigs, kFigures,
                                               kOutputFiles,    kSummary, kBlender, kTroubleshooting};
    return topics;
}

std::string list_of_topics() {
    std::string text = "'automorph help TOPIC' tells about:\n";
    for (const HelpTopic& topic : help_topics())
        text += fmt::format("  {:<16} {}\n", topic.name, topic.title);
    return text + "and 'automorph help COMMAND' about a command's options.\n";
}

}  // namespace automorph::program
