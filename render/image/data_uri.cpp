#include "render/image/data_uri.h"

#include <OpenImageIO/strutil.h>
#include <fmt/format.h>

#include <fstream>
#include <iterator>

#include "morph/mesh/errors.h"

namespace automorph::render {

std::string data_uri(std::string_view type, std::string_view bytes) {
    return fmt::format("data:{};base64,{}", type,
                       OIIO::Strutil::base64_encode(OIIO::string_view(bytes.data(), bytes.size())));
}

std::string file_data_uri(std::string_view type, const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    if (!stream) throw IoError(fmt::format("{}: it cannot be read", file.string()));
    return data_uri(type, bytes);
}

}  // namespace automorph::render
