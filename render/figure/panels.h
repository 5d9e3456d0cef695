#pragma once

#include <array>
#include <string>
#include <vector>

#include "morph/maps.h"
#include "morph/morph.h"
#include "render/camera/camera.h"
#include "render/figure/subject.h"
#include "render/image/canvas.h"
#include "render/image/text.h"

/// Drawn cells, each a function of what it shows.
namespace automorph {

/// Fig. 2: the shape as a picture with its visible edges, and its map as a triangulation shaded alike.
std::vector<FigureCell> map_panels(const Shooting& shooting, const InputMesh& shape, const ShapeMap& map);

/// How a map and its shape lie on the page; the axes of the page are right, up and towards the reader.
struct MapPose {
    Eigen::Matrix3d rays = Eigen::Matrix3d::Identity();   ///< from the domain to the page
    Eigen::Matrix3d shape = Eigen::Matrix3d::Identity();  ///< from the world to the page, for the light

    MapPose from_behind() const;
};

/// Turns a map about its centre such that it resembles the shape as the camera sees it; disks of surfaces
/// that show the camera their back are seen from behind.
MapPose upright_pose(const DomainMap& map, const render::Camera& camera);

/// Of a map onto the same domain: turned like `other`, so that the same spots are in the same places.
/// @param R  turns the map's shape to where the other's lies
MapPose pose_beside(const MapPose& other, const DomainMap& map, const Eigen::Matrix3d& R);

/// A map as a triangulation, shaded like its shape; of a sphere, the near side, with the border of an open
/// shape.
FigureCell map_drawing(const Shooting& shooting, const DomainMap& map, const MapPose& pose);

/// Fig. 3: the two borders on the circle, own vertices filled and inserted ones hollow, and a part of both
/// enlarged with labels.
std::vector<FigureCell> border_panels(const Shooting& shooting, const BorderInsertion& insertion);

/// A shape pictured once, to be marked as often as there are features to show.
class PicturedShape {
public:
    PicturedShape(const Shooting& shooting, const Mesh& mesh);

    const Mesh& mesh() const { return mesh_; }
    const FigureCell& picture() const { return picture_; }

    /// Whether the camera sees a vertex.
    bool sees(int vertex) const { return subject_.sees(mesh_.V.row(vertex), normals_.row(vertex)); }

private:
    const Mesh& mesh_;
    Points normals_;
    Subject subject_;
    FigureCell picture_;
};

/// Fig. 4: both shapes with their candidates; matched ones numbered, in the same colour on both.
std::vector<FigureCell> feature_panels(const Shooting& shooting, const PicturedShape& source,
                                       const PicturedShape& target,
                                       const std::vector<FeatureReport>& features);

namespace drawing {

inline const render::Color kInk{0.01f, 0.01f, 0.015f};
inline const render::Color kPaper{1.0f, 1.0f, 1.0f};
inline const render::Color kFaint{0.45f, 0.45f, 0.45f};

/// Distinct colours in a fixed order, again from the first after the last.
render::Color distinct_color(std::size_t index);

/// A label, drawn over what is there. @param size  font height in pixels
void label(render::Image& image, const Eigen::Vector2d& at, const std::string& text, int size,
           const render::Color& color = kInk);

/// Sizes that suit a cell: `share` of its smaller side, at least `least`.
double scaled(const Shooting& shooting, double share, double least);

}  // namespace drawing
}  // namespace automorph
