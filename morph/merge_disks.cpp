#include "morph/merge_disks.h"

#include <fmt/format.h>

#include <optional>

#include "morph/follow_guide.h"
#include "morph/mesh/errors.h"
#include "morph/overlay/lift.h"
#include "morph/parameterization/disk_map.h"
#include "morph/stage_clock.h"

namespace automorph {

namespace {

/// Where the vertices of a bordered disk lie on its shape: inserted ones by the ratio along their border
/// edge.
std::vector<Site> sites_on_shape(const Disk& disk, const BorderedMesh& bordered) {
    std::vector<Site> sites = disk.sites;
    sites.reserve(sites.size() + bordered.inserted.size());
    for (const auto& inserted : bordered.inserted) {
        const Site on_edge{{inserted.from, inserted.to, -1}, {1.0 - inserted.ratio, inserted.ratio, 0.0}, 2};
        sites.push_back(compose(on_edge, disk.sites));
    }
    return sites;
}

MapReport map_report(const std::string& of, const DiskMap& map) {
    return {of,
            name(map.weights),
            map.reason,
            map.quality.flipped,
            map.quality.p01,
            map.quality.smallest_ratio,
            map.residual};
}

MappedPart bordered_part(const Shape& shape, const Disk& disk, const std::vector<BorderSite>& border) {
    BorderedMesh bordered = insert_border(disk.mesh, disk.loop, border);
    std::vector<Site> sites = sites_on_shape(disk, bordered);
    std::vector<char> filling = filling_triangles(shape, bordered.mesh, sites);
    return {std::move(bordered.mesh), std::move(bordered.loop), std::move(sites), std::move(filling), {}};
}

/// A map, or why there is none that is good enough.
struct JudgedMap {
    DiskMap map;
    std::string defect;
};

JudgedMap judged(DiskMap map) {
    std::string defect;
    if (map.quality.p01 < kLeastDiskQuality) {
        defect = fmt::format("the disk map squeezes it: p01 is {:.2g}, below {}", map.quality.p01,
                             kLeastDiskQuality);
    }
    return {std::move(map), std::move(defect)};
}

/// The part's own map.
JudgedMap own_map(const MappedPart& part, const Points& circle, bool only_good) {
    if (!only_good) return {disk_map(part.mesh, part.loop, circle), {}};
    try {
        return judged(disk_map(part.mesh, part.loop, circle, {.fallbacks = false}));
    } catch (const SolverFailure& failure) {
        return {{}, failure.what()};
    }
}

/// The map of a that follows the guide; empty if there is none.
std::optional<DiskMap> guided_map_of(const BorderedDisks& disks, const Guide& guide, Report& report) {
    auto rays = follow_guide(disks.a, guide, disks.b, report);
    if (!rays) return std::nullopt;
    DiskMap map;
    map.weights = MapWeights::MeanValue;
    map.quality = map_quality(disks.a.mesh, *rays);
    map.rays = std::move(*rays);
    return map;
}

}  // namespace

BorderedDisks border_disks(const Shape& shape_a, const Disk& a, const Shape& shape_b, const Disk& b,
                           const BorderUnion& border) {
    return {bordered_part(shape_a, a, border.source), bordered_part(shape_b, b, border.target),
            border.angles};
}

std::string map_onto_disk(BorderedDisks& disks, const DiskMapRules& rules, Report& report) {
    const StageClock clock(report, "maps" + rules.label);
    const Points circle = border_rays(disks.angles);
    const JudgedMap b = own_map(disks.b, circle, rules.only_good);
    if (!b.defect.empty()) return "target: " + b.defect;
    disks.b.rays = b.map.rays;

    std::optional<DiskMap> guided;
    if (rules.guide != nullptr) {
        disks.a.rays = Points::Zero(disks.a.mesh.vertex_count(), 3);
        disks.a.rays(disks.a.loop, Eigen::all) = circle;
        guided = guided_map_of(disks, *rules.guide, report);
    }
    const JudgedMap a = !guided           ? own_map(disks.a, circle, rules.only_good)
                        : rules.only_good ? judged(*guided)
                                          : JudgedMap{*guided, {}};
    if (!a.defect.empty()) return "source: " + a.defect;
    disks.a.rays = a.map.rays;

    if (rules.guide != nullptr && !guided) {
        report.notes.push_back(
            "the alignment was given up: not all triangles of the source that it turns over could be "
            "turned back");
    }
    report.maps.push_back(map_report("source" + rules.label, a.map));
    if (guided) report.maps.back().weights = "aligned";
    report.maps.push_back(map_report("target" + rules.label, b.map));
    return {};
}

}  // namespace automorph
