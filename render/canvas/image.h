#pragma once
/// A finished picture in memory, drawn by a canvas and written as a PNG.

#include <cstddef>
#include <cstdint>
#include <vector>

namespace seam {

/// 8-bit sRGB, rows from the top, no padding.
struct Image {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> rgba;  ///< 4 * width * height bytes, each fourth 255

  const std::uint8_t* At(int x, int y) const {
    return rgba.data() + 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) +
                             static_cast<std::size_t>(x));
  }
};

/// A colour with its opacity.
struct Colour {
  std::uint8_t r = 0, g = 0, b = 0, a = 255;
  bool operator==(const Colour& o) const { return r == o.r && g == o.g && b == o.b && a == o.a; }
};

}  // namespace seam
