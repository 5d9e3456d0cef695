#include "render/figure/looks.h"

#include "render/figure/mesh_source.h"
#include "render/figure/picture_progress.h"
#include "render/figure/stopwatch.h"
#include "render/figure/subject.h"

namespace automorph {

PictureConfig look_on_stage(const StageConfig& stage, const LookConfig& look) {
    PictureConfig picture = stage.picture;
    picture.albedo = look.picture.albedo;
    picture.material = look.picture.material;
    picture.wireframe = look.picture.wireframe;
    picture.normals = look.picture.normals;
    return picture;
}

void picture_looks(const FigureConfig& config, const FigureOptions& options, Figure& figure) {
    const Stopwatch loading;
    const InputMesh shape = make_mesh(config.source, "source");
    figure.load_seconds = loading.seconds();
    figure.morphs.emplace_back().source = shape.report;
    std::vector<StageConfig> stages = config.stages;
    if (stages.empty()) stages.push_back({"", config.picture});
    std::size_t rows = 0, columns = 0;
    for (std::size_t i = 0; i < stages.size(); ++i) rows += options.rows.has(i);
    for (std::size_t j = 0; j < config.looks.size(); ++j) columns += options.cells.has(j);
    PictureProgress progress(options.progress, "pictures", "cell", rows * columns);
    std::size_t number = 0;
    for (std::size_t i = 0; i < stages.size(); ++i) {
        if (!options.rows.has(i)) continue;
        const StageConfig& stage = stages[i];
        FigureRow& row = figure.rows.emplace_back();
        row.config.label = stage.label;
        row.number = i;
        const Shooting of_stage =
            shooting_of(stage.picture, options, {figure.width, figure.height, figure.spp}, {&shape.mesh.V});
        figure.camera = of_stage.camera;
        for (std::size_t j = 0; j < config.looks.size(); ++j) {
            if (!options.cells.has(j)) continue;
            const LookConfig& look = config.looks[j];
            const PictureConfig picture = look_on_stage(stage, look);
            const Shooting shooting{.picture = picture,
                                    .options = options,
                                    .camera = of_stage.camera,
                                    .bounds = of_stage.bounds,
                                    .width = of_stage.width,
                                    .height = of_stage.height,
                                    .spp = of_stage.spp,
                                    .adaptive_error = of_stage.adaptive_error,
                                    .sky = of_stage.sky};
            FigureCell cell = Subject(shooting, shape.mesh.V, shape.mesh.F)
                                  .shoot(shape.mesh.V, progress.begin(++number, shooting.samples()));
            progress.end(cell.samples, cell.rays);
            cell.label = look.label;
            cell.column = j;
            row.cells.push_back(std::move(cell));
        }
    }
    progress.finish();
}

}  // namespace automorph
