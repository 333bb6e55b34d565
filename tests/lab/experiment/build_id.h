#pragma once
/// Identity of this build and of the machine's arithmetic, so that tables of different builds or
/// processors are not taken for one.

#include <string>

namespace seam {

/// Returns the commit of the build as `git describe --always --dirty` says it; "unknown" without a
/// repository.
std::string BuiltCommit();

/// Returns 16 hexadecimal digits: a hash of what the C library's functions return at 4096 arguments
/// each, and of two short simulations, one with exact joints. Equal on machines that compute the
/// same bits. Takes some milliseconds at its first call.
const std::string& Numerics();

}  // namespace seam
