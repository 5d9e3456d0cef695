#include "render/figure/suggestion.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace automorph {
namespace {

/// Levenshtein distance.
std::size_t edit_distance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
        }
    }
    return row[b.size()];
}

bool begins(const std::string& text, const std::string& with) {
    return text.compare(0, with.size(), with) == 0;
}

}  // namespace

std::string suggestion(const std::string& name, const std::vector<std::string>& names) {
    std::string best;
    std::size_t smallest = std::max<std::size_t>(2, name.size() / 2) + 1;
    for (const std::string& each : names) {
        constexpr std::size_t kLeastStem = 3;
        const bool stem =
            std::min(name.size(), each.size()) >= kLeastStem && (begins(each, name) || begins(name, each));
        const std::size_t distance = stem ? 1 : edit_distance(name, each);
        if (distance < smallest) {
            smallest = distance;
            best = each;
        }
    }
    return best.empty() ? "" : fmt::format("; did you mean '{}'?", best);
}

}  // namespace automorph
