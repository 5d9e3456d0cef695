#pragma once

#include <map>
#include <optional>
#include <string>

#include "tests/bench/child_process.h"

namespace automorph::bench {

/// What became of pairs, kept in a file: a run that was stopped goes on where it was, and several processes
/// may share the file.
class PairLog {
public:
    /// @param file  one JSON object a line; made if there is none; empty: nothing is kept
    explicit PairLog(std::string file);

    std::optional<ChildResult> find(const std::string& key) const;
    void add(const std::string& key, const ChildResult& result);

private:
    std::string file_;
    std::map<std::string, ChildResult> results_;
};

}  // namespace automorph::bench
