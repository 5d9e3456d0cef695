#include "morph/overlay/merge_faces.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

#include "morph/mesh/errors.h"
#include "morph/mesh/index.h"

namespace automorph {

namespace {

constexpr int kMaxSides = 6;  // two triangles

/// A side of a merged face within the triangle of a at hand, with the face on its left.
struct Side {
    int from, to;
    int next;  ///< the next side in the same triangle of b, -1 at the end
};

class FaceMerger {
public:
    FaceMerger(const HalfEdgeTable& a, const EdgePieces& of_a, const HalfEdgeTable& b, const EdgePieces& of_b)
        : a_(a), b_(b), of_a_(of_a), of_b_(of_b), sides_in_(at(b.face_count()), -1) {
        edge_of_a_.resize(at(a.count()));
        for (std::size_t e = 0; e < of_a.edges.size(); ++e)
            edge_of_a_[at(a.edge(of_a.edges[e].halfedge))] = static_cast<int>(e);
    }

    MergedFaces run() {
        file_pieces_of_b();
        const std::size_t sides = 2 * (of_a_.pieces.size() + inner_.size());
        result_.polygon_vertices.reserve(sides);
        result_.polygon_start.reserve(sides / 3 + 1);
        result_.face_of_a.reserve(sides / 3);
        result_.face_of_b.reserve(sides / 3);
        for (int fa = 0; fa < a_.face_count(); ++fa) {
            for (int h = 3 * fa; h < 3 * fa + 3; ++h) sides_on(h);
            for (int i = inner_start_[at(fa)]; i < inner_start_[at(fa) + 1]; ++i) {
                const Inner& piece = inner_[at(i)];
                add(piece.left, piece.from, piece.to);
                add(piece.right, piece.to, piece.from);
            }
            for (const int fb : met_) close_face(fa, fb);
            met_.clear();
            sides_.clear();
        }
        result_.polygon_start.push_back(static_cast<int>(result_.polygon_vertices.size()));
        return std::move(result_);
    }

private:
    /// A piece of an edge of b inside a triangle of a, between triangles of b.
    struct Inner {
        int left, right;
        int from, to;
    };

    /// By triangle of a. Pieces along edges of a are left out: they are pieces of a too.
    void file_pieces_of_b() {
        inner_start_.assign(at(a_.face_count()) + 1, 0);
        for (const Piece& piece : of_b_.pieces) {
            if (piece.left == piece.right) ++inner_start_[at(piece.left) + 1];
        }
        std::partial_sum(inner_start_.begin(), inner_start_.end(), inner_start_.begin());
        inner_.resize(at(inner_start_.back()));
        std::vector<int> next(inner_start_.begin(), inner_start_.end() - 1);
        for (const EdgePieces::Edge& edge : of_b_.edges) {
            const int left = HalfEdgeTable::face(edge.halfedge), right = b_.face_across(edge.halfedge);
            for (int i = edge.begin; i < edge.end; ++i) {
                const Piece& piece = of_b_.pieces[at(i)];
                if (piece.left == piece.right)
                    inner_[at(next[at(piece.left)]++)] = {left, right, piece.from, piece.to};
            }
        }
    }

    /// The pieces of half-edge h of a, seen from its triangle.
    void sides_on(int h) {
        const EdgePieces::Edge& edge = of_a_.edges[at(edge_of_a_[at(a_.edge(h))])];
        for (int i = edge.begin; i < edge.end; ++i) {
            const Piece& piece = of_a_.pieces[at(i)];
            const bool forward = edge.halfedge == h;
            if (((forward ? piece.right : piece.left) < 0) != (a_.opposite(h) < 0)) different_borders();
            if (forward) {
                add(piece.left, piece.from, piece.to);
            } else {
                add(piece.right, piece.to, piece.from);
            }
        }
    }

    [[noreturn]] static void different_borders() {
        throw SolverFailure("overlay: the border of one map runs through the inside of the other");
    }

    void add(int fb, int from, int to) {
        if (fb < 0) different_borders();
        int& sides = sides_in_[at(fb)];
        if (sides < 0) met_.push_back(fb);
        sides_.push_back({from, to, sides});
        sides = static_cast<int>(sides_.size()) - 1;
    }

    /// Appends the polygon of the sides in fb and empties its list.
    void close_face(int fa, int fb) {
        int from[kMaxSides], to[kMaxSides], count = 0, i = std::exchange(sides_in_[at(fb)], -1);
        for (; i >= 0 && count < kMaxSides; i = sides_[at(i)].next, ++count) {
            from[count] = sides_[at(i)].from;
            to[count] = sides_[at(i)].to;
        }
        bool closed = i < 0 && count >= 3;
        result_.polygon_start.push_back(static_cast<int>(result_.polygon_vertices.size()));
        result_.face_of_a.push_back(fa);
        result_.face_of_b.push_back(fb);
        int x = from[0];
        for (int corner = 0; closed && corner < count; ++corner) {
            result_.polygon_vertices.push_back(x);
            const int side = static_cast<int>(std::find(from, from + count, x) - from);
            closed = side < count;
            if (closed) x = to[side];
        }
        if (!closed || x != from[0]) {
            throw SolverFailure(
                fmt::format("overlay: triangles {} and {} meet in sides that do not close", fa, fb));
        }
    }

    const HalfEdgeTable& a_;
    const HalfEdgeTable& b_;
    const EdgePieces& of_a_;
    const EdgePieces& of_b_;
    std::vector<int> edge_of_a_;    ///< per half-edge of a, at HalfEdgeTable::edge: index in of_a_.edges
    std::vector<Inner> inner_;      ///< by triangle of a
    std::vector<int> inner_start_;  ///< #F a + 1
    std::vector<Side> sides_;       ///< of the triangle of a at hand
    std::vector<int> sides_in_;     ///< per triangle of b: its latest in sides_, -1 if none
    std::vector<int> met_;          ///< triangles of b with sides
    MergedFaces result_;
};

}  // namespace

MergedFaces merge_faces(const HalfEdgeTable& a, const EdgePieces& of_a, const HalfEdgeTable& b,
                        const EdgePieces& of_b) {
    return FaceMerger(a, of_a, b, of_b).run();
}

}  // namespace automorph
