#pragma once

#include <map>
#include <string>
#include <vector>

#include "tests/bench/child_process.h"
#include "tests/bench/pair_check.h"

namespace automorph::bench {

/// A check as the text that a child process hands to its parent.
std::string as_json(const PairCheck& check);

/// Prints a row per pair on stdout, and at the end what they come to.
class PairTable {
public:
    static void print_head();

    /// @param source_triangles, target_triangles  of the inputs
    /// @param child  whose output is that of as_json
    void print_row(const std::string& name, int source_triangles, int target_triangles,
                   const ChildResult& child);
    void print_summary();

    /// Was every pair solved without a fault?
    bool flawless() const;

private:
    int pairs_ = 0, solved_ = 0, slow_ = 0, unsure_ = 0, without_dense_ = 0;
    int flipped_ = 0;
    double off_ = 0, peak_memory_mb_ = 0;
    std::map<std::string, int> routes_;
    std::vector<double> cpu_seconds_;             // of the morphs
    std::vector<std::string> failures_, faults_;  // a line each
};

}  // namespace automorph::bench
