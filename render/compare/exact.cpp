#include "render/compare/exact.h"

#include <algorithm>

#include "render/compare/difference.h"

namespace automorph::render {

Comparison compare_exact(const Image& golden, const Image& found) {
    const Difference difference = compare(golden, found);
    TestResult bits;
    bits.name = "values that differ";
    bits.value = static_cast<double>(difference.different_values);
    if (difference.different_values > 0) {
        bits.where = difference.max_pixel_place;
        if (bits.where.width == 0)
            bits.where = {0, 0, golden.width, golden.height, 0};  // zeros of other signs
        bits.golden = mean(golden, bits.where);
        bits.found = mean(found, bits.where);
    }
    Comparison result{{bits}, absolute_difference(golden, found), "largest difference"};
    std::vector<float>& severity = result.severity.pixels;
    float largest = 0.0f;
    for (const float each : severity) largest = std::max(largest, each);
    // A division would make NaN of infinite differences.
    for (float& each : severity)
        each = each == largest && largest > 0.0f ? 1.0f : each / std::max(largest, 1e-30f);
    return result;
}

}  // namespace automorph::render
