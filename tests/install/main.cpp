// Morphs two shapes, writes the animation and renders the frame half way: a use of all that is installed.

#include <cstdio>

#include "morph/export/write_glb.h"
#include "morph/frame_check.h"
#include "morph/mesh/io.h"
#include "morph/morph.h"
#include "morph/shapes/shapes.h"
#include "render/camera/framing.h"
#include "render/integrator/render.h"
#include "render/studio/studio.h"

using namespace automorph;

int main() {
    const InputMesh a = admit_mesh(ellipsoid({1, 0.8, 0.5}, {.triangles = 300}), "a"),
                    b = admit_mesh(star({}, {.triangles = 300}), "b");
    const Morph m = morph(a, b);
    write_mesh("half.ply", m.mesh(0.5));
    write_glb("m.glb", m.triangles(), m.endpoints());

    const Points V = m.frame(0.5);
    render::Scene scene;
    scene.add_mesh(V, m.triangles(), {.material = render::clay()});
    const render::Camera camera = render::frame_all({V});
    render::Bounds bounds;
    bounds.add(V);
    render::add_studio(scene, camera, bounds);
    const render::RenderResult picture = render::render(scene, camera, {.width = 32, .height = 32, .spp = 4});

    const PolygonSoup read = read_mesh("half.ply");
    // Not this machine's caches: see same_bits in the main CMakeLists.txt.
    const bool same_bits = Eigen::l1CacheSize() == 32 * 1024;
    const bool good = same_bits && read.V == V && m.report().overlays.size() == 1 &&
                      picture.samples == 32 * 32 * 4 && picture.bad_samples == 0 &&
                      picture.rays > picture.samples;
    std::printf("%d vertices, %d triangles, %llu rays: %s\n", static_cast<int>(V.rows()),
                static_cast<int>(m.triangles().rows()), static_cast<unsigned long long>(picture.rays),
                good ? "good" : "WRONG");
    return good ? 0 : 1;
}
