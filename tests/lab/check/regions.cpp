#include <fmt/format.h>

#include <algorithm>

#include "server/authority/plan.h"
#include "tests/lab/check/scene_check.h"

namespace seam {
namespace {

/// Regions are closed and are written a millimetre apart: so much is no gap, and no overlap. m
constexpr float kTouch = 0.01f;
/// The extent that two regions have in common along each axis; negative: the gap between them. m
Vec2 Common(const Player& a, const Player& b) {
  return a.region_max.cwiseMin(b.region_max) - a.region_min.cwiseMax(b.region_min);
}

}  // namespace

void FindRegions(const Scene& scene, std::vector<Finding>* findings) {
  const std::vector<Player>& players = scene.players;
  for (std::size_t i = 0; i < players.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!players[i].has_region || !players[j].has_region) continue;
      const Vec2 common = Common(players[i], players[j]);
      const std::string who =
          fmt::format("the regions of '{}' and '{}' ", players[j].name, players[i].name);
      if (common.minCoeff() > kTouch) {
        findings->push_back({players[i].line, fmt::format("{}overlap by {:g} m x {:g} m: in there "
                                                          "the first has everything",
                                                          who, common.x(), common.y())});
      }
      const float gap = -common.minCoeff();
      if (common.maxCoeff() > 0 && gap > kTouch && gap < kHysteresis) {
        findings->push_back(
            {players[i].line,
             fmt::format("{}have a gap of {:g} m between them: what crosses it is the server's for "
                         "a moment",
                         who, gap)});
      }
    }
  }
}

}  // namespace seam
