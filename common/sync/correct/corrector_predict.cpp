/// Corrector, mode central: a client predicts its own vehicle and, where the server's state of an
/// earlier tick differs from what it had predicted for it, goes back there and replays its inputs
/// (Gambetta, "Fast-Paced Multiplayer", part II; Bernier 2001).

#include <cmath>

#include "common/sync/correct/corrector.h"
#include "common/sync/quantize.h"

namespace seam {
namespace {

/// A predicted vehicle this near to the server's is left alone.
constexpr float kTolerance = 2.5f * kPositionQuantum;        // m
constexpr float kVelocityTolerance = 16 * kVelocityQuantum;  // m/s

bool Agrees(const BodyState& d) {
  return d.position.norm() < kTolerance && d.velocity.norm() < kVelocityTolerance;
}

}  // namespace

void Corrector::Predict(const States& states) {
  const std::int64_t now = world_.tick();
  const std::int64_t from = states.tick;
  if (from < memory_.history().oldest() || from > now) return;
  std::vector<Entry> own;
  bool agrees = true;
  for (std::size_t i = 0; i < states.id.size(); ++i) {
    const int body = world_.BodyOfId(states.id[i]);
    if (body < 0 || roles_.RoleOfBody(body) != kRoleSecondary) continue;
    own.emplace_back(i, body);
    const BodyState& then = *memory_.history().At(from, body);
    agrees = agrees && Agrees(Minus(Unpack(states, i, then.angle), then));
  }
  if (agrees) return;

  std::vector<BodyState> shown;
  for (int body = 0; body < world_.body_count(); ++body) shown.push_back(world_.Read(body));
  for (int body = 0; body < world_.body_count(); ++body) {
    world_.Write(body, *memory_.history().At(from, body), false);
  }
  for (const auto& [i, body] : own) {
    const BodyState server = Unpack(states, i, world_.Read(body).angle);
    world_.Write(body, server);
    *memory_.history().At(from, body) = server;
  }
  world_.SetTick(from);
  while (world_.tick() < now) PredictTick();
  for (int body = 0; body < world_.body_count(); ++body) {
    const BodyState& old = shown[static_cast<std::size_t>(body)];
    if (world_.motion(body) == Motion::kKinematic) {
      world_.Write(body, old, false);
    } else {
      display_.Moved(body, Minus(world_.Read(body), old));
    }
  }
}

/// One tick again, with the own player's input of it; what is only displayed moves as it moved
/// then.
void Corrector::PredictTick() {
  const std::int64_t next = world_.tick() + 1;
  const int player = roles_.own_player();
  world_.SetInput(player, inputs_[static_cast<std::size_t>(player)].At(next));
  for (int body = 0; body < world_.body_count(); ++body) {
    if (world_.motion(body) != Motion::kKinematic) continue;
    BodyState before = *memory_.history().At(next - 1, body);
    const BodyState& after = *memory_.history().At(next, body);
    before.velocity = (after.position - before.position) / world_.dt();
    before.spin = (after.angle - before.angle) / world_.dt();
    const bool moves = before.velocity.squaredNorm() > 0 || before.spin != 0;
    world_.Write(body, before, moves);
  }
  world_.Step();
  for (int body = 0; body < world_.body_count(); ++body) {
    if (world_.motion(body) != Motion::kDynamic) continue;
    *memory_.history().At(next, body) = world_.Read(body);
  }
}

}  // namespace seam
