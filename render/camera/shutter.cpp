#include "render/camera/shutter.h"

#include <algorithm>
#include <cmath>

namespace automorph::render {
namespace {

constexpr double kLongestArc = 3.0;  // degrees between two moments
constexpr int kMostMoments = 129;    // RTC_MAX_TIME_STEP_COUNT

}  // namespace

int shutter_steps(double degrees) {
    const double arcs_of_half = std::ceil(0.5 * std::abs(degrees) / kLongestArc);
    return 1 + 2 * static_cast<int>(std::min(arcs_of_half, (kMostMoments - 1) / 2.0));
}

std::vector<double> shutter_times(double shutter, int steps) {
    std::vector<double> times;
    const int middle = (steps - 1) / 2;
    for (int i = 0; i < steps; ++i) times.push_back(shutter * (i - middle) / std::max(1, steps - 1));
    return times;
}

}  // namespace automorph::render
