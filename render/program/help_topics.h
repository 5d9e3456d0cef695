#pragma once

#include <string>
#include <vector>

namespace automorph::program {

/// A page of `automorph help`. Indented lines are shown as they are, paragraphs are parted by an empty line;
/// lines have at most 80 characters.
struct HelpTopic {
    const char *name, *title, *text;
};

const std::vector<HelpTopic>& help_topics();

/// What `automorph help` prints: the topics with their titles.
std::string list_of_topics();

}  // namespace automorph::program
