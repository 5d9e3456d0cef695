#include "render/compare/comparison.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace automorph::render {
namespace {

double share_of_limit(const TestResult& test) {
    if (test.value <= test.limit && test.limit == 0.0) return 0.0;
    const double share = test.value / test.limit;
    return share >= 0.0 ? share : std::numeric_limits<double>::infinity();
}

}  // namespace

bool Comparison::same() const {
    return std::all_of(tests.begin(), tests.end(), [](const TestResult& test) { return test.passed(); });
}

const TestResult& Comparison::worst() const {
    assert(!tests.empty());
    return *std::max_element(tests.begin(), tests.end(), [](const TestResult& a, const TestResult& b) {
        return share_of_limit(a) < share_of_limit(b);
    });
}

}  // namespace automorph::render
