#include "morph/sphere_alignment/guarded_move.h"

#include "morph/mesh/index.h"
#include "morph/parameterization/sphere_energy.h"

namespace automorph {

namespace {

/// After so many halvings a vertex stays where it is.
constexpr int kHalvings = 8;

}  // namespace

GuardedMove move_guarded(const Triangles& F, const Points& rays, const Points& wanted) {
    const int vertices = static_cast<int>(rays.rows()), triangles = static_cast<int>(F.rows());
    std::vector<char> halvings(at(vertices), 0), shorten(at(vertices), 0);
    GuardedMove result{wanted, 0};
    const auto goes = [&](int v) { return halvings[at(v)] < kHalvings && rays.row(v) != wanted.row(v); };
    // Ends: in each round a vertex goes less far, at most kHalvings times.
    for (bool valid = false; !valid;) {
        valid = true;
        for (int f = 0; f < triangles; ++f) {
            const int a = F(f, 0), b = F(f, 1), c = F(f, 2);
            if (clearly_positive(result.rays.row(a), result.rays.row(b), result.rays.row(c))) continue;
            for (const int v : {a, b, c}) {
                if (!goes(v)) continue;
                shorten[at(v)] = 1;
                valid = false;
            }
        }
        for (int v = 0; v < vertices; ++v) {
            if (!shorten[at(v)]) continue;
            shorten[at(v)] = 0;
            const double share = ++halvings[at(v)] < kHalvings ? std::ldexp(1.0, -halvings[at(v)]) : 0.0;
            result.rays.row(v) =
                share > 0.0 ? (rays.row(v) + share * (wanted.row(v) - rays.row(v))).normalized().eval()
                            : rays.row(v).eval();
        }
    }
    for (const char count : halvings) result.shortened += count > 0;
    return result;
}

}  // namespace automorph
