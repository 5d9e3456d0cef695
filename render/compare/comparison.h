#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/film/image.h"

/// What the ways to compare two pictures have in common: their answer.
namespace automorph::render {

/// A rectangle of pixels and one channel of it.
struct Place {
    int x = 0, y = 0;           ///< of the upper left pixel
    int width = 0, height = 0;  ///< pixels
    int channel = 0;            ///< 0, 1, 2: red, green, blue, or as TestResult::channels says
};

/// One test of a comparison: it fails where `value` is above `limit`.
struct TestResult {
    std::string name;
    double value = 0.0;  ///< largest of the picture
    double limit = 0.0;
    Place where;                        ///< of the largest value
    double golden = 0.0, found = 0.0;   ///< mean of both pictures there, radiance if nothing else is said
    std::optional<double> chance = {};  ///< upper bound of the probability that the noise of an unchanged
                                        ///< scene gives the picture so large a value; of noise tests
    std::vector<std::string> channels = {};  ///< what the channels of `where` are, if not the radiance's

    bool passed() const { return value <= limit; }  ///< false for NaN, too
};

struct Comparison {
    std::vector<TestResult> tests;
    Image severity;  ///< 1 channel: how far each pixel is on its way to `severity_unit`, which is 1
    std::string severity_unit;  ///< what a severity of 1 is, e.g. "limit"

    bool same() const;
    /// The test with the largest share of its limit, failed ones first. @pre there are tests
    const TestResult& worst() const;
};

}  // namespace automorph::render
