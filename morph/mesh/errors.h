#pragma once

#include <stdexcept>
#include <string>

namespace automorph {

/// Base of every error that bad data causes. `what()` is one line for the user: what was expected, what was
/// found, where (file:line, element index), and what to do. Bugs of our own are asserts, never these.
struct Error : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The mesh cannot be morphed: genus > 0, non-manifold, several large components, NaN, no triangles, ...
struct InvalidMesh : Error {
    using Error::Error;
};

/// A file cannot be read or written, or its content is malformed (message starts with `file:line:` or
/// `file:`).
struct IoError : Error {
    using Error::Error;
};

/// A numerical stage found no valid answer on admissible input; the message names the stage and the counts.
struct SolverFailure : Error {
    using Error::Error;
};

/// A configuration is wrong (message starts with `file:line:column:`).
struct ConfigError : Error {
    using Error::Error;
};

}  // namespace automorph
