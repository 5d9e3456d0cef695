#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace automorph {

/// A file in memory and what errors call it.
struct FileBytes {
    std::string_view bytes;
    std::string name;
};

/// Coordinates beyond this are taken for damage: the product of six lengths (a squared volume) must stay
/// finite.
inline constexpr double kLargestCoordinate = 1e50;

/// A piece of the file for an error message: in quotes, shortened, without control characters.
std::string quoted(std::string_view text);

struct TextRules {
    char comment = '\0';           ///< starts a comment that ends with the line; 0: there are none
    bool backslash_joins = false;  ///< a backslash before the end of a line continues it on the next
};

/// Walks through a text file token by token and knows the line for errors. LF, CR LF and CR end a line.
class TextCursor {
public:
    TextCursor(const FileBytes& file, TextRules rules);

    /// Next token, on this or a later line; empty at the end of the file.
    std::string_view token();
    /// Next token on the current line; empty at its end.
    std::string_view token_on_line();
    /// Moves to the beginning of the next line.
    void skip_line();
    /// True if nothing but blanks and comments follows.
    bool at_end();

    /// Next token as a finite coordinate. `what` says what is read, e.g. "x of vertex"; `index` is its
    /// number.
    double coordinate(std::string_view what, std::int64_t index) {
        return to_coordinate(token(), what, index);
    }
    double to_coordinate(std::string_view token, std::string_view what, std::int64_t index) const;
    /// Next token as an integer.
    std::int64_t integer(std::string_view what, std::int64_t index);

    int line() const { return line_; }
    std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - at_); }
    std::string_view rest() const { return {at_, bytes_left()}; }

    /// @throws IoError with `name:line: message`, at the line of the last token
    [[noreturn]] void fail(const std::string& message) const;

private:
    void skip_blanks();  ///< on the current line
    void newline();
    bool at_line_end() const { return at_ == end_ || *at_ == '\n' || *at_ == '\r'; }
    [[noreturn]] void fail_number(std::string_view token, std::string_view what, std::int64_t index,
                                  std::string_view expected) const;

    const std::string* name_;
    const char* at_;
    const char* end_;
    TextRules rules_;
    int line_ = 1;
    int token_line_ = 1;
};

/// A number as text formats write it: an optional sign, decimal digits, exponent, or nan / inf.
/// @return false if the token is not a number; a number too large for double gives infinity, too small gives
/// 0
bool parse_number(std::string_view token, double& value);

/// @return false if the token is not an integer that fits
bool parse_integer(std::string_view token, std::int64_t& value);

}  // namespace automorph
