#include "server/trust/trust_ladder.h"

#include <algorithm>

#include "common/base/check.h"
#include "common/base/state_archive.h"
#include "common/record/events/event_text.h"

namespace seam {
namespace {

/// Largest score: a liar's score may not grow for minutes.
constexpr float kScoreMax = 2 * TrustLadder::kDistrusted;

}  // namespace

const char* ToString(TrustStep step) { return TrustStepName(static_cast<std::int8_t>(step)); }

TrustMode ParseTrustMode(const std::string& text) {
  if (text == "off") return TrustMode::kOff;
  if (text == "watch") return TrustMode::kWatch;
  if (text == "act") return TrustMode::kAct;
  throw OperatorError("--trust \"" + text + "\": not off, watch or act");
}

TrustLadder::TrustLadder(std::size_t players, int tick_hz)
    : tick_hz_(tick_hz), standings_(players) {}

void TrustLadder::Note(int player, float weight) {
  Standing& standing = standings_[static_cast<std::size_t>(player)];
  standing.score = std::min(kScoreMax, standing.score + weight);
}

void TrustLadder::Withhold(int player, std::int64_t until) {
  std::int64_t& withheld = standings_[static_cast<std::size_t>(player)].withheld_until;
  withheld = std::max(withheld, until);
}

bool TrustLadder::Excuse(int player, std::int64_t tick) {
  Standing& standing = standings_[static_cast<std::size_t>(player)];
  if (tick < standing.excused_until) return true;
  const std::int64_t every = std::int64_t{kExcuseEveryS} * tick_hz_;
  const std::int64_t paid = std::max(standing.excuses_paid, tick - kExcusesAtOnce * every) + every;
  if (paid > tick) return false;
  standing.excuses_paid = paid;
  standing.excused_until = tick + kReturnS * tick_hz_;
  return true;
}

bool TrustLadder::MayHold(int player, std::int64_t tick) const {
  const Standing& standing = At(player);
  return standing.step < TrustStep::kServerHolds && tick >= standing.withheld_until;
}

TrustStep TrustLadder::Next(Standing* standing, std::int64_t tick) const {
  if (standing->step >= TrustStep::kServerHolds && tick < standing->until) return standing->step;
  if (tick >= standing->forgotten) standing->falls = 0;
  if (standing->score >= kDistrusted) {
    standing->score = 0;
    const int falls = std::min(2, standing->falls);
    const int seconds[] = {kHeldS, kInputsOnlyS, kRememberS};
    standing->falls = falls + 1;
    standing->until = tick + seconds[falls] * tick_hz_;
    standing->forgotten = standing->until + kRememberS * tick_hz_;
    return static_cast<TrustStep>(static_cast<int>(TrustStep::kServerHolds) + falls);
  }
  if (standing->score >= kWatched) return TrustStep::kWatched;
  return standing->score >= kNoted ? TrustStep::kNoted : TrustStep::kTrusted;
}

std::vector<TrustLadder::Change> TrustLadder::Update(std::int64_t tick) {
  std::vector<Change> changes;
  for (std::size_t p = 0; p < standings_.size(); ++p) {
    Standing& standing = standings_[p];
    const TrustStep before = standing.step;
    standing.step = Next(&standing, tick);
    standing.score = std::max(0.0f, standing.score - kLeakPerS / static_cast<float>(tick_hz_));
    if (standing.step != before) changes.push_back({static_cast<int>(p), before, standing.step});
  }
  return changes;
}

void TrustLadder::Persist(StateArchive& a) {
  a.Section("trust");
  a.Exactly(&standings_, [&](Standing* standing) {
    int step = static_cast<int>(standing->step);
    a.Int(&step, 0, static_cast<int>(TrustStep::kOut));
    standing->step = static_cast<TrustStep>(step);
    a.Real(&standing->score);
    a.Int(&standing->falls, 0, 3);
    a.Tick(&standing->until);
    a.Tick(&standing->forgotten);
    a.Tick(&standing->withheld_until);
  });
}

}  // namespace seam
