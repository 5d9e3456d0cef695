#include "render/image/content_hash.h"

#include <OpenImageIO/hash.h>

#include <algorithm>
#include <cctype>

namespace automorph::render {

std::string content_hash(std::string_view bytes) {
    std::string digest = OIIO::SHA1::digest(bytes.data(), bytes.size());
    std::transform(digest.begin(), digest.end(), digest.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return digest;
}

}  // namespace automorph::render
