#include "render/playback/format.h"

#include <fmt/format.h>

#include <cmath>

namespace seam {

std::string FormatLength(double metres) {
  const double size = std::abs(metres);
  if (size < 0.00005) return "0 mm";
  if (size < 0.00995) return fmt::format("{:.1f} mm", metres * 1e3);
  if (size < 0.0995) return fmt::format("{:.0f} mm", metres * 1e3);
  if (size < 0.995) return fmt::format("{:.0f} cm", metres * 1e2);
  if (size < 9.95) return fmt::format("{:.2f} m", metres);
  return fmt::format("{:.1f} m", metres);
}

std::string FormatTime(double seconds) { return fmt::format("{:.2f} s", seconds); }

std::string FormatNumber(double value, int digits) { return fmt::format("{:.{}f}", value, digits); }

}  // namespace seam
