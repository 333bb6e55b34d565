#pragma once
/// Fast compression of pictures with large areas of one colour: a zlib stream (RFC 1950, 1951) in
/// one pass, in about a tenth of the time of zlib's level 3 and of about the same size.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace seam {

/// Appends the zlib stream of a PNG's rows to `out`: for each row a filter byte 0, then the red,
/// green and blue of its `width` pixels. `rgba` has four bytes for each pixel; the fourth is not
/// written, but takes part in comparisons of pixels. Matches are whole pixels and are searched in
/// the pixel before, in the row above, and by a small hash. The same pixels give the same bytes.
void FlatDeflate(const std::uint8_t* rgba, std::size_t width, std::size_t rows,
                 std::vector<std::uint8_t>* out);

}  // namespace seam
