#include "morph/mesh/admit.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "morph/mesh/edges.h"
#include "morph/mesh/errors.h"
#include "morph/mesh/geometry.h"
#include "morph/mesh/mend.h"
#include "morph/mesh/text_cursor.h"
#include "morph/mesh/triangulate.h"

namespace automorph {

namespace {

// A surface whose area is below this share of the sum of its squared longest edges has none: what is left is
// the rounding of cross products.
constexpr double kSmallestAreaShare = 1e-13;
// Squares of lengths below this, and their products, leave the range of double.
constexpr double kSmallestDiagonal = 1e-50;

void check_soup(const PolygonSoup& soup, const std::string& name) {
    for (Eigen::Index i = 0; i < soup.V.size(); ++i) {
        if (!(std::abs(soup.V.data()[i]) <= kLargestCoordinate)) {
            const Eigen::Index v = i / 3;
            throw InvalidMesh(
                fmt::format("{}: vertex {} is at ({} {} {}); coordinates must be finite and below {:g}", name,
                            v, soup.V(v, 0), soup.V(v, 1), soup.V(v, 2), kLargestCoordinate));
        }
    }
    for (int p = 0; p < soup.polygon_count(); ++p) {
        for (int i = soup.polygon_start[p]; i < soup.polygon_start[p + 1]; ++i) {
            const int v = soup.polygon_vertices[i];
            if (v < 0 || v >= soup.V.rows()) {
                throw InvalidMesh(fmt::format("{}: face {} uses vertex {}, but there are {} vertices", name,
                                              p, v, soup.V.rows()));
            }
        }
    }
}

void refuse_no_size(const Points& V, const std::string& name) {
    const double diagonal = bounding_box_diagonal(V);
    if (diagonal > kSmallestDiagonal) return;
    throw InvalidMesh(fmt::format("{}: all {} vertices lie within {:g} of each other: the shape has no size",
                                  name, V.rows(), diagonal));
}

Draft first_draft(const PolygonSoup& soup, const std::string& name) {
    TriangulatedSoup triangles = triangulate(soup);
    if (triangles.too_large >= 0) {
        const int p = triangles.too_large;
        throw InvalidMesh(fmt::format("{}: face {} has {} corners, more than {}; split it into triangles",
                                      name, p, soup.polygon_start[p + 1] - soup.polygon_start[p],
                                      kLargestPolygon));
    }
    Draft draft;
    draft.V = soup.V;
    draft.F = std::move(triangles.F);
    draft.polygon = std::move(triangles.polygon);
    draft.file_vertex.resize(static_cast<std::size_t>(soup.V.rows()));
    std::iota(draft.file_vertex.begin(), draft.file_vertex.end(), 0);
    draft.vertex_of_file = draft.file_vertex;
    if (triangles.split_polygons > 0) {
        draft.mended.push_back(fmt::format("split {} polygons into triangles", triangles.split_polygons));
    }
    if (triangles.too_small > 0) {
        draft.mended.push_back(
            fmt::format("dropped {} faces of fewer than three corners", triangles.too_small));
    }
    if (triangles.degenerate > 0) {
        draft.mended.push_back(
            fmt::format("dropped {} triangles with a repeated corner", triangles.degenerate));
    }
    return draft;
}

void refuse_non_manifold_edges(const Draft& draft, const std::string& name) {
    const EdgeTable edges = edge_table(draft.F);
    int count = 0, first = -1;
    for (int e = edges.edge_count() - 1; e >= 0; --e) {
        if (edges.use_count(e) <= 2) continue;
        ++count;
        first = e;
    }
    if (count == 0) return;
    const EdgeUse& use = edges.use(first, 0);
    throw InvalidMesh(
        fmt::format("{}: {} shared by three or more triangles (the first, between vertices {} and {}, by {}: "
                    "faces {}, {}, {}{}): "
                    "no surface; remove inner walls and fins, or separate parts that touch",
                    name, count == 1 ? "an edge is" : fmt::format("{} edges are", count),
                    draft.file_vertex[use.low], draft.file_vertex[use.high], edges.use_count(first),
                    draft.polygon[use.triangle], draft.polygon[edges.use(first, 1).triangle],
                    draft.polygon[edges.use(first, 2).triangle], edges.use_count(first) > 3 ? ", ..." : ""));
}

void refuse_components(const Draft& draft, const std::string& name) {
    const Labels components = edge_components(draft.F, edge_table(draft.F));
    if (components.count == 1) return;
    struct Part {
        int triangles = 0, first_face = -1;
        double area = 0.0;
    };
    std::vector<Part> parts(static_cast<std::size_t>(components.count));
    const Eigen::VectorXd areas = triangle_areas({draft.V, draft.F});
    for (int t = 0; t < draft.F.rows(); ++t) {
        Part& part = parts[components.of[t]];
        if (part.triangles++ == 0) part.first_face = draft.polygon[t];
        part.area += areas[t];
    }
    std::stable_sort(parts.begin(), parts.end(),
                     [](const Part& x, const Part& y) { return x.area > y.area; });
    const double total = areas.sum();
    const auto describe = [&](const Part& part) {
        return fmt::format("{} triangle{} from face {} on, {:.3g} % of the area", part.triangles,
                           part.triangles == 1 ? "" : "s", part.first_face,
                           total > 0.0 ? 100.0 * part.area / total : 0.0);
    };
    throw InvalidMesh(
        fmt::format("{}: {} separate parts (the largest: {}; the next: {}); a morph needs one: keep one of "
                    "them or join them",
                    name, components.count, describe(parts[0]), describe(parts[1])));
}

void refuse_no_area(const Draft& draft, const std::string& name) {
    double squares = 0.0;
    for (const auto& f : draft.F.rowwise()) {
        double longest = 0.0;
        for (int k = 0; k < 3; ++k) {
            longest = std::max(longest, (draft.V.row(f[k]) - draft.V.row(f[(k + 1) % 3])).squaredNorm());
        }
        squares += longest;
    }
    const double area = triangle_areas({draft.V, draft.F}).sum();
    if (!(area > kSmallestAreaShare * squares)) {
        throw InvalidMesh(
            fmt::format("{}: all {} triangles have zero area (in total {:g}, the longest extent is {:g}): "
                        "their vertices lie on "
                        "lines; check the file's coordinates",
                        name, draft.F.rows(), area, bounding_box_diagonal(draft.V)));
    }
}

void refuse_genus(const MeshInspection& found, const std::string& name) {
    if (found.genus == 0) return;
    throw InvalidMesh(fmt::format(
        "{}: the surface has genus {} ({}): {} vertices, {} triangles, Euler characteristic {}, {} boundary "
        "loops; a "
        "morph needs genus 0: cut or fill the {}",
        name, found.genus, found.genus == 1 ? "one handle, like a torus" : "that many handles",
        found.vertices, found.triangles, found.euler_characteristic, found.boundary_loops,
        found.genus == 1 ? "handle" : "handles"));
}

/// Mends a draft in the order in which each step can rely on the ones before.
AdmittedMesh mend(Draft draft, const std::string& name) {
    drop_degenerate_and_duplicate_triangles(draft);
    if (draft.F.rows() == 0) {
        throw InvalidMesh(fmt::format("{}: no triangles: every face repeats a corner", name));
    }
    drop_strays(draft);
    refuse_non_manifold_edges(draft, name);
    refuse_components(draft, name);
    orient(draft, name);
    split_vertices(draft);
    drop_unused_vertices(draft);
    refuse_no_area(draft, name);

    AdmittedMesh result;
    result.admitted = inspect_triangles(draft.V, draft.F);
    refuse_genus(result.admitted, name);
    if (result.admitted.closed) turn_outwards(draft);
    result.mesh = {std::move(draft.V), std::move(draft.F)};
    result.vertex_of_file = std::move(draft.vertex_of_file);
    result.mended = std::move(draft.mended);
    return result;
}

struct Attempt {
    std::optional<AdmittedMesh> mesh;
    std::string refusal;
};

Attempt attempt(Draft draft, const std::string& name) {
    Attempt result;
    try {
        result.mesh = mend(std::move(draft), name);
    } catch (const InvalidMesh& refusal) {
        result.refusal = refusal.what();
    }
    return result;
}

int boundary_edges(Draft draft) {
    drop_degenerate_and_duplicate_triangles(draft);
    const EdgeTable edges = edge_table(draft.F);
    int count = 0;
    for (int e = 0; e < edges.edge_count(); ++e) count += edges.use_count(e) == 1 ? 1 : 0;
    return count;
}

/// Vertices at one place may be one vertex cut in two (STL, texture seams) or two sheets that touch. They are
/// merged only where that closes the surface along edges; if the merged surface is not admissible and the
/// one in the file is, the file is right.
AdmittedMesh mend_merged_or_as_is(const Draft& draft, const std::string& name) {
    if (coincident_vertices(draft.V).count == draft.V.rows()) return mend(draft, name);
    const int open_edges = boundary_edges(draft);
    if (open_edges == 0) return mend(draft, name);
    Draft merged = draft;
    merge_coincident_vertices(merged);
    if (boundary_edges(merged) == open_edges) return mend(draft, name);

    Attempt with = attempt(std::move(merged), name);
    if (with.mesh) return std::move(*with.mesh);
    Attempt without = attempt(draft, name);
    if (without.mesh) return std::move(*without.mesh);
    throw InvalidMesh(with.refusal);
}

}  // namespace

AdmittedMesh admit(const PolygonSoup& soup, const std::string& name) {
    if (soup.polygon_count() == 0) {
        throw InvalidMesh(
            fmt::format("{}: no triangles, only {} vertices; a surface is needed, not a point cloud", name,
                        soup.V.rows()));
    }
    check_soup(soup, name);
    refuse_no_size(soup.V, name);
    MeshInspection found = inspect(soup);
    AdmittedMesh result = mend_merged_or_as_is(first_draft(soup, name), name);
    result.found = found;
    return result;
}

}  // namespace automorph
