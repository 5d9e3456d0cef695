#include "tests/render/figure/golden.h"

#include <algorithm>

namespace golden {

using namespace automorph;

const std::vector<std::string>& names() {
    static const std::vector<std::string> all{"fig1", "fig2", "fig3", "fig4",     "fig5",
                                              "fig6", "fig7", "fig8", "materials"};
    return all;
}

FigureConfig config(const std::string& name) {
    FigureConfig config = load_config(std::string(AUTOMORPH_CONFIGS "/") + name + ".yaml");
    // So few that a single triangle is worth a pixel; closed shapes are smaller in their cells.
    const int most = name == "fig7" ? 1500 : 5000;
    for (MeshConfig* mesh : {&config.source, &config.target})
        mesh->triangles = std::min(mesh->triangles, most);
    if (config.show == Show::Morph && name != "fig7") config.alphas = {0, 0.5, 1};
    // All cells of a golden are 80 pixels wide, whatever the config prints.
    constexpr int kWidth = 400;
    config.picture.height = config.picture.height * kWidth / config.picture.width;
    config.picture.width = kWidth;
    return config;
}

FigureOptions options() {
    FigureOptions options;
    options.check_frames = false;
    options.spp = 16;
    options.scale = 0.2;
    options.embree_config = "isa=sse4.2";
    return options;
}

std::filesystem::path file(const std::string& name, std::size_t row, std::size_t column) {
    return std::filesystem::path(AUTOMORPH_GOLDEN) / name / (cell_name(row, column) + ".exr");
}

}  // namespace golden
