#include "tests/morph/export/glb_reader.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <vector>

namespace automorph::test {

namespace {

using Json = nlohmann::json;

void require(bool holds, const std::string& what) {
    if (!holds) throw std::runtime_error("glb: " + what);
}

// Tests run on little-endian machines; the file is little-endian.
template <class T>
T read(const std::string& bytes, std::size_t at) {
    require(at + sizeof(T) <= bytes.size(), "read beyond the end");
    T value;
    std::memcpy(&value, bytes.data() + at, sizeof(T));
    return value;
}

Eigen::VectorXd numbers(const Json& list) {
    Eigen::VectorXd values(static_cast<Eigen::Index>(list.size()));
    for (std::size_t i = 0; i < list.size(); ++i)
        values[static_cast<Eigen::Index>(i)] = list[i].get<double>();
    return values;
}

Eigen::Affine3d transform(const Eigen::Vector3d& translation, const Eigen::Vector4d& rotation) {
    const Eigen::Quaterniond q(rotation[3], rotation[0], rotation[1], rotation[2]);
    return Eigen::Translation3d(translation) * q;
}

Eigen::VectorXd node_value(const Json& node, const char* key, const Eigen::VectorXd& otherwise) {
    return node.contains(key) ? numbers(node[key]) : otherwise;
}

}  // namespace

GlbFile::GlbFile(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    require(bytes.substr(0, 4) == "glTF", "magic");
    require(read<std::uint32_t>(bytes, 4) == 2, "version");
    require(read<std::uint32_t>(bytes, 8) == bytes.size(), "length");
    const auto json_length = read<std::uint32_t>(bytes, 12);
    require(bytes.substr(16, 4) == "JSON", "first chunk");
    require(json_length % 4 == 0, "padding of the first chunk");
    json_ = Json::parse(bytes.substr(20, json_length));
    const std::size_t second = 20 + json_length;
    const auto binary_length = read<std::uint32_t>(bytes, second);
    require(bytes.substr(second + 4, 4) == std::string("BIN\0", 4), "second chunk");
    require(binary_length % 4 == 0 && second + 8 + binary_length == bytes.size(),
            "length of the second chunk");
    binary_ = bytes.substr(second + 8);
    require(json_["buffers"].size() == 1 && json_["buffers"][0]["byteLength"] == binary_length &&
                !json_["buffers"][0].contains("uri"),
            "buffer");
    require(json_["asset"]["version"] == "2.0", "asset version");
}

Eigen::MatrixXd GlbFile::accessor(int index) const {
    const Json& accessor = json_["accessors"].at(static_cast<std::size_t>(index));
    const Json& view = json_["bufferViews"].at(accessor["bufferView"].get<std::size_t>());
    const std::string type = accessor["type"];
    const Eigen::Index columns = type == "SCALAR" ? 1 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 0;
    require(columns > 0, "type of an accessor");
    const bool floats = accessor["componentType"] == 5126;
    require(floats || accessor["componentType"] == 5125, "component type of an accessor");
    const auto count = accessor["count"].get<Eigen::Index>();
    const auto start = view["byteOffset"].get<std::size_t>();
    require(start % 4 == 0, "alignment");
    require(static_cast<std::size_t>(count * columns) * 4 == view["byteLength"].get<std::size_t>(),
            "length of a view");
    Eigen::MatrixXd values(count, columns);
    for (Eigen::Index i = 0; i < count; ++i) {
        for (Eigen::Index k = 0; k < columns; ++k) {
            const std::size_t place = start + static_cast<std::size_t>(i * columns + k) * 4;
            values(i, k) = floats ? static_cast<double>(read<float>(binary_, place))
                                  : static_cast<double>(read<std::uint32_t>(binary_, place));
        }
    }
    require(values.allFinite(), "a number that is none");
    if (accessor.contains("min")) {
        require(numbers(accessor["min"]) == values.colwise().minCoeff().transpose() &&
                    numbers(accessor["max"]) == values.colwise().maxCoeff().transpose(),
                "min or max of an accessor");
    }
    return values;
}

Triangles GlbFile::triangles() const {
    const Eigen::MatrixXd indices = accessor(json_["meshes"].at(0)["primitives"].at(0)["indices"]);
    Triangles F(indices.rows() / 3, 3);
    for (Eigen::Index i = 0; i < indices.rows(); ++i) F.data()[i] = static_cast<int>(indices(i, 0));
    return F;
}

Eigen::VectorXd GlbFile::channel(const std::string& path, double time,
                                 const Eigen::VectorXd& otherwise) const {
    const Json& animation = json_["animations"].at(0);
    for (const Json& each : animation["channels"]) {
        if (each["target"]["path"] != path) continue;
        require(each["target"]["node"] == 1, "animated node");
        const Json& sampler = animation["samplers"].at(each["sampler"].get<std::size_t>());
        require(sampler.value("interpolation", "LINEAR") == "LINEAR", "interpolation");
        const Eigen::VectorXd times = accessor(sampler["input"]).col(0);
        Eigen::MatrixXd keys = accessor(sampler["output"]);
        if (path == "weights") {  // one after the other, not as rows
            const Eigen::Index width = keys.rows() / times.size();
            keys = Eigen::MatrixXd(keys.reshaped(width, times.size()).transpose());
        }
        require(keys.rows() == times.size(), "number of keys");
        for (Eigen::Index k = 1; k < times.size(); ++k) require(times[k - 1] < times[k], "order of times");

        if (time <= times[0]) return keys.row(0);
        if (time >= times[times.size() - 1]) return keys.row(keys.rows() - 1);
        const Eigen::Index next = std::upper_bound(times.begin(), times.end(), time) - times.begin();
        const double part = (time - times[next - 1]) / (times[next] - times[next - 1]);
        if (path != "rotation") return (1 - part) * keys.row(next - 1) + part * keys.row(next);
        const Eigen::Quaterniond from(Eigen::Vector4d(keys.row(next - 1))),
            to(Eigen::Vector4d(keys.row(next)));
        require(std::abs(from.norm() - 1) < 1e-6 && std::abs(to.norm() - 1) < 1e-6, "length of a quaternion");
        return from.normalized().slerp(part, to.normalized()).coeffs();
    }
    return otherwise;
}

Eigen::Affine3d GlbFile::node_to_scene(double time) const {
    require(json_["scenes"].at(json_["scene"].get<std::size_t>())["nodes"] == Json::array({0}), "scene");
    const Json &root = json_["nodes"].at(0), &node = json_["nodes"].at(1);
    require(root["children"] == Json::array({1}) && node["mesh"] == 0, "nodes");
    const Eigen::Vector3d none = Eigen::Vector3d::Zero();
    const Eigen::Vector4d unturned(0, 0, 0, 1);
    return transform(node_value(root, "translation", none), node_value(root, "rotation", unturned)) *
           transform(channel("translation", time, node_value(node, "translation", none)),
                     channel("rotation", time, node_value(node, "rotation", unturned)));
}

Points GlbFile::blended(const std::string& attribute, double time) const {
    const Json& primitive = json_["meshes"].at(0)["primitives"].at(0);
    const Eigen::VectorXd weights = channel("weights", time, numbers(json_["meshes"].at(0)["weights"]));
    require(weights.size() == static_cast<Eigen::Index>(primitive["targets"].size()), "number of weights");
    Points rows = accessor(primitive["attributes"][attribute]);
    for (Eigen::Index k = 0; k < weights.size(); ++k) {
        rows +=
            weights[k] * Points(accessor(primitive["targets"].at(static_cast<std::size_t>(k))[attribute]));
    }
    return rows;
}

Points GlbFile::positions(double time) const {
    require(json_["accessors"]
                .at(json_["meshes"][0]["primitives"][0]["attributes"]["POSITION"].get<std::size_t>())
                .contains("min"),
            "positions need min and max");
    const Eigen::Affine3d move = node_to_scene(time);
    const Points rows = blended("POSITION", time);
    return (rows * move.linear().transpose()).rowwise() + move.translation().transpose();
}

Points GlbFile::normals(double time) const {
    return blended("NORMAL", time).rowwise().normalized() * node_to_scene(time).linear().transpose();
}

double GlbFile::duration() const {
    double last = 0;
    for (const Json& sampler : json_["animations"].at(0)["samplers"]) {
        last = std::max(last, accessor(sampler["input"]).maxCoeff());
    }
    return last;
}

}  // namespace automorph::test
