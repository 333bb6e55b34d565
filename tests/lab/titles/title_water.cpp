/// The scenes whose titles are about what floats.

#include <cmath>

#include "tests/lab/titles/titles.h"

namespace seam {

void JudgeTitanic(const Screen& screen, Claims* claims) {
  const BodyState keel = screen.AtEnd("keel"), bow = screen.AtEnd("bow.5.5");
  claims->AtLeast(keel.position.x(), 2, "how far the keel is beyond the seam, m");
  claims->AtLeast(-bow.position.y(), 8, "how deep the bow is, m");
  claims->AtLeast(keel.position.y() - bow.position.y(), 5, "how far the bow is below the keel, m");
  claims->AtLeast(keel.angle, 0.03, "how far it trims by the stern, rad");
  claims->AtLeast(screen.AtEnd("deck.20.3").position.y(), 0.5, "the deck above the water, m");
  claims->AtLeast(screen.AtEnd("iceberg").position.x() - screen.AtStart("iceberg").position.x(), 1,
                  "how far the iceberg was pushed, m");
}

void JudgeHarbour(const Screen& screen, Claims* claims) {
  claims->AtLeast(screen.AtEnd("boat").position.x(), 2, "how far the boat is beyond the seam, m");
  int moved = 0;
  for (const char* kind : {"cork", "crate", "awash", "drum", "log", "wedge", "leaded"}) {
    for (const std::string& name : screen.All(kind)) {
      const Vec2 end = screen.AtEnd(name).position;
      if (end.x() - screen.AtStart(name).position.x() > 1) ++moved;
      claims->AtLeast(end.y(), -1.5, name + " in the water, m");
    }
  }
  claims->AtLeast(moved, 8, "things that were moved by a metre");
  claims->AtLeast(-screen.AtEnd("wreck").position.y(), 4, "depth of the wreck, m");
}

void JudgeRegatta(const Screen& screen, Claims* claims) {
  const float thin = screen.AtEnd("thin").position.x(), thick = screen.AtEnd("thick").position.x();
  claims->AtLeast(thick, 1, "how far the thick boat is beyond the seam, m");
  claims->AtLeast(thin - thick, 3, "how far the thin boat is ahead, m");
}

}  // namespace seam
