#pragma once

#include <string>
#include <string_view>

namespace automorph::render {

/// "data:image/jpeg;base64,...", for pages that hold their pictures and videos.
/// @param type  e.g. "image/jpeg"
std::string data_uri(std::string_view type, std::string_view bytes);

}  // namespace automorph::render
