#pragma once
/// Full turns of hinged bodies. On the wire an angle has no turns; a hinge with limits holds two
/// bodies within less than one turn of each other, so that one body's turns give the other's.

#include <vector>

#include "common/physics/world.h"

namespace seam {

class Turns {
 public:
  /// Requires a world in which all bodies are present.
  explicit Turns(const World& world);

  /// Adds full turns to the angles of a mechanism's bodies, until each hinge with limits is as near
  /// to their middle as turns bring it. `states`: in the order of `bodies`, which is ascending.
  void Right(const std::vector<int>& bodies, std::vector<BodyState>* states) const;

 private:
  /// A limited hinge as seen from one of its bodies.
  struct Hinge {
    int to = -1;
    float middle = 0;  // rad, the angle of `to` less that of the body
  };
  std::vector<std::vector<Hinge>> hinges_;  // rebuilt for each world, by body
};

}  // namespace seam
