#include "render/image/data_uri.h"

#include <OpenImageIO/strutil.h>
#include <fmt/format.h>

namespace automorph::render {

std::string data_uri(std::string_view type, std::string_view bytes) {
    return fmt::format("data:{};base64,{}", type,
                       OIIO::Strutil::base64_encode(OIIO::string_view(bytes.data(), bytes.size())));
}

}  // namespace automorph::render
