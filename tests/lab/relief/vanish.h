#pragma once
/// A holder is killed or cut off: how long what it had stands somewhere, and how far it jumps.

#include <cstdint>
#include <string>
#include <vector>

namespace seam {

/// A room in which somebody's things move while the others look on.
struct VanishKind {
  const char* name;
  std::string scene;
  bool driven = false;  ///< bots drive; else a disc goes by at a speed that nothing changes
};
/// A disc alone; in a crowd; as a cart of two; on a floor. Cars that push crates.
std::vector<VanishKind> VanishKinds();

/// From the fault on, the worst of the server's view and the second player's.
struct Vanished {
  bool held = false;    ///< the first player had the authority over its vehicle
  double stands_s = 0;  ///< of the disc; 0 where it is driven
  double jump_m = 0;  ///< of anything that it had: what one tick's way differs from the one before
  int looked = 0;     ///< ticks, the fewer of the two views
};

/// The first player is killed or cut off after two or three seconds, over a network drawn from the
/// seed; looks for six seconds. Throws OperatorError as Cluster does.
Vanished Vanish(const VanishKind& kind, std::uint64_t seed);

}  // namespace seam
