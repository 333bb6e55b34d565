/// The scenes whose titles are about what is built of bricks.

#include <algorithm>

#include "tests/lab/titles/titles.h"

namespace seam {

void JudgeGluehouse(const Screen& screen, Claims* claims) {
  claims->AtLeast(screen.Edits<BreakEdit>(), 8, "bonds that broke");
  double highest = 0;
  for (const std::string& brick : screen.All("roof.")) {
    highest = std::max<double>(highest, screen.AtEnd(brick).position.y());
  }
  claims->Between(highest, 0, 5.5, "height of the roof's highest brick, m");
  const double dozer_s = 3.5;
  claims->AtLeast(screen.Edits<BondEdit>(dozer_s), 1, "bonds since the dozer set off");
  const double way = screen.At("dozer", 8).position.x() - screen.At("dozer", dozer_s).position.x();
  claims->AtLeast(std::abs(way), 1, "way of the dozer, m");
}

void JudgeFoundation(const Screen& screen, Claims* claims) {
  const double before_s = 0.8, thrown_s = 1.5;  // before the crate lands, and when the ball starts
  const int early = screen.Edits<BreakEdit>() - screen.Edits<BreakEdit>(before_s);
  claims->Between(early, 0, 0, "bonds that broke under their own weight");
  claims->AtLeast(screen.Edits<BreakEdit>(thrown_s), 8, "bonds that the ball broke");
  double highest = 0;
  for (const std::string& brick : screen.All("roof.")) {
    highest = std::max<double>(highest, screen.AtEnd(brick).position.y());
  }
  claims->Between(highest, 0, 3.35, "height of the roof's highest brick, m");
  claims->Between(screen.AtEnd("balcony").position.y(), 0, 2, "its height at the end, m");
  claims->Between(screen.AtEnd("crate").position.y(), 0, 2, "height of the crate, m");
}

void JudgeSkyline(const Screen& screen, Claims* claims) {
  const double upper = 50, lower = 42;  // m, heights of the roads
  claims->Between(screen.AtEnd("ann-car").position.y(), 0, upper - 4, "ann's height, m");
  claims->Between(screen.AtEnd("bob-car").position.y(), 0, lower - 4, "bob's height, m");
  claims->AtLeast(
      screen.CountAtEnd("crate.",
                        [&](const std::string& name, const BodyState& state) {
                          return (state.position - screen.AtStart(name).position).norm() > 1;
                        }),
      6, "crates that ann moved");
  claims->AtLeast(screen.Edits<BlastEdit>(), 1, "blasts");
  int roofs = 0, streets = 0;
  for (const char* kind : {"ball.", "box."}) {
    roofs += screen.CountAtEnd(kind, [](const std::string&, const BodyState& state) {
      return state.position.y() > 15 && state.position.y() < 41 && state.velocity.norm() < 0.5;
    });
    streets += screen.CountAtEnd(
        kind, [](const std::string&, const BodyState& state) { return state.position.y() < 1.5; });
  }
  claims->AtLeast(roofs, 10, "things at rest on roofs");
  claims->AtLeast(streets, 10, "things in the streets");
}

}  // namespace seam
