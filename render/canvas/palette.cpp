#include "render/canvas/palette.h"

#include <algorithm>
#include <cmath>

namespace seam {
namespace {

constexpr Colour kServer{152, 158, 166, 255};
constexpr Colour kClients[7] = {
    {64, 138, 206, 255},   // blue
    {236, 146, 44, 255},   // orange
    {38, 163, 122, 255},   // bluish green
    {204, 121, 167, 255},  // reddish purple
    {226, 202, 60, 255},   // yellow
    {120, 202, 236, 255},  // sky
    {146, 104, 84, 255},   // brown
};
constexpr Colour kRuns[6] = {
    {196, 30, 58, 255},   // crimson
    {122, 72, 180, 255},  // violet
    {0, 120, 128, 255},   // teal
    {28, 31, 36, 255},    // ink
    {176, 120, 0, 255},   // ochre
    {90, 110, 40, 255},   // olive
};

std::uint8_t Channel(float value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0f, 255.0f)));
}

}  // namespace

Colour PeerColour(int peer) {
  if (peer <= 0) return kServer;
  const Colour base = kClients[static_cast<std::size_t>((peer - 1) % 7)];
  return Mix(base, kInk, 0.25f * static_cast<float>(std::min((peer - 1) / 7, 2)));
}

Colour RunColour(int run) { return kRuns[static_cast<std::size_t>(std::max(run, 0) % 6)]; }

Colour HeatColour(float error_m) {
  constexpr int kStops = 7;
  constexpr Colour kHeat[kStops] = {{247, 247, 240, 255}, {253, 231, 37, 255}, {122, 209, 81, 255},
                                    {34, 168, 132, 255},  {42, 120, 142, 255}, {65, 68, 135, 255},
                                    {68, 1, 84, 255}};
  const float decades = std::log10(std::max(error_m, 1e-3f)) + 3;  // 0 at 1 mm, 3 at 1 m
  const float place = std::clamp(decades / 3, 0.0f, 1.0f) * (kStops - 1);
  const int i = std::min(static_cast<int>(place), kStops - 2);
  return Mix(kHeat[i], kHeat[i + 1], place - static_cast<float>(i));
}

Colour Mix(Colour a, Colour b, float share) {
  const auto one = [share](std::uint8_t from, std::uint8_t to) {
    return Channel(static_cast<float>(from) +
                   share * (static_cast<float>(to) - static_cast<float>(from)));
  };
  return {one(a.r, b.r), one(a.g, b.g), one(a.b, b.b), one(a.a, b.a)};
}

Colour Faded(Colour colour, float opacity) {
  colour.a = Channel(static_cast<float>(colour.a) * opacity);
  return colour;
}

Colour Darker(Colour colour) { return Mix(colour, {20, 24, 32, colour.a}, 0.45f); }

}  // namespace seam
