#include "tests/bench/pair_log.h"

#include <fstream>
#include <nlohmann/json.hpp>

namespace automorph::bench {

using Json = nlohmann::json;

PairLog::PairLog(std::string file) : file_(std::move(file)) {
    std::ifstream in(file_);
    for (std::string line; std::getline(in, line);) {
        const Json json = Json::parse(line, nullptr, false);
        if (json.is_discarded()) continue;  // its writer was stopped
        ChildResult result;
        result.output = json["output"];
        result.failure = json["failure"];
        result.seconds = json["seconds"];
        result.cpu_seconds = json["cpu_seconds"];
        result.peak_memory_mb = json["peak_memory_mb"];
        results_[json["key"]] = result;
    }
}

std::optional<ChildResult> PairLog::find(const std::string& key) const {
    const auto found = results_.find(key);
    if (found == results_.end()) return std::nullopt;
    return found->second;
}

void PairLog::add(const std::string& key, const ChildResult& result) {
    if (file_.empty()) return;
    const Json json = {{"key", key},
                       {"output", result.output},
                       {"failure", result.failure},
                       {"seconds", result.seconds},
                       {"cpu_seconds", result.cpu_seconds},
                       {"peak_memory_mb", result.peak_memory_mb}};
    // In one piece, since other processes append, too.
    std::ofstream out(file_, std::ios::app);
    out << json.dump() + "\n" << std::flush;
    if (!out) throw std::runtime_error("cannot write " + file_);
    results_[key] = result;
}

}  // namespace automorph::bench
