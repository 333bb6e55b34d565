/// Colours of different meaning are distinguishable, also to the colour-blind.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "render/canvas/palette.h"

namespace seam {
namespace render_palette_test {

using Triple = std::array<double, 3>;
using Matrix = std::array<Triple, 3>;

/// Machado and others (2009), severity 1, on linear sRGB.
const std::pair<const char*, Matrix> kSights[] = {{"normal", {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}},
                                                  {"protanopia",
                                                   {{{0.152286, 1.052583, -0.204868},
                                                     {0.114503, 0.786281, 0.099216},
                                                     {-0.003882, -0.048116, 1.051998}}}},
                                                  {"deuteranopia",
                                                   {{{0.367322, 0.860646, -0.227968},
                                                     {0.280085, 0.672501, 0.047413},
                                                     {-0.011820, 0.042940, 0.968881}}}},
                                                  {"tritanopia",
                                                   {{{1.255528, -0.076749, -0.178779},
                                                     {-0.078411, 0.930809, 0.147602},
                                                     {0.004733, 0.691367, 0.303900}}}}};

double Linear(std::uint8_t channel) {
  const double c = channel / 255.0;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

/// CIE 1976 L*a*b* of a colour as seen by an eye of that kind, white point D65.
Triple Lab(Colour colour, const Matrix& sight) {
  const Triple linear{Linear(colour.r), Linear(colour.g), Linear(colour.b)};
  Triple seen{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) seen[i] += sight[i][j] * linear[j];
    seen[i] = std::min(1.0, std::max(0.0, seen[i]));
  }
  const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116; };
  const double x = f((0.4124564 * seen[0] + 0.3575761 * seen[1] + 0.1804375 * seen[2]) / 0.95047);
  const double y = f(0.2126729 * seen[0] + 0.7151522 * seen[1] + 0.0721750 * seen[2]);
  const double z = f((0.0193339 * seen[0] + 0.1191920 * seen[1] + 0.9503041 * seen[2]) / 1.08883);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

using Named = std::vector<std::pair<std::string, Colour>>;

/// Colours present in every picture.
Named Everywhere() {
  const Colour water = Mix(Mix(kPanel, kWater, 0.22f), kWater, 0.16f);
  return {{"server", PeerColour(0)},
          {"water", water},
          {"water's level", kWaterLine},
          {"terrain", kGround},
          {"terrain's edge", kGroundEdge},
          {"text", kInk},
          {"panel", kPanel},
          {"impact", kSpark}};
}

void ExpectApart(const Named& colours) {
  for (const auto& [sight, matrix] : kSights) {
    for (std::size_t i = 0; i < colours.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const Triple a = Lab(colours[i].second, matrix), b = Lab(colours[j].second, matrix);
        const double apart = std::sqrt(std::pow(a[0] - b[0], 2) + std::pow(a[1] - b[1], 2) +
                                       std::pow(a[2] - b[2], 2));
        EXPECT_GE(apart, 12) << colours[i].first << " and " << colours[j].first << ", " << sight;
      }
    }
  }
}

TEST(Palette, TenPlayersAreDistinguishableToEveryEye) {
  Named colours = Everywhere();
  for (int peer = 1; peer <= kPeerHues; ++peer) {
    colours.emplace_back("peer " + std::to_string(peer), PeerColour(peer));
  }
  ExpectApart(colours);
}

TEST(Palette, TenRunsAreDistinguishableToEveryEye) {
  Named colours = Everywhere();
  for (int run = 0; run < kPeerHues; ++run) {
    colours.emplace_back("run " + std::to_string(run), RunColour(run));
  }
  ExpectApart(colours);
}

TEST(Palette, TheHeatGrowsDarkerWithTheError) {
  double before = 101;
  for (double decades = -3; decades <= 0; decades += 0.25) {
    const double light =
        Lab(HeatColour(static_cast<float>(std::pow(10, decades))), kSights[0].second)[0];
    EXPECT_LT(light, before) << decades;
    before = light;
  }
}

}  // namespace render_palette_test
}  // namespace seam
