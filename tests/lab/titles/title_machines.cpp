/// The scenes whose titles are about machines.

#include <cmath>

#include "common/base/geometry.h"
#include "tests/lab/titles/titles.h"

namespace seam {
namespace {

/// Both pieces of the glued crate stand on the boat's deck, and the boat floats upright.
void JudgeAboard(const Screen& screen, double half_deck, Claims* claims) {
  const BodyState boat = screen.AtEnd("boat");
  claims->Between(boat.angle, -0.15, 0.15, "heel of the boat, rad");
  for (const char* name : {"crate.0.0", "crate.1.0"}) {
    const BodyState piece = screen.AtEnd(name);
    const Vec2 on_deck = Turned(piece.position - boat.position, -boat.angle);
    claims->Between(on_deck.y(), 0.9, 1.03, std::string(name) + " over the deck, m");
    claims->Between(on_deck.x(), -half_deck, half_deck, std::string(name) + " along the deck, m");
  }
}

}  // namespace

void JudgeCrane(const Screen& screen, Claims* claims) {
  JudgeAboard(screen, 2.5, claims);
  claims->AtLeast(screen.AtEnd("crate.0.0").position.x() - screen.AtStart("crate.0.0").position.x(),
                  8, "how far the crate was carried, m");
}

void JudgeConveyor(const Screen& screen, Claims* claims) {
  claims->Between(screen.Edits<RemoveEdit>(), 0, 0, "boxes that were lost");
  int across = 0;
  for (const std::string& box : screen.All("box.")) {
    double way = 0;
    bool left = false, right = false;  // of the seam
    std::optional<BodyState> before;
    for (double time_s = 1; time_s <= screen.end_s(); time_s += 0.25) {
      const std::optional<BodyState> state = screen.Find(box, time_s);
      if (!state) continue;
      claims->AtLeast(state->position.y(), -1, box + " above the pit, m");
      if (before) way += (state->position - before->position).norm();
      left = left || state->position.x() < -0.5f;
      right = right || state->position.x() > 0.5f;
      before = state;
    }
    claims->AtLeast(way, 5, "way of " + box + ", m");
    across += left && right ? 1 : 0;
  }
  claims->AtLeast(across, 3, "boxes that crossed the seam");
}

void JudgeDockside(const Screen& screen, Claims* claims) {
  JudgeAboard(screen, 3.2, claims);
  claims->AtLeast(screen.AtEnd("boat").position.x(), 20, "the boat by the pier, m");
  const Vec2 away = screen.AtEnd("sailor.torso").position - screen.AtEnd("boat").position;
  claims->Between(away.norm(), 0, 4, "the driver from the boat's middle, m");
  claims->AtLeast(screen.Score(0), 10, "ann's points");
  claims->AtLeast(screen.Score(1), 50, "bob's points");
}

void JudgeTracks(const Screen& screen, Claims* claims) {
  claims->AtLeast(screen.AtEnd("crawler").position.x(), 17, "the crawler on the plateau, m");
  claims->AtLeast(screen.AtEnd("crawler").position.y(), 6.2, "height of the crawler, m");
  claims->Between(screen.AtEnd("buggy").position.x(), -30, 1, "the buggy before the step, m");
}

}  // namespace seam
