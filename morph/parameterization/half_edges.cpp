#include "morph/parameterization/half_edges.h"

#include <fmt/format.h>

#include <numeric>

#include "morph/mesh/errors.h"
#include "morph/mesh/index.h"

// Notation: h runs from v to u in the triangle v u r; its opposite g from u to v in the triangle u v l. a and
// b are the opposites of u r and r v; c and d those of v l and l u.

namespace automorph {

void HalfEdges::collapse(int h) {
    const int g = twin(h), v = origin[at(h)], u = origin[at(g)];
    const int r = origin[at(prev(h))], l = origin[at(prev(g))];
    const int a = twin(next(h)), b = twin(prev(h)), c = twin(next(g)), d = twin(prev(g));
    for (int x = turn(h); x != next(g); x = turn(x)) origin[at(x)] = u;
    opposite[at(a)] = b;
    opposite[at(b)] = a;
    opposite[at(c)] = d;
    opposite[at(d)] = c;
    out[at(u)] = b;
    out[at(r)] = a;
    out[at(l)] = c;
    valence[at(u)] += valence[at(v)] - 4;
    --valence[at(r)];
    --valence[at(l)];
}

void HalfEdges::undo(int h) {
    // The two triangles still hold what they held, so their neighbours are found through them.
    const int g = twin(h), v = origin[at(h)], u = origin[at(g)];
    for (const int side : {next(h), prev(h), next(g), prev(g)}) opposite[at(twin(side))] = side;
    int count = 0;
    int x = h;
    do {
        origin[at(x)] = v;
        ++count;
        x = turn(x);
    } while (x != h);
    out[at(v)] = h;
    out[at(u)] = g;
    valence[at(v)] = count;
    valence[at(u)] -= count - 4;
    ++valence[at(origin[at(prev(h))])];
    ++valence[at(origin[at(prev(g))])];
}

HalfEdges half_edges(const Triangles& F, int vertex_count) {
    HalfEdges mesh;
    const int triangles = static_cast<int>(F.rows());
    mesh.origin.assign(4 * at(triangles), -1);
    mesh.opposite.assign(4 * at(triangles), -1);
    mesh.out.assign(at(vertex_count), -1);
    mesh.valence.assign(at(vertex_count), 0);
    std::vector<int> start(at(vertex_count) + 1, 0);
    for (int f = 0; f < triangles; ++f) {
        for (int k = 0; k < 3; ++k) {
            mesh.origin[at(4 * f + k)] = F(f, k);
            mesh.out[at(F(f, k))] = 4 * f + k;
            ++mesh.valence[at(F(f, k))];
            ++start[at(F(f, k)) + 1];
        }
    }
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<int> leaving(3 * at(triangles)), fill(start.begin(), start.end() - 1);
    for (int h = 0; h < 4 * triangles; ++h) {
        if ((h & 3) != 3) leaving[at(fill[at(mesh.origin[at(h)])]++)] = h;
    }
    for (int h = 0; h < 4 * triangles; ++h) {
        if ((h & 3) == 3 || mesh.opposite[at(h)] >= 0) continue;
        const int u = mesh.origin[at(h)], v = mesh.target(h);
        // v -> u leaves v and enters u: the vertex with fewer half-edges is searched.
        const bool search_v = mesh.valence[at(v)] <= mesh.valence[at(u)];
        int found = -1, count = 0;
        for (int k = start[at(search_v ? v : u)]; k < start[at(search_v ? v : u) + 1]; ++k) {
            const int g = search_v ? leaving[at(k)] : HalfEdges::prev(leaving[at(k)]);
            if (mesh.origin[at(g)] != v || mesh.target(g) != u) continue;
            found = g;
            ++count;
        }
        if (count != 1 || mesh.opposite[at(found)] >= 0) {
            throw InvalidMesh(fmt::format(
                "a closed mesh is needed: edge {}-{} does not have two triangles that face the same way", u,
                v));
        }
        mesh.opposite[at(h)] = found;
        mesh.opposite[at(found)] = h;
    }
    return mesh;
}

}  // namespace automorph
