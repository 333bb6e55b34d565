#include "common/sync/show/seat_glide.h"

#include <algorithm>

#include "common/physics/part_places.h"

namespace seam {
namespace {

/// How long after somebody has left a seat, s: who hears of it late shows it late.
constexpr int kAfter = 2;

}  // namespace

void SeatGlide::Look(const World& world) {
  const Scene& scene = world.scene();
  if (scene.seats.empty()) return;
  ticks_.resize(scene.players.size(), 0);
  for (const Seat& seat : scene.seats) {
    if (seat.player < 0) continue;
    ticks_[static_cast<std::size_t>(seat.player)] = kAfter * scene.solver.tick_hz + 1;
  }
  gentle_.clear();
  for (std::size_t p = 0; p < ticks_.size(); ++p) {
    ticks_[p] = std::max(0, ticks_[p] - 1);
    const PartId own = scene.players[p].vehicle;
    const int mechanism = ticks_[p] == 0 || own < 0 ? -1 : MechanismOf(world, own);
    if (mechanism >= 0) gentle_.push_back(mechanism);
  }
}

bool SeatGlide::IsGentle(int mechanism) const {
  return std::find(gentle_.begin(), gentle_.end(), mechanism) != gentle_.end();
}

}  // namespace seam
