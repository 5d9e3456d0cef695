// Renders the golden pictures anew: `./run goldens`. Say in CHANGELOG.md why they moved.

#include <cstdio>
#include <exception>

#include "render/figure/text_file.h"
#include "render/image/image_file.h"
#include "tests/render/figure/golden.h"

int main() {
    try {
        const automorph::Figure figure = automorph::render_figure(golden::config(), golden::options());
        automorph::make_folder(golden::file(0, 0).parent_path());
        for (std::size_t i = 0; i < figure.rows.size(); ++i) {
            for (std::size_t j = 0; j < figure.rows[i].cells.size(); ++j) {
                automorph::render::write_exr(golden::file(i, j), figure.rows[i].cells[j].image);
                std::printf("%s\n", golden::file(i, j).c_str());
            }
        }
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "make_goldens: %s\n", error.what());
        return 1;
    }
}
