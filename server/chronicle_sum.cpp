/// Chronicle: the sum of a session.

#include <algorithm>
#include <sstream>

#include "server/broadcast.h"
#include "server/chronicle.h"
#include "server/rules/rules.h"
#include "server/trust/trust_ladder.h"

namespace seam {
namespace {

float ScoreOf(const Rules* rules, int player) {
  return rules == nullptr || player < 0 ? 0
                                        : rules->metadata().Get({kMetaPlayer, player, kMetaScore});
}

}  // namespace

Summary Chronicle::Sum(std::int64_t now_us, Ended ended, const TrustLadder& ladder,
                       const Rules* rules) {
  Summary sum;
  sum.utime = now_us;
  sum.tick = replica_.tick();
  sum.of = room_.session;
  sum.ended = static_cast<std::int8_t>(ended);
  sum.ticks = ticks_;
  sum.late_ticks = late_ticks_;
  sum.edits = edits_;
  sum.hand_overs = hand_overs_;
  sum.events = events_;
  sum.events_dropped = dropped_;
  for (const ClientAccount& account : sessions_.accounts().List()) {
    if (account.sessions == 0 || ++sum.clients > static_cast<std::int32_t>(kSummaryClientsMax)) {
      continue;
    }
    sum.names += (sum.names.empty() ? "" : " ") + account.name;
    sum.peer.push_back(account.peer);
    sum.player.push_back(account.player);
    sum.joins.push_back(account.sessions);
    sum.rejoins.push_back(account.rejoins);
    sum.present_ticks.push_back(account.PresentTicks(replica_.tick()));
    sum.score.push_back(ScoreOf(rules, account.player));
    sum.bytes_in.push_back(account.bytes_in);
    sum.bytes_out.push_back(account.bytes_out);
    sum.rtt_us.push_back(static_cast<std::int32_t>(account.rtt_us()));
    sum.rtt_worst_us.push_back(
        static_cast<std::int32_t>(account.readings > 0 ? account.rtt_us_max : -1));
    sum.loss_ppm.push_back(static_cast<std::int32_t>(account.loss_ppm()));
    sum.corrections.push_back(account.corrections);
    sum.malformed.push_back(account.dropped.malformed);
    sum.stale.push_back(account.dropped.stale);
    sum.right.push_back(account.dropped.right);
    sum.implausible.push_back(account.dropped.implausible);
    sum.budget.push_back(account.dropped.budget);
    sum.hand_overs_to.push_back(account.hand_overs);
    const bool steps = account.player >= 0;
    sum.trust.push_back(steps ? static_cast<std::int8_t>(ladder.step(account.player))
                              : std::int8_t{0});
  }
  return sum;
}

void Chronicle::Publish(std::int64_t now_us, const Summary& summary) {
  summed_us_ = now_us;
  changed_ = false;
  broadcast_.Publish(summary);
  if (summary.ended != 0) ended_.push_back(summary);
}

void Chronicle::SumKilled(std::int64_t now_us, Summary last, const std::vector<int>& present,
                          const Rules* rules) {
  std::istringstream names(last.names);
  for (std::string name; names >> name;) sessions_.accounts().Of(name).known = true;
  if (last.ended != 0) return;  // it was stopped in order
  const std::int64_t more = std::max<std::int64_t>(0, replica_.tick() - last.tick);
  last.utime = now_us;
  last.tick = replica_.tick();
  last.ticks += more;
  last.ended = static_cast<std::int8_t>(Ended::kKilled);
  for (std::size_t i = 0; i < last.player.size(); ++i) {
    const bool here = std::count(present.begin(), present.end(), last.player[i]) > 0;
    if (here) last.present_ticks[i] += more;
    if (rules != nullptr) last.score[i] = ScoreOf(rules, last.player[i]);
  }
  Publish(now_us, last);
}

}  // namespace seam
