#include "morph/frames/search_tree.h"

#include <tbb/global_control.h>

#include "tests/catch.h"

using namespace automorph;

TEST_CASE("while a device lives, other work may use as many threads as before") {
    const auto threads = [] {
        return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    };
    const tbb::global_control two(tbb::global_control::max_allowed_parallelism, 2);
    const SearchDevice device;
    CHECK(threads() == 2);
}
