#include "tests/support/allocations/count_allocations.h"

#include <cstdlib>
#include <new>

namespace {
thread_local std::size_t allocated_bytes = 0;
}  // namespace

// Replaces the global operators for the whole test program.
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  allocated_bytes += bytes;
  return std::malloc(bytes == 0 ? 1 : bytes);
}
void* operator new(std::size_t bytes) {
  void* memory = operator new(bytes, std::nothrow);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

std::size_t seam::AllocatedBytes() { return allocated_bytes; }
