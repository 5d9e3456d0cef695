#pragma once

#include <string>
#include <vector>

namespace automorph::bench {

/// What the statistical comparison sees in golden pictures: deliberate changes of what they show, each with
/// the number of samples from which it is caught, and how many pairs of seeds it rejects without a change.
/// @param arguments  --pairs N, --limit SPP (no more samples are tried), names of goldens; none: all that
///                   are path-traced
/// @return 1 if a change is missed up to the limit or more pairs are rejected than the stated share explains
int power_bench(const std::vector<std::string>& arguments);

}  // namespace automorph::bench
