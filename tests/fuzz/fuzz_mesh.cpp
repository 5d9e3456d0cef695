// libFuzzer target of one reader, named by AUTOMORPH_FUZZ_EXTENSION, and of what becomes of its soups.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "morph/mesh/admit.h"
#include "morph/mesh/errors.h"
#include "morph/mesh/io.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string name = std::string("fuzz") + AUTOMORPH_FUZZ_EXTENSION;
    try {
        automorph::admit(automorph::parse_mesh({reinterpret_cast<const char*>(data), size}, name), name);
    } catch (const automorph::Error& error) {
        // One line that names the file; anything else is a finding.
        const std::string_view message = error.what();
        if (message.rfind(name, 0) != 0 || message.find('\n') != std::string_view::npos) __builtin_trap();
    }
    return 0;
}
