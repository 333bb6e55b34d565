#pragma once
/// Limits of a scene, in SI units. Within these, Box2D 2.4.1 does not assert and stays stable;
/// docs/scenes.md repeats them.

#include <cstddef>
#include <cstdint>

#include "common/base/limits.h"
#include "common/scene/toml/scene_reader.h"

namespace seam {

constexpr Range kTickHz{kTickHzMin, kTickHzMax};
/// Coordinates, m. Single precision resolves 2 mm at 30 km; piles become unstable from 100 km.
constexpr Range kCoordinate{-30000, 30000};
/// Size of a moving part, m; `size_max` may raise the upper limit up to kSizeMaxMax, which is also
/// the limit of anchored parts.
constexpr float kSizeMin = 0.05f, kSizeMaxDefault = 10, kSizeMaxMax = 1000;
/// Shortest edge and least distance of a polygon's or chain's points, m. Box2D merges points at
/// 2.5 mm and asserts at chain spacings of 5 mm.
constexpr float kEdgeMin = 0.02f;
/// Least area of a polygon, m^2, and least distance of its points from its other edges' lines, m.
constexpr float kAreaMin = 1e-3f, kConvexMin = 1e-3f;
/// Points of a polygon and of a chain. The engine's polygons have 8: larger ones are cut.
constexpr std::size_t kPolygonPointsMax = 64, kChainPointsMax = 2000;
/// Number of points of a kinematic part's path.
constexpr std::size_t kPathPointsMax = 200;
/// kg/m^2; the engine's solver needs moderate mass ratios.
constexpr Range kDensity{0.01, 100};
/// 1/s; above 100 a body stops within a tick. Times gravity.
constexpr Range kPartDamping{0, 100}, kGravityScale{-10, 10};
/// m. Width of a moving line for its mass: twice the rim of the engine's shapes.
constexpr float kLineWidth = 0.02f;
/// m. Travel of a prismatic spring without limits, to either side.
constexpr float kSpringTravel = 100;
/// Least number of the engine's steps a second, normally one a tick. The engine moves a body by at
/// most 2 m and turns it by at most a quarter turn in a step. With fewer steps it would slow bodies
/// that are within the two limits below.
constexpr int kStepHzMin = 60;
/// rad/s
constexpr float kSpinMax = 94;
static_assert(kSpinMax < kStepHzMin * 1.5707f);
/// m/s
constexpr float kSpeedMax = 120;
static_assert(kSpeedMax <= kStepHzMin * 2);
/// Largest impulse, N s, and angular impulse, N m s: that of 10 000 t at the greatest speed. The
/// lightest part stays finite with it.
constexpr float kImpulseMax = 1e9f;
/// Returns the least number of substeps at this tick rate.
constexpr int SubstepsMin(int tick_hz) { return (kStepHzMin + tick_hz - 1) / tick_hz; }
/// m. Least: half of the engine's slop, so that resting shapes just touch; with less they overlap.
/// With an anchored rim of 1 cm the sum is the 1.25 cm that continuous collision needs.
constexpr Range kSkinRange{0.0025, 0.01};
/// Width and height of water, m, and its flow, m/s.
constexpr float kWaterSizeMax = 20000, kFlowMax = 50;
constexpr std::size_t kWatersMax = 64;
/// Largest numbers of parts and joints; for players see common/base/limits.h.
constexpr std::size_t kPartsMax = 65535, kJointsMax = 65535;
/// Largest number of actions of a player.
constexpr std::size_t kActionsMax = 15;
constexpr std::size_t kScriptMax = 2000, kWatchMax = 16, kThrustsMax = 256;
/// Limits of [[strand]]; the points of all strands fit one message.
constexpr std::size_t kStrandsMax = 64, kStrandLinksMax = 32;
/// Largest number of inlets, and of outlets, of one part.
constexpr std::size_t kConnectorsMax = 16;
/// m; smaller ones would have parts below kSizeMin.
constexpr Range kCharacterHeight{1, 5};
constexpr std::size_t kCharactersMax = 64;
/// Pairs of shapes that may overlap at the start (crowding.h), normal below 100; the densest scene
/// of the project has 1500. At the limit a first step takes .1 to 1.2 s; with 10 times as many
/// (1000 boxes at one point) 4 s, with 8 million (4000 boxes) minutes.
constexpr std::int64_t kCrowdMax = 50000;
/// Likewise for pairs with a bullet, normal 0: each impact of a bullet searches all contacts again.
/// At the limit a first step takes .1 to 1.3 s; with 5 times as many up to 8 s.
constexpr std::int64_t kBulletCrowdMax = 1000;
/// Returns the number of parts or joints that are not gone.
template <class Things>
std::size_t CountLiving(const Things& things) {
  std::size_t living = 0;
  for (const auto& thing : things) living += thing.gone ? 0 : 1;
  return living;
}
/// Returns true if the limit is reached.
template <class Things>
bool Full(const Things& things, std::size_t most) {
  return things.size() >= most && CountLiving(things) >= most;
}
/// Largest distance of welded parts from their root, m: beyond it their edges are lost to rounding.
constexpr float kWeldReachMax = 1000;

}  // namespace seam
