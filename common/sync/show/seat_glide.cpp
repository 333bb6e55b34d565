#include "common/sync/show/seat_glide.h"

#include <algorithm>
#include <cmath>

#include "common/base/geometry.h"
#include "common/physics/part_places.h"
#include "common/sync/state_limits.h"

namespace seam {
namespace {

/// How long after a seat was left, s: a peer that hears of it late shows it late.
constexpr int kAfter = 2;
/// Visible move per tick beyond the velocity, m: the limit of the glide, plus the part that closing
/// joints adds.
constexpr float kGentleBeside = 0.04f;

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
  players_.clear();
  for (std::size_t p = 0; p < ticks_.size(); ++p) {
    ticks_[p] = std::max(0, ticks_[p] - 1);
    const PartId own = scene.players[p].vehicle;
    const int mechanism = own < 0 ? -1 : MechanismOf(world, own);
    if (mechanism < 0) continue;
    players_.push_back(mechanism);
    if (ticks_[p] > 0) gentle_.push_back(mechanism);
  }
}

bool SeatGlide::IsGentle(int mechanism) const {
  return std::find(gentle_.begin(), gentle_.end(), mechanism) != gentle_.end();
}

bool SeatGlide::HoldBack(const World& world, const std::vector<int>& bodies,
                         std::vector<BodyState>* poses) const {
  float share = 1;
  for (const int body : bodies) {
    const ShownPose& before = shown_[body];
    if (before.tick != world.tick() - 1) return false;
    const BodyState& pose = (*poses)[static_cast<std::size_t>(body)];
    const float speed = std::max(pose.velocity.norm(), before.pose.velocity.norm());
    const float moved = (pose.position - before.pose.position).norm();
    const float most = speed * world.dt() + kGentleBeside;
    if (moved > most) share = std::min(share, most / moved);
  }
  if (share == 1) return false;
  for (const int body : bodies) {
    const BodyState& before = shown_[body].pose;
    BodyState& pose = (*poses)[static_cast<std::size_t>(body)];
    pose.position = before.position + share * (pose.position - before.position);
    if (std::fabs(pose.spin) > kSpinSeen) continue;
    pose.angle = before.angle + share * WrapAngle(pose.angle - before.angle);
  }
  return true;
}

void SeatGlide::Shown(const World& world, const std::vector<int>& bodies,
                      const std::vector<BodyState>& poses) {
  for (const int body : bodies) {
    shown_[body] = {world.tick(), poses[static_cast<std::size_t>(body)]};
  }
}

}  // namespace seam
