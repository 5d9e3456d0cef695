#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "morph/mesh/errors.h"
#include "morph/mesh/text_cursor.h"

namespace automorph {

/// Walks through binary data of a stated byte order and knows the byte for errors.
class BinaryCursor {
public:
    BinaryCursor(const FileBytes& file, std::size_t offset, std::endian order)
        : file_(file), at_(offset), swap_(order != std::endian::native) {}

    std::size_t bytes_left() const { return file_.bytes.size() - at_; }
    std::string_view rest() const { return file_.bytes.substr(at_); }
    void skip(std::size_t bytes) { at_ += std::min(bytes, bytes_left()); }

    /// Next value; `what` and `index` say what the file should hold here.
    template <class T>
    T value(std::string_view what, std::int64_t index) {
        static_assert(std::is_arithmetic_v<T>);
        if (bytes_left() < sizeof(T)) fail(fmt::format("the file ends within {} {}", what, index));
        std::array<char, sizeof(T)> raw{};
        std::memcpy(raw.data(), file_.bytes.data() + at_, sizeof(T));
        if (swap_) std::reverse(raw.begin(), raw.end());
        at_ += sizeof(T);
        return std::bit_cast<T>(raw);
    }

    /// Next value as a finite coordinate.
    template <class T>
    double coordinate(std::string_view what, std::int64_t index) {
        return checked(static_cast<double>(value<T>(what, index)), what, index);
    }

    double checked(double value, std::string_view what, std::int64_t index) const {
        if (!(std::abs(value) <= kLargestCoordinate)) {
            fail(fmt::format("{} {}: expected a finite coordinate, found {}", what, index, value));
        }
        return value;
    }

    /// @throws IoError with `name: byte N: message`
    [[noreturn]] void fail(const std::string& message) const {
        throw IoError(fmt::format("{}: byte {}: {}", file_.name, at_, message));
    }

private:
    const FileBytes& file_;
    std::size_t at_;
    bool swap_;
};

}  // namespace automorph
