#pragma once
/// Bytes in memory: an owning vector and a borrowed view.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace seam {

using Bytes = std::vector<std::uint8_t>;

/// A borrowed range of bytes; valid only while its owner is.
struct ByteView {
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;

  ByteView() = default;
  ByteView(const std::uint8_t* first, std::size_t count) : data(first), size(count) {}
  ByteView(const Bytes& bytes) : data(bytes.data()), size(bytes.size()) {}  // NOLINT: implicit
  const std::uint8_t* begin() const { return data; }
  const std::uint8_t* end() const { return data + size; }
};

/// Returns the bytes of a text.
inline ByteView TextBytes(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// FNV-1a, 64 bit (Fowler, Noll, Vo; draft-eastlake-fnv). `seed` chains calls.
inline std::uint64_t Fnv1a(const void* data, std::size_t size,
                           std::uint64_t seed = 0xcbf29ce484222325ULL) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i < size; ++i) seed = (seed ^ bytes[i]) * 0x100000001b3ULL;
  return seed;
}

}  // namespace seam
