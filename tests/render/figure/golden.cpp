#include "tests/render/figure/golden.h"

namespace golden {

automorph::FigureConfig config() {
    return automorph::load_config(AUTOMORPH_CONFIGS "/fig7.yaml");
}

automorph::FigureOptions options() {
    automorph::FigureOptions options;
    options.spp = 16;
    options.scale = 0.2;  // 80 x 80 pixels
    options.embree_config = "isa=sse4.2";
    return options;
}

std::filesystem::path file(std::size_t row, std::size_t column) {
    return std::filesystem::path(AUTOMORPH_GOLDEN) / "fig7" / (automorph::cell_name(row, column) + ".exr");
}

}  // namespace golden
