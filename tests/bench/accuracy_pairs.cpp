#include "tests/bench/accuracy_pairs.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "morph/mesh/geometry.h"
#include "morph/morph.h"
#include "morph/shapes/random.h"

namespace automorph::bench {

namespace {

struct Pose {
    std::string source, target;
    Eigen::Matrix3d R;
    Eigen::Vector3d t;
};

Pose read_pose(const std::filesystem::path& file) {
    const nlohmann::json json = nlohmann::json::parse(std::ifstream(file));
    Pose pose{json.at("A"), json.at("B"), {}, {}};
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) pose.R(i, j) = json.at("R").at(i).at(j);
        pose.t[i] = json.at("t").at(i);
    }
    return pose;
}

/// Meshes keep the file's numbering: these files need no mending.
Mesh read(const std::filesystem::path& file) {
    const InputMesh input = load_mesh(file);
    for (std::size_t v = 0; v < input.vertex_of_file.size(); ++v) {
        if (input.vertex_of_file[v] != static_cast<int>(v))
            throw std::runtime_error(fmt::format("{} was mended and renumbered", file.string()));
    }
    return input.mesh;
}

std::vector<std::filesystem::path> poses_in(const std::string& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().string().ends_with(".pose.json")) files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

/// A smooth random displacement field: a few long plane waves.
class Warp {
public:
    Warp(const Points& around, double share, std::uint64_t seed) : random_(seed) {
        const double diagonal = bounding_box_diagonal(around);
        for (Wave& wave : waves_) {
            const Eigen::Vector3d direction = random_.in_ball<3>().normalized();
            const double length = diagonal * (0.6 + 0.9 * random_.uniform());
            wave = {direction * (2.0 * std::numbers::pi / length), random_.in_ball<3>(),
                    2.0 * std::numbers::pi * random_.uniform()};
        }
        const double size = std::sqrt(displacement(around).rowwise().squaredNorm().mean());
        for (Wave& wave : waves_) wave.amplitude *= share * diagonal / size;
    }

    Points operator()(const Points& points) const { return points + displacement(points); }

private:
    struct Wave {
        Eigen::Vector3d k, amplitude;
        double phase;
    };

    Points displacement(const Points& points) const {
        Points u = Points::Zero(points.rows(), 3);
        for (const Wave& wave : waves_) {
            const Eigen::ArrayXd phase = (points * wave.k).array() + wave.phase;
            u += phase.sin().matrix() * wave.amplitude.transpose();
        }
        return u;
    }

    Random random_;
    std::array<Wave, 8> waves_;
};

}  // namespace

std::vector<AccuracyPair> real_pairs(const std::string& folder) {
    std::vector<AccuracyPair> pairs;
    for (const auto& file : poses_in(folder)) {
        const Pose pose = read_pose(file);
        AccuracyPair pair;
        pair.source = read(std::filesystem::path(folder) / pose.source);
        pair.target = read(std::filesystem::path(folder) / pose.target);
        pair.name = file.filename().string().substr(3);
        pair.name.resize(pair.name.find('.'));
        pair.group = pair.name.substr(pair.name.rfind('_') + 1);
        std::ifstream truth(std::filesystem::path(folder) / ("gt_" + pair.name + ".csv"));
        std::string line;
        std::getline(truth, line);
        pair.truth.resize(pair.source.vertex_count(), 3);
        for (Eigen::Index i = 0; i < pair.truth.rows() && std::getline(truth, line); ++i) {
            std::replace(line.begin(), line.end(), ',', ' ');
            std::istringstream numbers(line);
            int region = 0;
            numbers >> pair.truth(i, 0) >> pair.truth(i, 1) >> pair.truth(i, 2) >> region;
            pair.scored.push_back(region == 0);
        }
        pairs.push_back(std::move(pair));
    }
    return pairs;
}

std::vector<AccuracyPair> synthetic_pairs(const std::string& folder) {
    std::vector<AccuracyPair> pairs;
    std::uint64_t seed = 1;
    std::vector<std::string> done;
    for (const auto& file : poses_in(folder)) {
        const Pose pose = read_pose(file);
        std::string unposed = pose.target;
        unposed.erase(unposed.find("_posed"), 6);
        const std::filesystem::path other = std::filesystem::path(folder) / unposed;
        if (!std::filesystem::exists(other)) continue;
        if (std::find(done.begin(), done.end(), pose.target) != done.end()) continue;
        done.push_back(pose.target);
        for (const double share : {0.02, 0.04}) {
            AccuracyPair pair;
            pair.source = read(other);
            pair.target = read(std::filesystem::path(folder) / pose.target);
            const Warp warp(pair.target.V, share, seed++);
            pair.truth = warp((pair.source.V * pose.R.transpose()).rowwise() + pose.t.transpose());
            pair.target.V = warp(pair.target.V);
            pair.group = "synthetic";
            pair.name = fmt::format("{} warped {:.0f} %", std::filesystem::path(unposed).stem().string(),
                                    100 * share);
            pair.scored.assign(static_cast<std::size_t>(pair.source.vertex_count()), 1);
            pairs.push_back(std::move(pair));
        }
    }
    return pairs;
}

std::vector<AccuracyPair> reversed_pairs(const std::vector<AccuracyPair>& pairs) {
    std::vector<AccuracyPair> reversed;
    for (const AccuracyPair& pair : pairs) {
        AccuracyPair back;
        back.name = pair.name + ", back";
        back.group = pair.group + ", back";
        back.source = pair.target;
        back.target = pair.source;
        back.truth = pair.source.V;
        back.scored = pair.scored;
        const ClosestPoints closest(pair.target);
        for (Eigen::Index i = 0; i < pair.truth.rows(); ++i)
            back.places.push_back(closest.query(pair.truth.row(i), Eigen::Vector3d::Zero(), -2.0));
        reversed.push_back(std::move(back));
    }
    return reversed;
}

std::vector<AccuracyPair> noisy_pairs(const std::string& folder) {
    std::vector<AccuracyPair> pairs;
    for (AccuracyPair& pair : synthetic_pairs(folder)) {
        if (!pair.name.ends_with("2 %")) continue;
        AccuracyPair mirrored = pair;
        for (Mesh* mesh : {&mirrored.source, &mirrored.target}) {
            mesh->V.col(0) *= -1.0;
            mesh->F.col(1).swap(mesh->F.col(2));
        }
        mirrored.truth.col(0) *= -1.0;
        mirrored.group = "mirrored";
        pairs.push_back(std::move(mirrored));

        Random random(pairs.size());
        const double size = 0.005 * bounding_box_diagonal(pair.target.V);
        // Uniform in a ball of radius r has a root mean square of sqrt(3/5) r.
        for (Eigen::Index i = 0; i < pair.target.V.rows(); ++i)
            pair.target.V.row(i) += size * std::sqrt(5.0 / 3.0) * random.in_ball<3>().transpose();
        pair.group = "noise 0.5 %";
        pairs.push_back(std::move(pair));
    }
    return pairs;
}

AccuracyScore score(const AccuracyPair& pair, const Points& predicted) {
    const double unit = bounding_box_diagonal(pair.target.V) / 100.0;
    std::vector<double> errors;
    for (Eigen::Index i = 0; i < pair.truth.rows(); ++i) {
        const auto at = static_cast<std::size_t>(i);
        if (!pair.scored[at]) continue;
        const Eigen::RowVector3d point =
            pair.places.empty() ? Eigen::RowVector3d(predicted.row(i)) : pair.places[at].in(predicted);
        errors.push_back((point - pair.truth.row(i)).norm() / unit);
    }
    std::sort(errors.begin(), errors.end());
    AccuracyScore result;
    for (const double error : errors) result.mean += error / static_cast<double>(errors.size());
    result.p95 = errors[static_cast<std::size_t>(0.95 * static_cast<double>(errors.size() - 1))];
    return result;
}

}  // namespace automorph::bench
