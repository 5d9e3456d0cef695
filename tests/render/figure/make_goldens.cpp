// Renders the golden pictures anew: `./run goldens`, or those of the figures named as arguments alone. Say in
// CHANGELOG.md why they moved.

#include <cstdio>
#include <exception>
#include <string>
#include <vector>

#include "morph/mesh/write_file.h"
#include "render/image/image_file.h"
#include "tests/render/figure/golden.h"

namespace {

void make(const std::string& name) {
    const automorph::Figure figure = automorph::render_figure(golden::config(name), golden::options());
    automorph::make_folder(golden::file(name, 0, 0).parent_path());
    for (std::size_t i = 0; i < figure.rows.size(); ++i) {
        for (std::size_t j = 0; j < figure.rows[i].cells.size(); ++j) {
            automorph::render::write_exr(golden::file(name, i, j), figure.rows[i].cells[j].image);
            std::printf("%s\n", golden::file(name, i, j).c_str());
        }
    }
}

}  // namespace

int main(int count, char** values) {
    try {
        std::vector<std::string> names(values + 1, values + count);
        if (names.empty()) names = golden::names();
        for (const std::string& name : names) make(name);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "make_goldens: %s\n", error.what());
        return 1;
    }
}
