#pragma once

#include <string>
#include <vector>

namespace automorph::bench {

/// Scores the correspondence of whole morphs against ground truth: real pairs and pairs with exact truth,
/// each way round, and what each part of the alignment gives. Prints tables in Markdown.
/// @param arguments  the folder with the meshes; --ablation also leaves out one part after the other
/// @return 0; 2 if the folder is not there
int accuracy_bench(const std::vector<std::string>& arguments);

}  // namespace automorph::bench
