#include <Eigen/Core>
#include <cmath>

#include "tests/catch.h"

TEST_CASE("numbers do not depend on the maker of the processor or on its caches") {
    // A square root is exact everywhere, approximations of it are not the same on Intel and AMD.
    const Eigen::ArrayXf x = Eigen::ArrayXf::LinSpaced(4001, 1e-6f, 30.0f), roots = x.sqrt();
    int inexact = 0;
    for (Eigen::Index i = 0; i < x.size(); ++i) inexact += roots[i] == std::sqrt(x[i]) ? 0 : 1;
    CHECK(inexact == 0);
    // Sums in a product of matrices are taken in blocks of these sizes.
    CHECK(Eigen::l1CacheSize() == 32 * 1024);
    CHECK(Eigen::l2CacheSize() == 256 * 1024);
    CHECK(Eigen::l3CacheSize() == 2 * 1024 * 1024);
}
