#pragma once

#include <fmt/format.h>

#include <charconv>
#include <string>

#include "morph/mesh/errors.h"

namespace automorph::bench {

/// The whole of `text` as a number of at least `least`.
/// @param option  whose value it is, for the message
/// @throws ConfigError
template <class Number>
Number number_of(const std::string& option, const std::string& text, Number least) {
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !(value >= least))
        throw ConfigError(fmt::format("{} takes a number of at least {}, not '{}'", option, least, text));
    return value;
}

}  // namespace automorph::bench
