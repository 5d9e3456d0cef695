#pragma once

namespace automorph::bench {

/// Prints, along a morph, what it takes to build the tree anew and to refit it, how quick the rays are on
/// either, and from how many rays per triangle on building is worth it.
void moving_bench();

}  // namespace automorph::bench
