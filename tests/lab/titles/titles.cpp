#include "tests/lab/titles/titles.h"

#include <fmt/format.h>

#include "common/base/check.h"
#include "common/base/nearest.h"

namespace seam {

void Claims::Between(double value, double least, double most, const std::string& what) {
  Expect(value >= least && value <= most,
         fmt::format("{}: {:.3g} is not in {:g}..{:g}", what, value, least, most));
}

void Claims::AtLeast(double value, double least, const std::string& what) {
  Expect(value >= least, fmt::format("{}: {:.3g} is less than {:g}", what, value, least));
}

const std::vector<Title>& Titles() {
  static const std::vector<Title> titles = {
      {"titanic",
       "The bow breaks off at the bulkhead and lies 8 m deep or deeper; the rest crosses the seam, "
       "trims by the stern and floats.",
       JudgeTitanic},
      {"harbour",
       "The boat crosses the seam and moves at least eight of the things that float by more than a "
       "metre; what floats stays afloat, what is sunk stays on the bed.",
       JudgeHarbour},
      {"regatta",
       "Both boats cross the seam by their paddles alone, and the thin one is at least 3 m ahead.",
       JudgeRegatta},
      {"gluehouse",
       "The ball breaks at least eight bonds and the roof comes down by 2 m or more; after the "
       "dozer has set off, pieces join again.",
       JudgeGluehouse},
      {"foundation",
       "The house stands on its foundation until the ball breaks eight bonds and more and its roof "
       "comes down by 2 m; the crate breaks the balcony off its tower.",
       JudgeFoundation},
      {"skyline",
       "ann drives through the crates and off the upper road, bob off the lower one onto the "
       "roofs; a blast frees bricks; ten things and more lie on roofs, ten and more in the "
       "streets.",
       JudgeSkyline},
      {"crane",
       "ann's crane lifts the glued crate over the seam and sets it into the boat, in one piece.",
       JudgeCrane},
      {"conveyor",
       "Every box is carried on, three and more over the seam, and none is lost (in ten minutes "
       "each goes round 24 times).",
       JudgeConveyor},
      {"dockside",
       "The crane loads the boat, its driver comes aboard and takes it to the pier: 10 points for "
       "ann and 50 for bob.",
       JudgeDockside},
      {"tracks",
       "The tracked vehicle climbs the step and the slope to the plateau; the wheeled one stays "
       "before the step.",
       JudgeTracks},
      {"ragdolls",
       "Of six limp bodies four come down the stairs, one is struck off the ledge, and these five "
       "end in one heap at the bottom; the sixth still hangs by its foot.",
       JudgeRagdolls},
      {"obstacle",
       "ann and bob swim past each other, leave the water on the other's side and stand there.",
       JudgeObstacle},
      {"freight",
       "Sixty crates become one body within 2 s and stay so over the seam; the brake makes them "
       "single and moves none by 0.1 m; a keg then moves ten or more.",
       JudgeFreight},
      {"playground",
       "ann gets in, drives over the seam and gets out; the crawler moves crates, the boat crosses "
       "into dee's region, the tower falls, the ragdoll comes down, and ann has 20 points.",
       JudgePlayground},
      {"battlefield",
       "The crate in the open flies 2 m or more and the one behind the wall moves less "
       "than a twentieth of that; the hut comes down to below 1.5 m and a limb comes off; "
       "ann and bob are thrown and stand again at the end.",
       JudgeBattlefield},
      {"relay8",
       "One puck goes from one end of eight regions to the other and back; two more meet in the "
       "middle and throw each other back to the ends.",
       JudgeRelay8},
      {"derby",
       "A red and a blue car come together twelve times and more, six cars or more take "
       "part, and none leaves the hollow.",
       JudgeDerby},
      {"pile",
       "Every blade goes 0.8 m or more, at least fifteen boxes of each heap and eighty in "
       "all move by half a metre.",
       JudgePile, 0, 10},
      {"swarm",
       "Each of the players who are there drives a sled 8 m or more and shoves two crates "
       "and more by a metre; the sleds of those who are absent stand.",
       JudgeSwarm, 4},
  };
  return titles;
}

const Title& TitleOf(const std::string& scene) {
  std::vector<std::string> known;
  for (const Title& title : Titles()) {
    if (scene == title.scene) return title;
    known.emplace_back(title.scene);
  }
  throw OperatorError("nothing is written of what '" + scene + "' should do" +
                      DidYouMean(scene, known));
}

std::string MissedBy(const Title& title, const Recording& recording) {
  const Played played(recording);
  if (recording.views.empty()) return "nothing was shown";
  for (const auto& [peer, views] : recording.views) {
    const Screen screen(played, peer);
    Claims claims;
    try {
      title.judge(screen, &claims);
    } catch (const OperatorError& error) {
      claims.Expect(false, error.what());
    }
    if (!claims.missed().empty()) return fmt::format("peer {}: {}", peer, claims.missed());
  }
  return "";
}

}  // namespace seam
