#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "morph/alignment/options.h"
#include "morph/domain_map.h"
#include "morph/features/align.h"
#include "morph/interpolation/interpolation.h"
#include "morph/mesh/mesh.h"
#include "morph/report.h"

/// The door of the morph library: two meshes and options in, a Morph out.
///
///     using namespace automorph;
///     Morph m = morph(load_mesh("a.obj"), load_mesh("b.obj"));
///     for (double alpha : {0.0, 0.25, 0.5, 0.75, 1.0}) write_mesh(..., m.frame(alpha));
///
/// Everything expensive happens once, in morph(); a frame costs one pass over the vertices.
namespace automorph {

/// How the correspondence is found.
enum class Alignment {
    None,          ///< Section 3 alone: borders start at an arbitrary vertex, no registration
    Registration,  ///< Sections 4.1 and 4.2: EM-ICP, control vertices, direction
    Features,      ///< Sections 4.1 to 4.3: registration, then curvature features laid on one another
    Dense,         ///< beyond the paper: EM-ICP continued to a smooth non-rigid motion, borders that slide
};

/// What happens to openings (eyes, mouth) other than the border; they are filled for the maps.
enum class Openings {
    Reopen,  ///< merged triangles that lie in a filling of either shape are removed
    Fill,    ///< they stay
};

/// What both shapes are mapped onto.
enum class Domain {
    Auto,    ///< closed: the sphere; open: the disk, or the sphere where the disk map squeezes or flips
    Disk,    ///< Section 3; open shapes only
    Sphere,  ///< of open shapes, the border is locked on a circle of latitude
    Cut,     ///< Section 6: closed shapes are cut into two disks
};

struct MorphOptions {
    Alignment alignment = Alignment::Dense;
    Openings openings = Openings::Reopen;
    Domain domain = Domain::Auto;
    AlignOptions features = {};     ///< of Alignment::Features
    NonRigidOptions nonrigid = {};  ///< of Alignment::Dense
    bool lift = true;  ///< curved placement of merged vertices, Eq. (9)-(11); flat facets otherwise
    std::uint64_t seed = 1;
    std::function<void(const std::string& stage)> on_stage = {};  ///< told of each stage as it begins
    bool keep_maps = false;  ///< fills Morph::maps(); about a third of the memory of the morph itself
};

/// A mesh that is ready to be morphed, with the file's own vertex numbering kept.
struct InputMesh {
    Mesh mesh;
    std::vector<int> vertex_of_file;  ///< per vertex of the file: vertex of `mesh`, -1 if unused
    MeshReport report;
};

/// Reads, inspects and mends a file. @throws IoError, InvalidMesh
InputMesh load_mesh(const std::string& file);

/// Inspects and mends a mesh in memory. @throws InvalidMesh
InputMesh admit_mesh(const Mesh& mesh, const std::string& name = "mesh");

/// Two shapes with one connectivity.
class Morph {
public:
    const Triangles& triangles() const;  ///< #F x 3, the same for every frame
    Points frame(double alpha, Interpolation scheme = Interpolation::Slerp) const;  ///< #V x 3
    Mesh mesh(double alpha, Interpolation scheme = Interpolation::Slerp) const;     ///< frame and triangles

    /// What to add to the frame's area-weighted unit normals (and normalise again) for smooth shading, #V x
    /// 3: the ends then look as their own meshes do, not as the facets of the merged one.
    Points shading(double alpha, Interpolation scheme = Interpolation::Slerp) const;

    /// Where each vertex of the source file goes on the target's surface, in the target file's coordinates;
    /// rows of vertices that no triangle uses are NaN. #(file vertices of the source) x 3
    Points correspondence() const;

    /// The maps whose overlay the morph is: one pair, or one per half of shapes that were cut; empty unless
    /// MorphOptions::keep_maps.
    const std::vector<DomainMaps>& maps() const;

    const Endpoints& endpoints() const;
    const Report& report() const;

private:
    friend Morph morph(const InputMesh&, const InputMesh&, const MorphOptions&);
    Triangles triangles_;
    Endpoints ends_;
    Points correspondence_;
    std::vector<DomainMaps> maps_;
    Report report_;
};

/// Computes the morph of a pair. Open meshes (disks, further openings allowed) and closed ones; where one is
/// open and the other closed, the open one is capped for the map, and the cap opened again.
/// @throws InvalidMesh   the pair cannot be mapped onto the domain asked for
/// @throws SolverFailure a stage found no valid answer; the message names it
Morph morph(const InputMesh& source, const InputMesh& target, const MorphOptions& options = {});

}  // namespace automorph
