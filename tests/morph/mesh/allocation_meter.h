#pragma once

#include <cstddef>

namespace automorph::testing {

/// Heap memory of this process, counted from construction on.
class AllocationMeter {
public:
    AllocationMeter();
    /// Most bytes alive at one time since construction, beyond those alive then.
    std::size_t peak() const;

private:
    std::size_t before_;
};

}  // namespace automorph::testing
