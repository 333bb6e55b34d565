#include "common/sync/audit/turns.h"

#include <algorithm>
#include <cmath>

namespace seam {
namespace {

constexpr float kWholeTurn = 6.283185307f;

}  // namespace

Turns::Turns(const World& world) : hinges_(static_cast<std::size_t>(world.body_count())) {
  for (const Pin& pin : world.Pins()) {
    const bool moves = pin.a.body >= 0 && pin.b.body >= 0;
    if (!moves || !(pin.angle_upper - pin.angle_lower < kWholeTurn)) continue;
    const float middle = (pin.angle_lower + pin.angle_upper) / 2;
    hinges_[static_cast<std::size_t>(pin.a.body)].push_back({pin.b.body, middle});
    hinges_[static_cast<std::size_t>(pin.b.body)].push_back({pin.a.body, -middle});
  }
}

void Turns::Right(const std::vector<int>& bodies, std::vector<BodyState>* states) const {
  std::vector<char> reached(bodies.size(), 0);
  std::vector<std::size_t> next;
  for (std::size_t first = 0; first < bodies.size(); ++first) {
    if (reached[first] != 0) continue;
    reached[first] = 1;
    next.assign(1, first);
    while (!next.empty()) {
      const std::size_t from = next.back();
      next.pop_back();
      for (const Hinge& hinge : hinges_[static_cast<std::size_t>(bodies[from])]) {
        const auto found = std::lower_bound(bodies.begin(), bodies.end(), hinge.to);
        const auto to = static_cast<std::size_t>(found - bodies.begin());
        if (found == bodies.end() || *found != hinge.to || reached[to] != 0) continue;
        reached[to] = 1;
        next.push_back(to);
        const float off = (*states)[to].angle - (*states)[from].angle - hinge.middle;
        (*states)[to].angle -= kWholeTurn * std::round(off / kWholeTurn);
      }
    }
  }
}

}  // namespace seam
