#pragma once

#include <cstddef>

namespace automorph {

/// An index that is known not to be negative, as containers want it.
constexpr std::size_t at(int index) {
    return static_cast<std::size_t>(index);
}

}  // namespace automorph
