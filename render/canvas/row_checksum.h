#pragma once
/// The checksum at the end of a zlib stream (Adler-32, RFC 1950, section 8.2), row by row: what a
/// row of pixels adds is computed apart from what came before, so that equal rows are summed once.

#include <cstddef>
#include <cstdint>

namespace seam {

/// Of the red, green and blue bytes of a row of pixels.
struct RowSum {
  std::uint32_t sum = 0;       ///< of all bytes, modulo 65521
  std::uint32_t weighted = 0;  ///< of all bytes, the last one time, the one before it twice, ...
  std::size_t bytes = 0;
};

/// Of `pixels` pixels of four bytes each; the fourth is left out.
RowSum SumOf(const std::uint8_t* rgba, std::size_t pixels);

/// The checksum of everything that was added.
class Adler32 {
 public:
  void AddByte(std::uint8_t byte);
  void AddRow(const RowSum& row);
  std::uint32_t value() const { return b_ << 16 | a_; }

 private:
  std::uint32_t a_ = 1, b_ = 0;
};

}  // namespace seam
