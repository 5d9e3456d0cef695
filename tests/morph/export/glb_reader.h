#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "morph/mesh/mesh.h"

namespace automorph::test {

/// A .glb as a player sees it: read and evaluated from the specification alone, in double.
class GlbFile {
public:
    /// Reads the container and checks its framing: magic, version, lengths, padding, kinds of chunk.
    /// @throws std::runtime_error naming what is wrong
    explicit GlbFile(const std::filesystem::path& file);

    const nlohmann::json& json() const { return json_; }

    /// Elements of an accessor, one per row. Checks that it lies within its view and is aligned, and that its
    /// min and max, if given, are those of the data.
    Eigen::MatrixXd accessor(int index) const;

    Triangles triangles() const;

    /// The only mesh's vertices in the scene's coordinates at a time of the animation.
    Points positions(double time) const;

    /// Its normals, unit length.
    Points normals(double time) const;

    /// Time of the last key.
    double duration() const;

private:
    Points blended(const std::string& attribute, double time) const;
    Eigen::Affine3d node_to_scene(double time) const;
    /// Value of a channel of the animation at a time; the default if no channel has this path.
    Eigen::VectorXd channel(const std::string& path, double time, const Eigen::VectorXd& otherwise) const;

    nlohmann::json json_;
    std::string binary_;
};

}  // namespace automorph::test
