#include "render/image/image_module.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>

#include "morph/mesh/errors.h"

namespace automorph::render {

const ImageModule& load_image_module(const std::string& file) {
    const auto fail = [&](const std::string& why) {
        throw IoError(fmt::format(
            "{}: the program's part that reads and writes pictures cannot be loaded: {}; it is built and "
            "installed with the program, in lib/automorph beside the program's folder",
            file, why));
    };
    if (!std::filesystem::exists(file)) fail("there is no such file");
    void* module = dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);  // stays until the program ends
    if (module == nullptr) fail(dlerror());
    void* symbol = dlsym(module, "automorph_image_module");
    if (symbol == nullptr) fail(dlerror());
    return *reinterpret_cast<decltype(&automorph_image_module)>(symbol)();
}

const ImageModule& image_module() {
    static const ImageModule& module = [&]() -> const ImageModule& {
        const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe");
        return load_image_module(
            (program.parent_path().parent_path() / "lib/automorph/image_io.so").string());
    }();
    return module;
}

}  // namespace automorph::render
