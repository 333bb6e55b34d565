#include "render/canvas/palette.h"

#include <algorithm>
#include <cmath>

namespace seam {
namespace {

constexpr Colour kServer{152, 158, 166, 255};
constexpr Colour kClients[kPeerHues] = {
    {64, 138, 206, 255},   // blue
    {236, 146, 44, 255},   // orange
    {73, 174, 117, 255},   // green
    {185, 114, 174, 255},  // purple
    {233, 207, 64, 255},   // yellow
    {120, 202, 236, 255},  // sky
    {109, 73, 36, 255},    // brown
    {109, 70, 171, 255},   // violet
    {5, 72, 66, 255},      // deep green
    {229, 168, 159, 255},  // rose
};
constexpr Colour kRuns[kPeerHues] = {
    {230, 90, 80, 255},    // red
    {122, 72, 180, 255},   // violet
    {12, 131, 140, 255},   // teal
    {74, 71, 80, 255},     // slate
    {176, 120, 0, 255},    // ochre
    {63, 93, 32, 255},     // olive
    {218, 122, 196, 255},  // pink
    {21, 59, 138, 255},    // navy
    {112, 194, 127, 255},  // leaf
    {231, 151, 87, 255},   // amber
};

std::uint8_t Channel(float value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0f, 255.0f)));
}

}  // namespace

Colour PeerColour(int peer) {
  if (peer <= 0) return kServer;
  const Colour base = kClients[static_cast<std::size_t>((peer - 1) % kPeerHues)];
  return Mix(base, kInk, 0.25f * static_cast<float>(std::min((peer - 1) / kPeerHues, 2)));
}

Colour RunColour(int run) { return kRuns[static_cast<std::size_t>(std::max(run, 0) % kPeerHues)]; }

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
