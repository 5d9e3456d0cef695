#pragma once

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace automorph {

/// What was found in a mesh file and done to it.
struct MeshReport {
    std::string name;
    int vertices = 0, triangles = 0;  ///< as admitted
    int boundary_loops = 0;
    bool closed = false;
    std::vector<std::string> mended;  ///< one sentence per mending
};

struct RegistrationReport {
    bool used = false;
    std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< source -> target, row by row
    std::array<double, 3> translation{0, 0, 0};  ///< target = scale * rotation * source + translation
    double scale = 1.0;
    double sigma = 0.0, residual = 0.0, runner_up = 0.0;
    int iterations = 0;
    bool converged = false, confident = false;
};

/// Why the pose may be the wrong one: "another pose fits ...", with the residuals of both. Empty if
/// confident. Of poses that nearly tie the one that turns the source least is taken, so that the other's
/// residual may be the smaller one.
std::string doubt_about(const RegistrationReport& registration);

/// What the dense alignment did. Of an open and a closed shape it moves the open one, else the source.
struct AlignmentReport {
    bool used = false;
    double distance = 0.0;   ///< between matched points at its end, root mean square, in target box diagonals
    int flipped_before = 0;  ///< triangles of the moved shape that their places on the other turn over
    int moved = 0;           ///< vertices moved off their places to make the map one-to-one
    int rounds = 0;          ///< of that repair
    int limbs_source = 0, limbs_target = 0;  ///< arms, legs, horns, ... that were found
    std::vector<std::pair<int, int>>
        limb_matches;  ///< vertices of source and target: tips laid on one another
};

/// The border insertion of Sec. 4.2: vertices of the borders.
struct BorderReport {
    int source = 0, target = 0;  ///< of their own
    int shared = 0;              ///< of both
    int merged = 0;              ///< after the insertion; 0: there was none
};

/// Distortion of a map over the surface, factors >= 1 (parameterization/map_quality.h).
struct DistortionReport {
    double median = 1, p95 = 1, worst = 1;
};

/// One map onto the domain.
struct MapReport {
    std::string of;       ///< "source", "target", "source half 1", ...
    std::string weights;  ///< "cotangent", "mean value", "uniform"; "progressive embedding" (sphere), "dense
                          ///< alignment"
    std::string reason;   ///< why not the first choice; empty otherwise
    int flipped = 0;      ///< by the exact predicate; 0 always, or the morph fails
    double p01 = 0, smallest_ratio = 0, residual = 0;
    DistortionReport area, angle;
};

/// Curvature features of two maps, Sec. 4.3.
struct FeatureReport {
    /// Two vertices taken for the same feature; E of Sec. 4.3.
    struct Match {
        int source = 0, target = 0;
        double difference = 0;
    };
    std::vector<int> candidates_source, candidates_target;  ///< vertices of the shapes as admitted
    std::vector<Match> matches;
    int in_place = 0;                                ///< matched ones that the warp laid on one another
    int warps = 0;                                   ///< the first and those after matching again
    int rounds = 0;                                  ///< of the warps
    double distance_before = 0, distance_after = 0;  ///< mean over the matched, in the map (radius 1)
};

struct OverlayReport {
    int vertices_a = 0, vertices_b = 0, crossings = 0, coincident = 0;
    int snapped =
        0;  ///< vertices of the target moved onto one of the source within kSnap; part of `coincident`
    int on_edges = 0;
    int vertices = 0, triangles = 0;
    int zero_area_a = 0, zero_area_b = 0;  ///< merged triangles without area in 3D on either shape
    int turned_a = 0, turned_b = 0;  ///< those that face against the triangle of the shape they lie in, by
                                     ///< more than rounding
    int flattened_a = 0, flattened_b = 0;  ///< merged vertices left on flat facets to keep those from turning
};

/// What a frame looks like (frame_check.h).
struct FrameReport {
    double alpha = 0;
    int reversed = 0;                          ///< triangles that face against both ends
    int self_intersecting = 0;                 ///< triangles that pass through others
    bool self_intersecting_estimated = false;  ///< from a sample: too many lie about one another
    double area = 0,
           volume = 0;  ///< scene units; the volume of open shapes is that of the cone to their centre
    double area_ratio = 1, volume_ratio = 1;  ///< to what lies between the ends, lengths interpolated
    double smallest_angle = 0;                ///< degrees, of triangles with area
};

struct StageReport {
    std::string name;
    double seconds = 0;
    double peak_memory_mb = 0;  ///< of the process, at the end of the stage
};

/// How two maps onto the sphere were brought together; angles are weighted means over matched points,
/// radians.
struct SphereAlignmentReport {
    int matches = 0;  ///< pairs of surface points; 0: not aligned
    double before = 0, rotated = 0, after = 0;
};

/// Everything a morph says about itself. Serialised by report_json().
struct Report {
    MeshReport source, target;
    RegistrationReport registration;
    AlignmentReport alignment;
    BorderReport border;
    std::vector<MapReport> maps;
    std::vector<FeatureReport>
        features;  ///< one per pair of maps; empty unless they were aligned by features
    std::vector<OverlayReport> overlays;  ///< one, or one per half
    std::string domain;  ///< "disk", "cut into two disks", "sphere" or "sphere, border locked"
    SphereAlignmentReport sphere_alignment;
    bool target_reversed =
        false;  ///< the target's border ran the other way, Eq. (8): its triangles were turned
    int reopened_triangles = 0;      ///< merged triangles removed because they lie in filled openings
    std::vector<std::string> notes;  ///< what the user should know, one sentence each
    std::vector<StageReport> stages;
    std::function<void(const std::string& stage)> on_stage;  ///< while the morph is computed; empty later
    std::vector<FrameReport> frames;  ///< empty unless they were asked for: report_with_frames()
};

/// The report as indented JSON; the rotation is nine numbers row by row.
std::string report_json(const Report& report);

}  // namespace automorph
