#include "tests/lab/hard/invariant_watch.h"

#include <fmt/format.h>

#include <cmath>

namespace seam {
namespace {

bool Finite(const BodyState& s) {
  return s.position.allFinite() && s.velocity.allFinite() && std::isfinite(s.angle) &&
         std::isfinite(s.spin);
}

bool Inside(const Enclosure& room, const Vec2& p) {
  const double x = static_cast<double>(p.x()), y = static_cast<double>(p.y());
  return x >= room.min_x && x <= room.max_x && y >= room.min_y && y <= room.max_y;
}

}  // namespace

void Watch::See(const World& world) {
  const double t = static_cast<double>(world.tick()) / world.scene().solver.tick_hz;
  states_.resize(static_cast<std::size_t>(world.body_count()));
  for (int body = 0; body < world.body_count(); ++body) {
    const BodyState state = world.Read(body);
    states_[static_cast<std::size_t>(body)] = state;
    if (!Finite(state)) {
      Fail("diverged", t);
      diverged_ = true;
      return;
    }
    const double speed = static_cast<double>(state.velocity.norm());
    if (speed > limits_.speed_mps) Fail(fmt::format("exploded: {:.3g} m/s", speed), t);
    if (!Inside(limits_.room, state.position)) Fail("escaped", t);
  }
  Look(world, t);
}

double Watch::Error() const {
  return diverged_ ? std::numeric_limits<double>::infinity() : Value();
}

void Watch::Fail(const std::string& what, double t) {
  if (failure_.empty()) failure_ = fmt::format("{} at {:.1f} s", what, t);
}

}  // namespace seam
