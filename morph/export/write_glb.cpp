#include "morph/export/write_glb.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "morph/mesh/errors.h"
#include "morph/mesh/write_file.h"

// Section numbers are those of the glTF 2.0 specification (Khronos Group, ISO/IEC 12113:2022).

namespace automorph {

namespace {

using Json = nlohmann::ordered_json;
using Floats = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Sec. 3.6.1.1 and 3.6.2.2: what the numbers in the file mean.
constexpr int kUnsignedInt = 5125, kFloat = 5126, kArrayBuffer = 34962, kElementArrayBuffer = 34963;
// Sec. 4.4: "glTF", the version, the kinds of chunk.
constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

// Sizes whose squares single precision still holds, as normals and bounding spheres of viewers need them.
constexpr double kSmallestSize = 1e-15, kLargestSize = 1e15;

void append_little_endian(std::string& bytes, std::uint32_t value) {
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<char>((value >> shift) & 0xFF));
}

/// Numbers in the binary chunk, with the accessors (Sec. 5.1) and buffer views that describe them.
class Buffer {
public:
    /// Rows as elements; returns the accessor's index. Vertex data has the target kArrayBuffer, keys have 0.
    int add(const Floats& rows, const char* type, int target) {
        const int view = begin_view(target);
        for (Eigen::Index i = 0; i < rows.size(); ++i) {
            append_little_endian(bytes_, std::bit_cast<std::uint32_t>(rows.data()[i]));
        }
        end_view(view);
        Json low = Json::array(), high = Json::array();
        for (Eigen::Index k = 0; k < rows.cols(); ++k) {
            low.push_back(rows.col(k).minCoeff());
            high.push_back(rows.col(k).maxCoeff());
        }
        return add_accessor({{"bufferView", view},
                             {"componentType", kFloat},
                             {"count", rows.rows()},
                             {"type", type},
                             {"min", std::move(low)},
                             {"max", std::move(high)}});
    }

    int add(const Triangles& F) {
        const int view = begin_view(kElementArrayBuffer);
        for (Eigen::Index i = 0; i < F.size(); ++i) {
            append_little_endian(bytes_, static_cast<std::uint32_t>(F.data()[i]));
        }
        end_view(view);
        return add_accessor(
            {{"bufferView", view}, {"componentType", kUnsignedInt}, {"count", F.size()}, {"type", "SCALAR"}});
    }

    const std::string& bytes() const { return bytes_; }
    const Json& views() const { return views_; }
    const Json& accessors() const { return accessors_; }

private:
    int begin_view(int target) {
        views_.push_back({{"buffer", 0}, {"byteOffset", bytes_.size()}});
        if (target != 0) views_.back()["target"] = target;
        return static_cast<int>(views_.size()) - 1;
    }
    void end_view(int view) {
        Json& described = views_[static_cast<std::size_t>(view)];
        described["byteLength"] = bytes_.size() - described["byteOffset"].get<std::size_t>();
    }
    int add_accessor(Json accessor) {
        accessors_.push_back(std::move(accessor));
        return static_cast<int>(accessors_.size()) - 1;
    }

    std::string bytes_;
    Json views_ = Json::array(), accessors_ = Json::array();
};

Json attributes(Buffer& buffer, const Floats& positions, const Floats& normals) {
    return {{"POSITION", buffer.add(positions, "VEC3", kArrayBuffer)},
            {"NORMAL", buffer.add(normals, "VEC3", kArrayBuffer)}};
}

/// Targets are differences, Sec. 3.7.2.2: taken to the rounded base, so that base and difference add up.
Floats difference(const Points& target, const Floats& base) {
    return (target - base.cast<double>()).cast<float>();
}

Json mesh(Buffer& buffer, const Triangles& F, const MorphAnimation& animation, const std::string& name) {
    const Floats positions = animation.base.positions.cast<float>(),
                 normals = animation.base.normals.cast<float>();
    Json primitive = {{"attributes", attributes(buffer, positions, normals)},
                      {"indices", buffer.add(F)},
                      {"material", 0},
                      {"targets", Json::array()}};
    Json names = Json::array();
    for (const MorphAnimation::Shape& target : animation.targets) {
        primitive["targets"].push_back(
            attributes(buffer, difference(target.positions, positions), difference(target.normals, normals)));
        names.push_back(&target == &animation.targets.back() ? "target" : "middle");
    }
    return {{"name", name},
            {"primitives", Json::array({std::move(primitive)})},
            {"weights", animation.keys.front().weights},
            {"extras", {{"targetNames", std::move(names)}}}};
}

/// Adds channels that move node `node`, Sec. 3.11.
Json animate_node(Buffer& buffer, const MorphAnimation& animation, int node) {
    Json channels = Json::array(), samplers = Json::array();
    const auto add = [&](const char* path, int input, int output) {
        channels.push_back({{"sampler", samplers.size()}, {"target", {{"node", node}, {"path", path}}}});
        samplers.push_back({{"input", input}, {"interpolation", "LINEAR"}, {"output", output}});
    };
    const auto keys = static_cast<Eigen::Index>(animation.keys.size());
    const auto targets = static_cast<Eigen::Index>(animation.targets.size());
    Floats times(keys, 1), translations(keys, 3), weights(keys * targets, 1);
    for (Eigen::Index k = 0; k < keys; ++k) {
        const MorphAnimation::Key& key = animation.keys[static_cast<std::size_t>(k)];
        times(k, 0) = static_cast<float>(key.time);
        translations.row(k) = key.translation.transpose().cast<float>();
        for (Eigen::Index j = 0; j < targets; ++j) {
            weights(k * targets + j, 0) = static_cast<float>(key.weights[static_cast<std::size_t>(j)]);
        }
    }
    const int input = buffer.add(times, "SCALAR", 0);
    add("translation", input, buffer.add(translations, "VEC3", 0));
    add("weights", input, buffer.add(weights, "SCALAR", 0));

    if (!animation.turns.empty()) {
        const auto turns = static_cast<Eigen::Index>(animation.turns.size());
        Floats turn_times(turns, 1), rotations(turns, 4);  // x, y, z, w
        for (Eigen::Index k = 0; k < turns; ++k) {
            const MorphAnimation::Turn& turn = animation.turns[static_cast<std::size_t>(k)];
            turn_times(k, 0) = static_cast<float>(turn.time);
            rotations.row(k) = turn.rotation.coeffs().transpose().cast<float>();
        }
        const int turn_input = buffer.add(turn_times, "SCALAR", 0);
        add("rotation", turn_input, buffer.add(rotations, "VEC4", 0));
    }
    return {{"name", "morph"}, {"channels", std::move(channels)}, {"samplers", std::move(samplers)}};
}

/// Turns the up axis to glTF's y, then moves the centre where it belongs: (x, y, z) -> (x, z, -y) for z.
Json static_node(const Eigen::Vector3d& offset, UpAxis up) {
    Json node = {{"name", "automorph"}, {"children", Json::array({1})}};
    if (up == UpAxis::Y) {
        node["translation"] = {offset.x(), offset.y(), offset.z()};
    } else {
        const double half = std::sqrt(0.5);
        node["translation"] = {offset.x(), offset.z(), -offset.y()};
        node["rotation"] = {-half, 0.0, 0.0, half};
    }
    return node;
}

Json moved_node(const MorphAnimation& animation, const std::string& name) {
    const Eigen::Vector3d& start = animation.keys.front().translation;
    return {{"name", name}, {"mesh", 0}, {"translation", {start.x(), start.y(), start.z()}}};
}

/// Unglazed clay, seen from both sides: open shapes show their inside.
Json material() {
    return {
        {"name", "clay"},
        {"pbrMetallicRoughness",
         {{"baseColorFactor", {0.77, 0.70, 0.63, 1.0}}, {"metallicFactor", 0.0}, {"roughnessFactor", 0.6}}},
        {"doubleSided", true}};
}

/// Sec. 4.4: a header and two chunks, each padded to four bytes.
std::string container(std::string json, std::string binary, const std::string& file) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    binary.resize((binary.size() + 3) / 4 * 4, '\0');
    const std::size_t total = 12 + 8 + json.size() + 8 + binary.size();
    if (total > std::numeric_limits<std::uint32_t>::max()) {
        throw IoError(fmt::format(
            "{}: not written: it would have {} bytes, and a .glb holds 4 GB; decimate the meshes, or write "
            "numbered .ply files",
            file, total));
    }
    std::string bytes;
    bytes.reserve(total);
    for (const std::uint32_t word : {kMagic, kVersion, static_cast<std::uint32_t>(total),
                                     static_cast<std::uint32_t>(json.size()), kJsonChunk}) {
        append_little_endian(bytes, word);
    }
    bytes += json;
    append_little_endian(bytes, static_cast<std::uint32_t>(binary.size()));
    append_little_endian(bytes, kBinaryChunk);
    bytes += binary;
    return bytes;
}

void check_size(const MorphAnimation& animation, const std::string& file) {
    double size = animation.offset.cwiseAbs().maxCoeff(), smallest = std::numeric_limits<double>::infinity();
    const auto look_at = [&](const MorphAnimation::Shape& shape) {
        const double extent = shape.positions.cwiseAbs().maxCoeff();
        size = std::max(size, extent);
        smallest = std::min(smallest, extent);
    };
    look_at(animation.base);
    for (const MorphAnimation::Shape& target : animation.targets) look_at(target);
    if (size <= kLargestSize && smallest >= kSmallestSize) return;
    throw IoError(
        fmt::format("{}: not written: the shapes extend from {:.3g} to {:.3g}, and the single precision of a "
                    ".glb is good from "
                    "{:g} to {:g}; scale the meshes",
                    file, smallest, size, kSmallestSize, kLargestSize));
}

}  // namespace

bool is_glb_file(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension == ".glb";
}

void write_glb(const std::filesystem::path& file, const Triangles& F, const Endpoints& ends,
               const GlbOptions& options) {
    const MorphAnimation animation = animate(F, ends, options.animation);
    check_size(animation, file.string());
    Buffer buffer;
    Json root = {{"asset", {{"version", "2.0"}, {"generator", "automorph " AUTOMORPH_VERSION}}},
                 {"scene", 0},
                 {"scenes", Json::array({{{"nodes", Json::array({0})}}})},
                 {"nodes", Json::array({static_node(animation.offset, options.up),
                                        moved_node(animation, options.name)})},
                 {"materials", Json::array({material()})},
                 {"meshes", Json::array({mesh(buffer, F, animation, options.name)})},
                 {"animations", Json::array({animate_node(buffer, animation, 1)})}};
    root["accessors"] = buffer.accessors();
    root["bufferViews"] = buffer.views();
    root["buffers"] = Json::array({{{"byteLength", (buffer.bytes().size() + 3) / 4 * 4}}});
    write_file(file, container(root.dump(-1, ' ', false, Json::error_handler_t::replace), buffer.bytes(),
                               file.string()));
}

}  // namespace automorph
