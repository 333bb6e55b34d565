/// The scenes whose titles are about what is carried.

#include "tests/lab/titles/titles.h"

namespace seam {

void JudgeFreight(const Screen& screen, Claims* claims) {
  const double rolls_s = 5, thrown_s = 9;  // until then; when the keg flies
  claims->AtLeast(screen.Edits<BondEdit>() - screen.Edits<BondEdit>(2), 55,
                  "bonds made within 2 s");
  claims->Between(screen.Edits<BreakEdit>(2) - screen.Edits<BreakEdit>(rolls_s), 0, 5,
                  "bonds undone while it rolls");
  claims->AtLeast(screen.Edits<BreakEdit>(rolls_s) - screen.Edits<BreakEdit>(thrown_s), 55,
                  "bonds undone by the brake");
  claims->AtLeast(screen.At("cart", thrown_s).position.x(), 5, "where the cart stands, m");
  int crates = 0, kept = 0, moved = 0;
  for (const char* row : {"row-0.", "row-1.", "row-2.", "row-3.", "row-4."}) {
    for (const std::string& crate : screen.All(row)) {
      ++crates;
      const auto from = [&](double time_s) {
        return Vec2(screen.At(crate, time_s).position - screen.At("cart", time_s).position);
      };
      const Vec2 place = screen.AtStart(crate).position - screen.AtStart("cart").position;
      if ((from(thrown_s) - place).norm() < 0.1f) ++kept;
      if ((from(screen.end_s()) - place).norm() > 0.3f) ++moved;
    }
  }
  claims->Between(crates, 60, 60, "crates");
  claims->AtLeast(kept, 60, "crates in their places before the keg");
  claims->AtLeast(moved, 10, "crates that the keg moved");
}

}  // namespace seam
