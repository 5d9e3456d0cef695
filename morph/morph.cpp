#include "morph/morph.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "morph/align_disks.h"
#include "morph/alignment/border_places.h"
#include "morph/alignment/guide.h"
#include "morph/cut/cut.h"
#include "morph/follow.h"
#include "morph/halves.h"
#include "morph/merge_disks.h"
#include "morph/merge_spheres.h"
#include "morph/mesh/admit.h"
#include "morph/mesh/connectivity.h"
#include "morph/mesh/errors.h"
#include "morph/mesh/geometry.h"
#include "morph/open_pair.h"
#include "morph/overlay/lift.h"
#include "morph/parameterization/map_quality.h"
#include "morph/registration/registration.h"
#include "morph/report_of.h"
#include "morph/shading.h"
#include "morph/stage_clock.h"

namespace automorph {

namespace {

InputMesh input_mesh(const PolygonSoup& soup, const std::string& name) {
    AdmittedMesh admitted = admit(soup, name);
    InputMesh input;
    input.report = {.name = name,
                    .vertices = admitted.mesh.vertex_count(),
                    .triangles = admitted.mesh.triangle_count(),
                    .boundary_loops = admitted.admitted.boundary_loops,
                    .closed = admitted.admitted.closed,
                    .mended = std::move(admitted.mended)};
    input.mesh = std::move(admitted.mesh);
    input.vertex_of_file = std::move(admitted.vertex_of_file);
    return input;
}

/// Computes one morph; the members are what its steps hand on.
class Computation {
public:
    Computation(const InputMesh& source, const InputMesh& target, const MorphOptions& options, Report& report)
        : source_(source), target_(target), options_(options), report_(report) {
        report_.source = source.report;
        report_.target = target.report;
        report_.registration = report_of(registration_, false);
    }

    void run() {
        require_domain();
        if (registers()) register_shapes();
        if (!source_.report.closed && !target_.report.closed) {
            merge_open();
        } else if (options_.domain == Domain::Cut) {
            merge_cut();
        } else {
            merge_on_sphere();
        }
        place_ends();
    }

    Triangles triangles;
    Endpoints ends;
    Points correspondence;
    std::vector<DomainMaps> maps;  ///< if they are kept

private:
    bool registers() const { return options_.alignment != Alignment::None; }

    void require_domain() const {
        const bool a = source_.report.closed, b = target_.report.closed;
        const bool fits = options_.domain == Domain::Disk  ? !a && !b
                          : options_.domain == Domain::Cut ? a && b
                                                           : true;
        if (fits) return;
        const bool disk = options_.domain == Domain::Disk;
        throw InvalidMesh(
            fmt::format("{} is {} and {} is {}: the domain '{}' is for two {} shapes; choose auto or sphere",
                        source_.report.name, a ? "closed" : "open", target_.report.name,
                        b ? "closed" : "open", disk ? "disk" : "cut", disk ? "open" : "closed"));
    }

    /// Sec. 4.1.
    void register_shapes() {
        const StageClock clock(report_, "registration");
        registration_ = register_rigid(source_.mesh, target_.mesh, {.seed = options_.seed});
        report_.registration = report_of(registration_, true);
        if (!registration_.confident) {
            report_.notes.push_back(fmt::format("the registration is unsure: {}; look at the first frames",
                                                doubt_about(report_.registration)));
        }
    }

    /// Sec. 4.2: the longest loop is the border; further openings are filled for the map.
    void merge_open() {
        OpenPair pair = make_pair();
        source_shape_ = std::move(pair.source.shape);
        target_shape_ = std::move(pair.target.shape);
        const Disk a = whole(source_shape_, pair.source.loops[0]),
                   b = whole(target_shape_, pair.target.loops[0]);
        align_shapes({source_.mesh, pair.source.loops, pair.source.centres},
                     {pair.target_mesh, pair.target.loops, pair.target.centres},
                     registration_.apply(source_.mesh.V), &pair.border);
        report_.border = report_of(pair.border);
        BorderedDisks disks = border_disks(a, b, pair.border);
        if (onto_disk(disks)) {
            report_.domain = "disk";
            align_features(disks, "");
            if (guide_ && follow_on_disk(*guide_, disks.a, target_shape_, disks.b, report_)) {
                report_.maps.front() =
                    report_of("source", "dense alignment", map_quality(disks.a.mesh, disks.a.rays));
            }
            merged_ = merge_maps(source_shape_, disks.a, target_shape_, std::move(disks.b), options_.lift, "",
                                 report_);
        } else {
            report_.domain = "sphere, border locked";
            tell_of_unused_features();
            merged_ = merge_locked_spheres(source_shape_, target_shape_, disks, sphere_options(), report_);
        }
        open_fillings();
    }

    OpenPair make_pair() {
        const StageClock clock(report_, "border");
        OpenPair pair = open_pair(source_.mesh, target_.mesh, registers() ? &registration_ : nullptr);
        if (pair.target_reversed) {
            report_.target_reversed = true;
            report_.notes.push_back(
                "the target's border runs the other way round (Eq. 8): its triangles were turned");
        }
        return pair;
    }

    /// The dense alignment, if asked for; it places the source's border, if there is one, on the target's.
    /// @param start  the source's vertices in the target's frame
    void align_shapes(const AlignedShape& source, const AlignedShape& target, const Points& start,
                      BorderUnion* border) {
        if (options_.alignment != Alignment::Dense) return;
        const StageClock clock(report_, "alignment");
        try {
            guide_ = align(source, start, target, options_.nonrigid);
        } catch (const SolverFailure& failure) {
            report_.notes.push_back(fmt::format("the alignment was given up ({})", failure.what()));
            return;
        }
        report_.alignment.distance = guide_->distance;
        report_.alignment.limbs_source = guide_->source_limbs;
        report_.alignment.limbs_target = guide_->target_limbs;
        report_.alignment.limb_matches = guide_->matched_tips;
        if (target_moves()) {  // source and target here are of the alignment
            std::swap(report_.alignment.limbs_source, report_.alignment.limbs_target);
            for (auto& [a, b] : report_.alignment.limb_matches) std::swap(a, b);
        }
        if (!border) return;
        auto aligned = aligned_border(guide_->x(source.loops[0], Eigen::all),
                                      target.mesh.V(target.loops[0], Eigen::all));
        if (aligned) {
            *border = std::move(*aligned);
        } else {
            guide_.reset();
            report_.notes.push_back(
                "the alignment was given up: the source's border does not run once around "
                "the target's");
        }
    }

    /// Sec. 4.3, if asked for.
    void align_features(BorderedDisks& disks, const std::string& label) {
        if (options_.alignment != Alignment::Features) return;
        const std::vector<char> filling_a = filling_triangles(source_shape_, disks.a),
                                filling_b = filling_triangles(target_shape_, disks.b);
        align_disks({disks.a, filling_a}, {disks.b, filling_b}, options_.features, label, report_);
    }

    /// Maps an open pair onto the disk if it is to go there. False: onto the sphere.
    bool onto_disk(BorderedDisks& disks) {
        if (options_.domain == Domain::Sphere) return false;
        if (options_.domain == Domain::Disk) {
            map_onto_disk(disks, "", report_);
            return true;
        }
        const std::string reason = try_harmonic_disk(disks, report_);
        if (reason.empty()) return true;
        report_.notes.push_back("mapped onto the sphere with the border locked: " + reason);
        return false;
    }

    void tell_of_unused_features() {
        if (options_.alignment == Alignment::Features) {
            report_.notes.push_back(
                "curvature features are laid on one another on the disk only; on the sphere "
                "registered places are (choose the domain disk or cut)");
        }
    }

    /// An open shape has its place on a closed one, but not the other way round.
    bool target_moves() const { return source_.report.closed && !target_.report.closed; }

    SphereOptions sphere_options() const {
        return {.registration = registers() ? &registration_ : nullptr,
                .guide = guide_ ? &*guide_ : nullptr,
                .moves_b = target_moves(),
                .curved = options_.lift,
                .seed = options_.seed};
    }

    /// Closed shapes; an open one beside a closed one is capped.
    void merge_on_sphere() {
        report_.domain = "sphere";
        WholeShape source = whole_shape(source_), target = whole_shape(target_);
        const AlignedShape a{source.mesh, source.filled.loops, source.filled.centres},
            b{target.mesh, target.filled.loops, target.filled.centres};
        if (target_moves()) {
            align_shapes(b, a, registration_.inverse(target.mesh.V), nullptr);
        } else {
            align_shapes(a, b, registration_.apply(source.mesh.V), nullptr);
        }
        source_shape_ = std::move(source.filled.shape);
        target_shape_ = std::move(target.filled.shape);
        tell_of_unused_features();
        merged_ = merge_spheres(source_shape_, target_shape_, sphere_options(), report_);
        open_fillings();
    }

    /// A shape without a border: closed, or all its openings filled.
    struct WholeShape {
        Mesh mesh;  ///< openings open, facing outwards
        FilledShape filled;
    };

    WholeShape whole_shape(const InputMesh& input) {
        if (input.report.closed) return {input.mesh, filled_shape(input.mesh, {})};
        report_.notes.push_back(fmt::format(
            "{} is open and the other shape is closed: it was capped for the map", input.report.name));
        WholeShape whole{input.mesh, filled_shape(input.mesh, boundary_loops(input.mesh))};
        if (signed_volume(whole.filled.shape.mesh) < 0.0) {
            whole.mesh.F.col(1).swap(whole.mesh.F.col(2));
            whole.filled = filled_shape(whole.mesh, boundary_loops(whole.mesh));
            report_.notes.push_back(
                fmt::format("{} faced inwards: its triangles were turned", input.report.name));
        }
        return whole;
    }

    /// Sec. 6: a plane cuts both shapes into halves that share the cut as border.
    void merge_cut() {
        report_.domain = "cut into two disks";
        source_shape_ = filled_shape(source_.mesh, {}).shape;
        target_shape_ = filled_shape(target_.mesh, {}).shape;
        CutMesh source_cut, target_cut;
        BorderControl control;
        {
            const StageClock clock(report_, "cut");
            const CutPlanes planes = registers() ? choose_cut(source_.mesh, target_.mesh, registration_)
                                                 : unregistered_cut(source_.mesh, target_.mesh);
            source_cut = cut(source_.mesh, planes.source);
            target_cut = cut(target_.mesh, planes.target);
            if (registers()) {
                // Both halves face outwards, so the direction is known.
                control =
                    registered_control(source_cut.halves[0].mesh, source_cut.halves[0].loop,
                                       target_cut.halves[0].mesh, target_cut.halves[0].loop, registration_);
                control.target_reversed = false;
            }
        }
        const Disk a0 = disk_of(source_cut, 0), a1 = disk_of(source_cut, 1), b0 = disk_of(target_cut, 0),
                   b1 = disk_of(target_cut, 1);
        const BorderUnion border = border_union(loop_points(a0), loop_points(b0), control);
        report_.border = report_of(border);
        const auto merged_half = [&](const Disk& a, const Disk& b, const BorderUnion& shared,
                                     const std::string& label) {
            BorderedDisks disks = border_disks(a, b, shared);
            map_onto_disk(disks, label, report_);
            align_features(disks, label);
            return merge_maps(source_shape_, disks.a, target_shape_, std::move(disks.b), options_.lift, label,
                              report_);
        };
        const MergedPair first = merged_half(a0, b0, border, " half 1");
        const MergedPair second = merged_half(a1, b1, mirrored(border), " half 2");
        merged_ = glued(first, second);
    }

    static Points loop_points(const Disk& disk) { return disk.mesh.V(disk.loop, Eigen::all); }

    static Disk whole(const Shape& shape, const std::vector<int>& loop) {
        Disk disk{shape.mesh, loop, {}};
        for (int v = 0; v < shape.mesh.vertex_count(); ++v) disk.sites.push_back(site_of_vertex(v));
        return disk;
    }

    /// Filled openings are opened again: merged triangles in a filling of either shape go.
    void open_fillings() {
        const auto filled =
            static_cast<int>(std::count(merged_.in_filling.begin(), merged_.in_filling.end(), 1));
        if (filled == 0) return;
        if (options_.openings == Openings::Fill) {
            report_.notes.push_back(fmt::format("{} merged triangles close openings of the shapes", filled));
            return;
        }
        merged_.F = without_fillings(merged_.F, merged_.in_filling);
        report_.reopened_triangles = filled;
        report_.notes.push_back(fmt::format(
            "openings were filled for the maps; {} merged triangles in them were removed again", filled));
    }

    void place_ends() {
        const StageClock clock(report_, "placement");
        if (options_.keep_maps) maps = std::move(merged_.maps);
        triangles = merged_.F;
        ends.a = merged_.points_a;
        ends.b = merged_.points_b;
        ends.shading_a = shading_correction(source_shape_, merged_.on_a, ends.a, triangles);
        ends.shading_b = shading_correction(target_shape_, merged_.on_b, ends.b, triangles);
        ends.R = registration_.R;
        ends.centre_a = centre_of_mass(source_.mesh);
        ends.centre_b = centre_of_mass(target_.mesh);
        place_correspondence();
    }

    /// Source vertices are merged vertices; their sites on the target say where they go.
    void place_correspondence() {
        const Points on_target = place(target_shape_.mesh.V, merged_.on_b);
        std::vector<int> merged_of(static_cast<std::size_t>(source_shape_.mesh.vertex_count()), -1);
        for (std::size_t x = 0; x < merged_.on_a.size(); ++x) {
            if (merged_.on_a[x].count == 1)
                merged_of[static_cast<std::size_t>(merged_.on_a[x].corners[0])] = static_cast<int>(x);
        }
        correspondence.resize(static_cast<Eigen::Index>(source_.vertex_of_file.size()), 3);
        correspondence.setConstant(std::numeric_limits<double>::quiet_NaN());
        for (std::size_t i = 0; i < source_.vertex_of_file.size(); ++i) {
            const int v = source_.vertex_of_file[i];
            if (v < 0) continue;
            correspondence.row(static_cast<Eigen::Index>(i)) =
                on_target.row(merged_of[static_cast<std::size_t>(v)]);
        }
    }

    const InputMesh& source_;
    const InputMesh& target_;
    const MorphOptions& options_;
    Report& report_;
    Registration registration_;
    std::optional<Guide> guide_;  ///< of the dense alignment
    Shape source_shape_, target_shape_;
    MergedPair merged_;
};

}  // namespace

InputMesh load_mesh(const std::string& file) {
    return input_mesh(read_mesh(file), file);
}

InputMesh admit_mesh(const Mesh& mesh, const std::string& name) {
    PolygonSoup soup;
    soup.V = mesh.V;
    soup.polygon_vertices.assign(mesh.F.data(), mesh.F.data() + mesh.F.size());
    for (int f = 1; f <= mesh.triangle_count(); ++f) soup.polygon_start.push_back(3 * f);
    return input_mesh(soup, name);
}

const Triangles& Morph::triangles() const {
    return triangles_;
}

Points Morph::frame(double alpha, Interpolation scheme) const {
    return interpolate(ends_, alpha, scheme);
}

Points Morph::shading(double alpha, Interpolation scheme) const {
    return interpolate_shading(ends_, alpha, scheme);
}

Mesh Morph::mesh(double alpha, Interpolation scheme) const {
    return {frame(alpha, scheme), triangles_};
}

Points Morph::correspondence() const {
    return correspondence_;
}

const std::vector<DomainMaps>& Morph::maps() const {
    return maps_;
}

const Endpoints& Morph::endpoints() const {
    return ends_;
}

const Report& Morph::report() const {
    return report_;
}

Morph morph(const InputMesh& source, const InputMesh& target, const MorphOptions& options) {
    Morph result;
    result.report_.on_stage = options.on_stage;
    Computation computation(source, target, options, result.report_);
    computation.run();
    result.report_.on_stage = nullptr;
    result.triangles_ = std::move(computation.triangles);
    result.ends_ = std::move(computation.ends);
    result.correspondence_ = std::move(computation.correspondence);
    result.maps_ = std::move(computation.maps);
    return result;
}

}  // namespace automorph
