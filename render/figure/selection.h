#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace automorph {

/// Some of a numbered list, written "1,3-4", counting from 1. Empty: all.
class Selection {
public:
    Selection() = default;

    /// @throws ConfigError with what was found, unless the text is numbers and ascending ranges with commas
    /// between
    explicit Selection(const std::string& text);

    bool has(std::size_t index) const;  ///< @param index  from 0
    bool empty() const { return ranges_.empty(); }
    const std::string& text() const { return text_; }  ///< as it was written

    /// @throws ConfigError if something beyond the `count` there are is selected
    /// @param what  plural of what is numbered, for the message
    void check(std::size_t count, const std::string& what) const;

private:
    std::string text_;
    std::vector<std::pair<std::size_t, std::size_t>> ranges_;  // from 1, both ends included
};

}  // namespace automorph
