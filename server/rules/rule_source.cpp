#include "server/rules/rule_source.h"

#include "common/physics/impact_dv.h"

namespace seam {

std::vector<Blow> ImpactsOf(const World& world) {
  std::vector<Blow> blows;
  for (const Impact& impact : world.impacts()) {
    const int a = impact.body_a, b = impact.body_b;
    if (a >= 0) blows.push_back({a, b, ChangeOfVelocity(world, impact, a), impact.point});
    if (b >= 0) blows.push_back({b, a, ChangeOfVelocity(world, impact, b), impact.point});
  }
  return blows;
}

}  // namespace seam
