#include "morph/mesh/text_cursor.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdlib>

#include "morph/mesh/errors.h"

namespace automorph {

namespace {

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

std::string_view without_plus(std::string_view token) {
    if (token.size() > 1 && token[0] == '+' && token[1] != '-') token.remove_prefix(1);
    return token;
}

}  // namespace

std::string quoted(std::string_view text) {
    constexpr std::size_t kLongest = 40;
    std::string out = "'";
    for (const char c : text.substr(0, kLongest)) {
        const auto u = static_cast<unsigned char>(c);
        out += u < 0x20 || u >= 0x7f ? '?' : c;
    }
    return out + (text.size() > kLongest ? "...'" : "'");
}

bool parse_number(std::string_view token, double& value) {
    token = without_plus(token);
    const auto [stop, error] = std::from_chars(token.data(), token.data() + token.size(), value);
    if (stop != token.data() + token.size() || error == std::errc::invalid_argument) return false;
    // Out of range means too large or too small, and from_chars does not say which.
    if (error == std::errc::result_out_of_range) value = std::strtod(std::string(token).c_str(), nullptr);
    return true;
}

bool parse_integer(std::string_view token, std::int64_t& value) {
    token = without_plus(token);
    const auto [stop, error] = std::from_chars(token.data(), token.data() + token.size(), value);
    return error == std::errc() && stop == token.data() + token.size();
}

TextCursor::TextCursor(const FileBytes& file, TextRules rules)
    : name_(&file.name), at_(file.bytes.data()), end_(file.bytes.data() + file.bytes.size()), rules_(rules) {
    if (file.bytes.starts_with("\xEF\xBB\xBF")) at_ += 3;  // UTF-8 byte order mark
}

void TextCursor::newline() {
    if (at_ == end_) return;
    if (*at_ == '\r' && at_ + 1 != end_ && at_[1] == '\n') ++at_;
    ++at_;
    ++line_;
}

void TextCursor::skip_blanks() {
    while (at_ != end_) {
        if (is_blank(*at_)) {
            ++at_;
        } else if (rules_.comment != '\0' && *at_ == rules_.comment) {
            while (!at_line_end()) ++at_;
        } else if (rules_.backslash_joins && *at_ == '\\' && at_ + 1 != end_ &&
                   (at_[1] == '\n' || at_[1] == '\r')) {
            ++at_;
            newline();
        } else {
            return;
        }
    }
}

std::string_view TextCursor::token_on_line() {
    skip_blanks();
    token_line_ = line_;
    const char* first = at_;
    while (!at_line_end() && !is_blank(*at_)) {
        if (rules_.comment != '\0' && *at_ == rules_.comment) break;
        if (rules_.backslash_joins && *at_ == '\\' && at_ + 1 != end_ && (at_[1] == '\n' || at_[1] == '\r'))
            break;
        ++at_;
    }
    return {first, static_cast<std::size_t>(at_ - first)};
}

std::string_view TextCursor::token() {
    for (;;) {
        const std::string_view found = token_on_line();
        if (!found.empty() || at_ == end_) return found;
        newline();
    }
}

void TextCursor::skip_line() {
    while (!at_line_end()) {
        if (rules_.backslash_joins && *at_ == '\\' && at_ + 1 != end_ && (at_[1] == '\n' || at_[1] == '\r')) {
            ++at_;
            newline();
        } else {
            ++at_;
        }
    }
    newline();
}

bool TextCursor::at_end() {
    for (;;) {
        skip_blanks();
        if (at_ == end_) return true;
        if (!at_line_end()) return false;
        newline();
    }
}

double TextCursor::to_coordinate(std::string_view text, std::string_view what, std::int64_t index) const {
    double value = 0.0;
    if (!parse_number(text, value)) fail_number(text, what, index, "a number");
    if (!(std::abs(value) <= kLargestCoordinate)) fail_number(text, what, index, "a finite coordinate");
    return value;
}

std::int64_t TextCursor::integer(std::string_view what, std::int64_t index) {
    const std::string_view text = token();
    std::int64_t value = 0;
    if (!parse_integer(text, value)) fail_number(text, what, index, "an integer");
    return value;
}

void TextCursor::fail_number(std::string_view token, std::string_view what, std::int64_t index,
                             std::string_view expected) const {
    const std::string item = index < 0 ? std::string(what) : fmt::format("{} {}", what, index);
    if (token.empty()) fail(fmt::format("the file ends where {} should be", item));
    double value = 0.0;
    if (expected == "a finite coordinate" && parse_number(token, value) && std::isfinite(value)) {
        fail(fmt::format("{} is {}, beyond {:g}: the file is damaged or the mesh must be rescaled", item,
                         quoted(token), kLargestCoordinate));
    }
    fail(fmt::format("{}: expected {}, found {}", item, expected, quoted(token)));
}

void TextCursor::fail(const std::string& message) const {
    throw IoError(fmt::format("{}:{}: {}", *name_, token_line_, message));
}

}  // namespace automorph
