#include "render/figure/selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "morph/mesh/errors.h"

namespace automorph {
namespace {

std::optional<std::size_t> number_of(const std::string& text) {
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || value == 0) return std::nullopt;
    return value;
}

}  // namespace

Selection::Selection(const std::string& text) : text_(text) {
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::string part = text.substr(begin, end - begin);
        const std::size_t dash = part.find('-');
        const auto first = number_of(part.substr(0, dash));
        const auto last = dash == std::string::npos ? first : number_of(part.substr(dash + 1));
        if (!first || !last || *last < *first) {
            throw ConfigError(fmt::format(
                "'{}': expected numbers from 1 and ascending ranges with commas between, e.g. 1,3-4", text));
        }
        ranges_.emplace_back(*first, *last);
        begin = end + 1;
    }
}

bool Selection::has(std::size_t index) const {
    return ranges_.empty() || std::any_of(ranges_.begin(), ranges_.end(), [&](const auto& range) {
               return range.first <= index + 1 && index + 1 <= range.second;
           });
}

void Selection::check(std::size_t count, const std::string& what) const {
    for (const auto& [first, last] : ranges_) {
        if (last > count) throw ConfigError(fmt::format("{} {}: there are {}", what, last, count));
    }
}

}  // namespace automorph
