// libFuzzer target of the config parser.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "morph/mesh/errors.h"
#include "render/figure/config.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        automorph::parse_config({reinterpret_cast<const char*>(data), size}, "fuzz.yaml");
    } catch (const automorph::ConfigError& error) {
        const std::string_view message = error.what();
        if (message.rfind("fuzz.yaml", 0) != 0 || message.find('\n') != std::string_view::npos)
            __builtin_trap();
    }
    return 0;
}
