#pragma once

#include <string>
#include <vector>

namespace automorph::bench {

/// Morphs pairs of meshes that nobody chose: every one-component genus-0 mesh of build/meshes and of the
/// folders named, closed with closed, open with open and open with closed, the target turned at random and
/// scaled. Each pair runs in a process of its own. Prints a row per pair, a summary and the failures.
/// @param arguments  folders; --all (default: a sample), --sample N, --seed N, --only TEXT (pairs whose name
///                   contains it), --shard I/N (every N-th pair, from the I-th on), --log FILE (what became
///                   of pairs; those in it are not run again), --seconds N and --memory GB (limits), --flat
///                   (no curved placement), --registration (no dense alignment)
/// @return 0 if all pairs were solved without a fault, 1 if not, 2 if an argument is wrong
int pairs_bench(const std::vector<std::string>& arguments);

}  // namespace automorph::bench
