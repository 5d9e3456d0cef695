#include "morph/parameterization/sphere_energy.h"

#include <Eigen/Geometry>
#include <cmath>

// Notation: b and c are the neighbours w_k, w_k+1 minus x, in the frame (e1, e2, x0). In it d = det[x w_k
// w_k+1] is x . (b x c), and the first two coordinates of x0 are 0.

namespace automorph {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

TriangleMetric triangle_metric(const Eigen::Vector3d& p0, const Eigen::Vector3d& p1,
                               const Eigen::Vector3d& p2, double eps) {
    const double l0 = (p2 - p1).squaredNorm() + eps, l1 = (p0 - p2).squaredNorm() + eps,
                 l2 = (p1 - p0).squaredNorm() + eps;
    // 16 A^2 is the sum of products of cotangents; split such that what eps adds is positive for certain.
    const double cross = (p1 - p0).cross(p2 - p0).squaredNorm();
    const double area = 0.25 * std::sqrt(4.0 * cross + 2.0 * eps * (l0 + l1 + l2) - 3.0 * eps * eps);
    return {{l1 + l2 - l0, l2 + l0 - l1, l0 + l1 - l2}, 0.5 * area, 0.125 / area};
}

bool clearly_positive(const Ray& a, const Ray& b, const Ray& c) {
    const Ray ab = b - a, ac = c - a;
    const double lb = ab.norm(), lc = ac.norm();
    return a.dot(ab.cross(ac)) > kSlimmest * lb * lc + kRounding * (lb + lc);
}

void SphereStar::reset(const Ray& x0) {
    neighbours_.clear();
    sides_.clear();
    x0_ = x0;
    // Any tangent frame will do; this one has no cancellation.
    int least = 0;
    x0.cwiseAbs().minCoeff(&least);
    e1_ = x0.cross(Ray::Unit(least)).normalized();
    e2_ = x0.cross(e1_);
}

void SphereStar::add(const Ray& ray, const TriangleMetric& metric, int own) {
    const Ray difference = ray - x0_;
    neighbours_.push_back({e1_.dot(difference), e2_.dot(difference), x0_.dot(difference)});
    const int k = own == 2 ? 0 : own + 1, next = own == 0 ? 2 : own - 1;
    sides_.push_back({metric.cotangent[own], metric.cotangent[k], metric.cotangent[next], metric.half_area,
                      metric.inverse});
}

void SphereStar::close() {
    const std::size_t n = neighbours_.size();
    double sum = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
        const Neighbour &b = neighbours_[k], &c = neighbours_[k + 1 < n ? k + 1 : 0];
        const double x = c.x - b.x, y = c.y - b.y, z = c.z - b.z;
        sides_[k].constant *= x * x + y * y + z * z;
        sum += std::sqrt(b.x * b.x + b.y * b.y + b.z * b.z);
    }
    radius_ = sum / static_cast<double>(n);
}

double SphereStar::energy(double s, double t) const {
    const std::size_t n = neighbours_.size();
    const double squared = s * s + t * t, length = std::sqrt(1.0 + squared);
    const double px = s / length, py = t / length, sink = squared / (length * (length + 1.0)),
                 pz = 1.0 / length;
    const auto from = [&](const Neighbour& w) { return Neighbour{w.x - px, w.y - py, w.z + sink}; };
    double total = 0.0;
    Neighbour b = from(neighbours_[n - 1]);
    double bb = b.x * b.x + b.y * b.y + b.z * b.z;
    std::size_t k = n - 1;
    for (std::size_t next = 0; next < n; k = next++) {
        const Neighbour c = from(neighbours_[next]);
        const double cc = c.x * c.x + c.y * c.y + c.z * c.z;
        const double d =
            px * (b.y * c.z - b.z * c.y) + py * (b.z * c.x - b.x * c.z) + pz * (b.x * c.y - b.y * c.x);
        const double lengths = std::sqrt(bb * cc);
        // |b| + |c| <= sqrt(2 (bb + cc))
        if (!(d > kSlimmest * lengths + kRounding * std::sqrt(2.0 * (bb + cc)))) return kInfinity;
        const Side& side = sides_[k];
        const double q = side.constant + side.at_k * cc + side.at_next * bb;
        total += q * (side.half_area / (d * d) + side.inverse);
        b = c;
        bb = cc;
    }
    return total;
}

Ray SphereStar::ray(double s, double t) const {
    return (x0_ + s * e1_ + t * e2_).normalized();
}

Eigen::Vector2d SphereStar::offset(const Ray& ray) const {
    const double height = x0_.dot(ray);
    return {e1_.dot(ray) / height, e2_.dot(ray) / height};
}

SphereStar::Step SphereStar::newton() const {
    // E = sum Q g, g = half_area / d^2 + inverse; derivatives along the tangent coordinates at x0, where to
    // second order x = x0 (1 - (s^2 + t^2) / 2) + s e1 + t e2.
    double energy = 0.0, gx = 0.0, gy = 0.0, hxx = 0.0, hxy = 0.0, hyy = 0.0;
    const std::size_t n = neighbours_.size();
    std::size_t k = n - 1;
    for (std::size_t next = 0; next < n; k = next++) {
        const Neighbour &b = neighbours_[k], &c = neighbours_[next];
        const Side& side = sides_[k];
        const double bb = b.x * b.x + b.y * b.y + b.z * b.z, cc = c.x * c.x + c.y * c.y + c.z * c.z;
        const double d = b.x * c.y - b.y * c.x;
        const double q = side.constant + side.at_k * cc + side.at_next * bb;
        const double qx = -2.0 * (side.at_k * c.x + side.at_next * b.x),
                     qy = -2.0 * (side.at_k * c.y + side.at_next * b.y);
        const double qq = 2.0 * (side.at_k * (1.0 + c.z) + side.at_next * (1.0 + b.z));
        const double dx = b.y * c.z - b.z * c.y - (c.y - b.y), dy = b.z * c.x - b.x * c.z + (c.x - b.x);
        const double inverse = 1.0 / d, barrier = side.half_area * inverse * inverse;
        const double g = barrier + side.inverse, g1 = -2.0 * barrier * inverse,
                     g2 = 6.0 * barrier * inverse * inverse;
        const double g1x = g1 * dx, g1y = g1 * dy, curved = qq * g - q * g1 * d;
        energy += q * g;
        gx += qx * g + q * g1x;
        gy += qy * g + q * g1y;
        hxx += curved + 2.0 * qx * g1x + q * g2 * dx * dx;
        hxy += qx * g1y + qy * g1x + q * g2 * dx * dy;
        hyy += curved + 2.0 * qy * g1y + q * g2 * dy * dy;
    }
    // |H| by the eigenvalues of the 2 x 2 matrix.
    const double mean = 0.5 * (hxx + hyy), half = 0.5 * (hxx - hyy),
                 spread = std::sqrt(half * half + hxy * hxy);
    double ux = 1.0, uy = 0.0;  // eigenvector of mean + spread
    if (spread > 0.0) {
        ux = half >= 0.0 ? half + spread : hxy;
        uy = half >= 0.0 ? hxy : spread - half;
        const double norm = std::sqrt(ux * ux + uy * uy);
        ux /= norm;
        uy /= norm;
    }
    const double floor = 1e-12 * (std::abs(mean) + spread);  // a flat direction is left alone
    const double high = std::max(std::abs(mean + spread), floor),
                 low = std::max(std::abs(mean - spread), floor);
    const double gu = gx * ux + gy * uy, gv = gy * ux - gx * uy;
    double su = -gu / high, sv = -gv / low;
    const double longest = kLongestStep * radius_, length = std::sqrt(su * su + sv * sv);
    if (!(length <= longest)) {
        const double scale = longest / length;
        su *= scale;
        sv *= scale;
    }
    const double predicted = -(gu * su + gv * sv) - 0.5 * (high * su * su + low * sv * sv);
    return {su * ux - sv * uy, su * uy + sv * ux, energy, predicted};
}

}  // namespace automorph
