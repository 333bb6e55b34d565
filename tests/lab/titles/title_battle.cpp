/// The scene whose title is about explosions.

#include <algorithm>
#include <cmath>

#include "tests/lab/titles/titles.h"

namespace seam {
namespace {

constexpr double kMine_s = 3.9, kAfterMine_s = 6.8;  // before the mine, and when its crate lies

double WayOf(const Screen& screen, const std::string& crate) {
  const Vec2 from = screen.At(crate, kMine_s).position;
  return (screen.At(crate, kAfterMine_s).position - from).norm();
}

/// The largest lean of the torso after its shell, and that at the end, rad.
void JudgeThrown(const Screen& screen, const std::string& who, double shell_s, Claims* claims) {
  const std::string torso = who + "-body.torso";
  double lean = 0;
  for (double time_s = shell_s; time_s < shell_s + 3; time_s += 0.1) {
    const BodyState state = screen.At(torso, time_s);
    lean = std::max(lean, std::fabs(std::remainder(static_cast<double>(state.angle), 2 * M_PI)));
  }
  claims->AtLeast(lean, 1, "how far " + who + " leans after the shell, rad");
  const BodyState end = screen.AtEnd(torso);
  claims->Between(std::remainder(static_cast<double>(end.angle), 2 * M_PI), -0.52, 0.52,
                  who + "'s lean at the end, rad");
  const double head = static_cast<double>(screen.AtEnd(who + "-body.head").position.y());
  claims->AtLeast(head, 1.4, "height of " + who + "'s head at the end, m");
}

}  // namespace

void JudgeBattlefield(const Screen& screen, Claims* claims) {
  claims->AtLeast(screen.Edits<BlastEdit>(), 4, "blasts");
  const double open = WayOf(screen, "open");
  claims->AtLeast(open, 2, "way of the open crate, m");
  claims->Between(WayOf(screen, "covered"), 0, 0.05 * open, "way of the crate behind the wall, m");
  const auto& views = screen.recording().views.at(screen.peer());
  const View& last = views.rbegin()->second;
  int pieces = 0;
  double top = 0;
  for (std::size_t i = 0; i < last.id.size(); ++i) {
    if (last.id[i] < static_cast<PartId>(screen.scene().parts.size())) continue;
    ++pieces;
    top = std::max(top, static_cast<double>(last.y[i]));
  }
  claims->AtLeast(pieces, 10, "pieces of the hut");
  claims->Between(top, 0, 1.5, "height of the highest piece of the hut, m");
  claims->AtLeast(screen.Edits<BreakEdit>(), 1, "limbs that came off");
  claims->Between(screen.AtEnd("dummy.torso").position.y(), 0, 2, "height of the dummy, m");
  JudgeThrown(screen, "ann", 12, claims);
  JudgeThrown(screen, "bob", 13, claims);
}

}  // namespace seam
