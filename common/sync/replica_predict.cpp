/// Replica, mode central: a client predicts its own vehicle and, where the server's state of an
/// earlier tick differs from what it had predicted for it, goes back there and replays its inputs
/// (Gambetta, "Fast-Paced Multiplayer", part II; Bernier 2001).

#include <cmath>

#include "common/sync/replica.h"

namespace seam {
namespace {

/// A predicted vehicle this near to the server's is left alone.
constexpr float kTolerance = 2.5f * kPositionQuantum;        // m
constexpr float kVelocityTolerance = 16 * kVelocityQuantum;  // m/s

bool Agrees(const BodyState& d) {
  return d.position.norm() < kTolerance && d.velocity.norm() < kVelocityTolerance;
}

}  // namespace

void Replica::Predict(const States& states) {
  const std::int64_t now = tick();
  const std::int64_t from = states.tick;
  if (from < history_.oldest() || from > now) return;
  bool agrees = true;
  for (std::size_t i = 0; i < states.id.size(); ++i) {
    const int body = world_.BodyOfId(states.id[i]);
    if (body < 0 || RoleOf(world_.mechanism(body)) != kRoleSecondary) continue;
    const BodyState& then = *history_.At(from, body);
    agrees = agrees && Agrees(Minus(Unpack(states, i, then.angle), then));
  }
  if (agrees) return;

  std::vector<BodyState> shown;
  for (int body = 0; body < world_.body_count(); ++body) shown.push_back(world_.Read(body));
  for (int body = 0; body < world_.body_count(); ++body) {
    world_.Write(body, *history_.At(from, body), false);
  }
  for (std::size_t i = 0; i < states.id.size(); ++i) {
    const int body = world_.BodyOfId(states.id[i]);
    if (body < 0 || RoleOf(world_.mechanism(body)) != kRoleSecondary) continue;
    BodyState server = Unpack(states, i, world_.Read(body).angle);
    world_.Write(body, server);
    *history_.At(from, body) = server;
  }
  world_.SetTick(from);
  for (std::int64_t t = from + 1; t <= now; ++t) {
    world_.SetInput(own_player_, tracks_[static_cast<std::size_t>(own_player_)].At(t));
    for (int body = 0; body < world_.body_count(); ++body) {
      if (world_.motion(body) != Motion::kKinematic) continue;
      // What is only displayed moves again as it moved then.
      BodyState before = *history_.At(t - 1, body);
      const BodyState& after = *history_.At(t, body);
      before.velocity = (after.position - before.position) / world_.dt();
      before.spin = (after.angle - before.angle) / world_.dt();
      const bool moves = before.velocity.squaredNorm() > 0 || before.spin != 0;
      world_.Write(body, before, moves);
    }
    world_.Step();
    for (int body = 0; body < world_.body_count(); ++body) {
      if (world_.motion(body) == Motion::kDynamic) *history_.At(t, body) = world_.Read(body);
    }
  }
  for (int body = 0; body < world_.body_count(); ++body) {
    const BodyState& old = shown[static_cast<std::size_t>(body)];
    if (world_.motion(body) == Motion::kKinematic) {
      world_.Write(body, old, false);
      continue;
    }
    const BodyState replayed = world_.Read(body);
    smoother_.Moved(body, Minus(replayed, old));
  }
}

}  // namespace seam
