#include "tests/lab/gait/ability.h"

namespace seam {

const std::vector<Ability>& Abilities() {
  static const std::vector<Ability> abilities = {{"jump", "m of the soles", TryJump},
                                                 {"swim", "m/s", TrySwim},
                                                 {"float", "m/s", TryFloat},
                                                 {"plunge", "m/s", TryPlunge},
                                                 {"rise", "s", TryRise},
                                                 {"stairs", "s", TryStairs},
                                                 {"descent", "s", TryDescent},
                                                 {"slope", "s", TrySlope},
                                                 {"shove", "s", TryShove},
                                                 {"walk", "m/s", TryWalk},
                                                 {"climb", "s", TryClimb},
                                                 {"limp", "s", TryLimp}};
  return abilities;
}

const Ability* FindAbility(const std::string& name) {
  for (const Ability& each : Abilities()) {
    if (each.name == name) return &each;
  }
  return nullptr;
}

}  // namespace seam
