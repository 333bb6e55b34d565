#pragma once
/// A plain with carts and crates, of any number: players without regions, some distance apart.

#include <string>

namespace seam {

struct PlainScene {
  int players = 4;
  float spacing = 30;   ///< m between players at the start
  int crates = 4;       ///< of each player, beside its cart in columns of two
  std::string planner;  ///< lines of [planner]; "": none
  double duration = 8;  ///< s
};

/// The scene's text: player "p3" pushes "cart-3" along with a thrust.
std::string PlainText(const PlainScene& plain);

}  // namespace seam
