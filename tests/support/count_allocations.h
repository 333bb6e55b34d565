#pragma once
/// Counts what operator new is asked for: shows a test that hostile bytes cost little memory.

#include <cstddef>

namespace seam {

/// Bytes that this thread has asked operator new for since the program started.
std::size_t AllocatedBytes();

}  // namespace seam
