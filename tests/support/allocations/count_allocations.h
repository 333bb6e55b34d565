#pragma once
/// Counts bytes requested from operator new: a test can show that hostile bytes cost little memory.

#include <cstddef>

namespace seam {

/// Returns the bytes that this thread has requested from operator new since the program started.
std::size_t AllocatedBytes();

}  // namespace seam
