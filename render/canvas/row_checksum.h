#pragma once
/// The checksum at the end of a zlib stream (Adler-32, RFC 1950, section 8.2), row by row. The sums
/// of a row are independent of the rows before it, so that equal rows are summed once.

#include <cstddef>
#include <cstdint>

namespace seam {

/// Sums over the red, green and blue bytes of a row of pixels.
struct RowSum {
  std::uint32_t sum = 0;       ///< all bytes, modulo 65521
  std::uint32_t weighted = 0;  ///< all bytes, the last once, the one before it twice, ...
  std::size_t bytes = 0;
};

/// Returns the sums of `pixels` pixels of four bytes each; the fourth is left out.
RowSum SumOf(const std::uint8_t* rgba, std::size_t pixels);

/// A running Adler-32 checksum.
class Adler32 {
 public:
  void AddByte(std::uint8_t byte);
  void AddRow(const RowSum& row);
  std::uint32_t value() const { return b_ << 16 | a_; }

 private:
  std::uint32_t a_ = 1, b_ = 0;
};

}  // namespace seam
