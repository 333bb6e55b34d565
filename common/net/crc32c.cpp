#include "common/net/crc32c.h"

#include <array>
#include <cstring>

namespace seam {
namespace {

/// The polynomial 0x1EDC6F41 with its bits reversed.
constexpr std::uint32_t kPolynomial = 0x82f63b78u;

constexpr std::array<std::uint32_t, 256> MakeTable() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t value = i;
    for (int bit = 0; bit < 8; ++bit) value = (value >> 1) ^ ((value & 1) ? kPolynomial : 0);
    table[i] = value;
  }
  return table;
}

constexpr std::array<std::uint32_t, 256> kTable = MakeTable();

std::uint32_t ByTable(ByteView bytes, std::uint32_t crc) {
  for (const std::uint8_t byte : bytes) crc = kTable[(crc ^ byte) & 255] ^ (crc >> 8);
  return crc;
}

#if defined(__x86_64__)
/// Uses the processor's instruction for this polynomial, eight bytes at a time.
__attribute__((target("sse4.2"))) std::uint32_t ByInstruction(ByteView bytes, std::uint32_t crc) {
  std::size_t at = 0;
  std::uint64_t wide = crc;
  for (; at + sizeof wide <= bytes.size; at += sizeof wide) {
    std::uint64_t eight;
    std::memcpy(&eight, bytes.data + at, sizeof eight);
    wide = __builtin_ia32_crc32di(wide, eight);
  }
  crc = static_cast<std::uint32_t>(wide);
  for (; at < bytes.size; ++at) crc = __builtin_ia32_crc32qi(crc, bytes.data[at]);
  return crc;
}
#endif

}  // namespace

std::uint32_t Crc32c(ByteView bytes, std::uint32_t seed) {
#if defined(__x86_64__)
  static const bool has_instruction = __builtin_cpu_supports("sse4.2") != 0;
  if (has_instruction) return ~ByInstruction(bytes, ~seed);
#endif
  return ~ByTable(bytes, ~seed);
}

}  // namespace seam
