#include "morph/merge_disks.h"

#include <fmt/format.h>

#include "morph/mesh/errors.h"
#include "morph/overlay/lift.h"
#include "morph/parameterization/disk_map.h"
#include "morph/report_of.h"
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

MappedPart bordered_part(const Disk& disk, const std::vector<BorderSite>& border) {
    BorderedMesh bordered = insert_border(disk.mesh, disk.loop, border);
    std::vector<Site> sites = sites_on_shape(disk, bordered);
    return {std::move(bordered.mesh), std::move(bordered.loop), std::move(sites), {}};
}

}  // namespace

BorderedDisks border_disks(const Disk& a, const Disk& b, const BorderUnion& border) {
    return {bordered_part(a, border.source), bordered_part(b, border.target), border.angles};
}

void map_onto_disk(BorderedDisks& disks, const std::string& label, Report& report) {
    const StageClock clock(report, "maps" + label);
    const Points circle = border_rays(disks.angles);
    for (MappedPart* part : {&disks.a, &disks.b}) {
        const std::string name = (part == &disks.a ? "source" : "target") + label;
        try {
            DiskMap map = disk_map(part->mesh, part->loop, circle);
            report.maps.push_back(report_of(name, map));
            part->rays = std::move(map.rays);
        } catch (const SolverFailure& failure) {
            throw SolverFailure(
                fmt::format("{}: {}; the sphere takes what the disk squeezes to nothing: choose the domain "
                            "auto or sphere",
                            name, failure.what()));
        }
    }
}

std::string try_harmonic_disk(BorderedDisks& disks, Report& report) {
    const StageClock clock(report, "maps");
    const Points circle = border_rays(disks.angles);
    std::vector<MapReport> maps;
    for (MappedPart* part : {&disks.a, &disks.b}) {
        const std::string name = part == &disks.a ? "source" : "target";
        try {
            DiskMap map = disk_map(part->mesh, part->loop, circle, {.fallbacks = false});
            if (map.quality.p01 < kLeastDiskQuality) {
                return fmt::format("the disk map squeezes the {}: p01 is {:.2g}, below {}", name,
                                   map.quality.p01, kLeastDiskQuality);
            }
            maps.push_back(report_of(name, map));
            part->rays = std::move(map.rays);
        } catch (const SolverFailure& failure) {
            return fmt::format("{}: {}", name, failure.what());
        }
    }
    report.maps = std::move(maps);
    return {};
}

}  // namespace automorph
