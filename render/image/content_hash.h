#pragma once

#include <string>
#include <string_view>

namespace automorph::render {

/// SHA-1 as 40 hexadecimal digits: tells whether contents are the same, no protection against forgery.
std::string content_hash(std::string_view bytes);

}  // namespace automorph::render
