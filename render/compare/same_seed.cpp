#include "render/compare/same_seed.h"

#include <algorithm>

#include "render/compare/difference.h"

namespace automorph::render {

Comparison compare_same_seed(const Image& golden, const Image& found, const SameSeedLimits& limits) {
    const Difference difference = compare(golden, found);
    Comparison result{{}, absolute_difference(golden, found), "outlier"};

    TestResult rmse;
    rmse.name = "rmse";
    rmse.value = difference.rmse;
    rmse.limit = limits.rmse;
    rmse.where = difference.max_block_place;

    TestResult outliers;
    outliers.name = "outliers";
    outliers.value =
        static_cast<double>(std::count_if(result.severity.pixels.begin(), result.severity.pixels.end(),
                                          [&](float pixel) { return !(pixel <= limits.outlier); }));
    outliers.limit = limits.outliers;
    outliers.where = difference.max_pixel_place;

    for (TestResult* test : {&rmse, &outliers}) {
        test->golden = mean(golden, test->where);
        test->found = mean(found, test->where);
        result.tests.push_back(*test);
    }
    for (float& each : result.severity.pixels) each /= static_cast<float>(limits.outlier);
    return result;
}

}  // namespace automorph::render
