#include "morph/shapes/sculpt.h"

namespace automorph::sculpt {

namespace {

constexpr int kSamples = 3, kSteps = 3;  // per bead, to start from; of Newton's method after it

Bead beyond(const Bead& end, const Bead& inner) {
    return {end.at + (end.at - inner.at), inner.radius};
}

double distance(const Vec3& a, const Vec3& b) {
    const Vec3 off = a - b;
    return std::sqrt(dot(off, off));
}

}  // namespace

Strand::Strand(std::vector<Bead> beads) {
    // Beyond the ends the line goes on straight and the radii are mirrored, so that these end level.
    beads_.push_back(beyond(beads[0], beads[1]));
    beads_.insert(beads_.end(), beads.begin(), beads.end());
    beads_.push_back(beyond(beads[beads.size() - 1], beads[beads.size() - 2]));
    centre_ = {0, 0, 0};
    for (const Bead& each : beads)
        centre_ = centre_ + Vec3{each.at.x / double(beads.size()), each.at.y / double(beads.size()),
                                 each.at.z / double(beads.size())};
    for (const Bead& each : beads) radius_ = std::max(radius_, distance(each.at, centre_) + each.radius);
    for (int i = 0; i <= kSamples * static_cast<int>(end()); ++i)
        samples_.push_back(at(i / double(kSamples)).point);
}

bool Strand::is_out_of_reach(const Vec3& p) const {
    return distance(p, centre_) > radius_ + kReach;
}

Strand::Place Strand::at(double u) const {
    const auto i = static_cast<std::size_t>(std::clamp(u, 0.0, end() - 1.0));
    const double t = u - static_cast<double>(i), r = 1.0 - t;
    // Weights of the four beads, and their derivatives.
    const double w[3][4] = {{r * r * r / 6, (4 - 6 * t * t + 3 * t * t * t) / 6,
                             (1 + 3 * t + 3 * t * t - 3 * t * t * t) / 6, t * t * t / 6},
                            {-0.5 * r * r, -2 * t + 1.5 * t * t, 0.5 + t - 1.5 * t * t, 0.5 * t * t},
                            {r, -2 + 3 * t, 1 - 3 * t, t}};
    Vec3 mixed[3] = {};
    double radius[2] = {};
    for (std::size_t k = 0; k < 4; ++k) {
        const Bead& bead = beads_[i + k];
        for (std::size_t n = 0; n < 3; ++n)
            mixed[n] = mixed[n] + Vec3{w[n][k] * bead.at.x, w[n][k] * bead.at.y, w[n][k] * bead.at.z};
        for (std::size_t n = 0; n < 2; ++n) radius[n] += w[n][k] * bead.radius;
    }
    return {mixed[0], mixed[1], mixed[2], radius[0], radius[1]};
}

double Strand::nearest(const Vec3& p) const {
    double least = 1e300, u = 0.0;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
        const Vec3 off = p - samples_[i];
        const double away = dot(off, off);
        if (!(away < least)) continue;
        least = away;
        u = static_cast<double>(i) / kSamples;
    }
    for (int step = 0; step < kSteps; ++step) {
        const Place place = at(u);
        u = std::clamp(u + dot(p - place.point, place.tangent) / foot_slope(place, p), 0.0, end());
    }
    return u;
}

}  // namespace automorph::sculpt
