#include "cgal_overlay.h"

#include <CGAL/Arr_default_overlay_traits.h>
#include <CGAL/Arr_overlay_2.h>
#include <CGAL/Arr_segment_traits_2.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace automorph::bench {

namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Traits = CGAL::Arr_segment_traits_2<Kernel>;
using Arrangement = CGAL::Arrangement_2<Traits>;

Arrangement arrangement(const Mesh& mesh, const Points& rays) {
    std::vector<Kernel::Point_2> points;
    for (int v = 0; v < rays.rows(); ++v) points.emplace_back(rays(v, 0), rays(v, 1));
    std::vector<std::pair<int, int>> edges;
    for (int f = 0; f < mesh.triangle_count(); ++f)
        for (int k = 0; k < 3; ++k) edges.push_back(std::minmax({mesh.F(f, k), mesh.F(f, (k + 1) % 3)}));
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    std::vector<Traits::X_monotone_curve_2> segments;
    for (const auto& [u, v] : edges) segments.emplace_back(points[u], points[v]);
    Arrangement result;
    CGAL::insert_non_intersecting_curves(result, segments.begin(), segments.end());
    return result;
}

}  // namespace

struct CgalOverlay::Arrangements {
    Arrangement a, b;
};

CgalOverlay::CgalOverlay(const Mesh& a, const Points& rays_a, const Mesh& b, const Points& rays_b)
    : arrangements_(new Arrangements{arrangement(a, rays_a), arrangement(b, rays_b)}) {}

CgalOverlay::~CgalOverlay() = default;

CgalOverlay::Counts CgalOverlay::run() const {
    Arrangement merged;
    CGAL::Arr_default_overlay_traits<Arrangement> traits;
    CGAL::overlay(arrangements_->a, arrangements_->b, merged, traits);
    return {static_cast<int>(merged.number_of_vertices()),
            static_cast<int>(merged.number_of_faces() - merged.number_of_unbounded_faces())};
}

}  // namespace automorph::bench
