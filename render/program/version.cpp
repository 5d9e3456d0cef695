#include "render/program/version.h"

namespace automorph::program {

std::string version() {
    return AUTOMORPH_VERSION;
}

std::string version_text() {
    return "automorph " + version() + "\nbuilt with " AUTOMORPH_BUILT_WITH;
}

}  // namespace automorph::program
