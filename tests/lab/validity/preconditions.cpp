#include "tests/lab/validity/preconditions.h"

#include "common/scene/expected.h"
#include "common/sync/mode.h"

namespace seam {
namespace {

/// Of the loss that the profile says, what must have been measured.
constexpr double kLossShareMin = 0.9;
/// Standard deviations by which chance may stay below that.
constexpr double kLossDeviations = 3;

/// Whether authority moves in this mode while the session runs.
bool HandsOver(const Room& room) {
  const std::optional<Mode> mode = FindMode(room.mode);
  return mode == Mode::kBuffer || mode == Mode::kStrict;
}

}  // namespace

bool LossTooSmall(const ImpairProfile& profile, const ImpairedTraffic& traffic) {
  const double due = kLossShareMin * MeanLoss(profile) * static_cast<double>(traffic.offered);
  const double chance = kLossDeviations * LossDeviation(profile, traffic.offered);
  return static_cast<double>(traffic.lost) < due - chance;
}

std::string InvalidReason(const RunFacts& run) {
  const Expected& expected = *run.scene.expected;
  if (run.measures.compared == 0) return "no view was compared";
  if (expected.contact && !run.oracle.contact) return "no contact between two players' bodies";
  if (expected.hand_over && HandsOver(run.recording.room) && run.measures.handovers == 0) {
    return "no hand-over";
  }
  if (expected.edit && run.oracle.edits.empty()) return "no edit";
  if (LossTooSmall(run.network, run.traffic)) return "the network lost less than its profile says";
  return "";
}

}  // namespace seam
