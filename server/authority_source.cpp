#include "server/authority_source.h"

#include <utility>

#include "common/sync/quantize.h"

namespace seam {
namespace {

/// Reports farther in the past or future than this are dropped, ticks. The past is long because a
/// report is retransmitted until it arrives.
constexpr std::int64_t kReportPast = 120, kReportFuture = 30;
/// Most reports that wait; a hostile peer must not fill the memory.
constexpr std::size_t kWaitingMax = 1024;

}  // namespace

AuthoritySource::AuthoritySource(const Replica& replica, const AuthorityManager& authority,
                                 Stats& stats)
    : replica_(replica), authority_(authority), stats_(stats), trail_(replica.table()) {}

void AuthoritySource::NoteStates(const States& accepted) {
  for (std::size_t i = 0; i < accepted.id.size(); ++i) {
    const int body = replica_.world().BodyOfId(accepted.id[i]);
    if (body < 0) continue;
    // Unwraps the angle towards the server's copy: it may be off by whole turns.
    trail_.Add(body, accepted.tick, Unpack(accepted, i, replica_.world().Read(body).angle));
  }
}

void AuthoritySource::NoteTick() {
  const World& world = replica_.world();
  for (int body = 0; body < world.body_count(); ++body) {
    if (Mine(body)) trail_.Add(body, world.tick(), world.Read(body));
  }
  ImpactCheck check(world, trail_, world.tick());
  for (const Blow& blow : ImpactsOf(world)) {
    if (!Mine(blow.body)) continue;
    const PartId by = blow.by < 0 ? -1 : world.id(blow.by);
    const Reported found{world.id(blow.body), by,   blow.dv, blow.point, world.tick(),
                         replica_.revision(), false};
    // A correction may push a copy into one of our bodies: an impact that its authority never had.
    if (blow.by < 0 || Mine(blow.by)) {
      accepted_.push_back(found);
    } else {
      Judge(found, &check);
    }
  }
  JudgeWaiting();
  while (!counted_.empty() && std::get<0>(*counted_.begin()) < world.tick() - 2 * kReportPast) {
    counted_.erase(counted_.begin());
  }
}

void AuthoritySource::NoteReport(int peer, const ImpactReport& report) {
  const std::int64_t age = replica_.tick() - report.tick;
  if (age > kReportPast || age < -kReportFuture) {
    ++stats_.dropped_stale;
    return;
  }
  ImpactCheck check(replica_.world(), trail_, report.tick);
  for (std::size_t i = 0; i < report.id.size(); ++i) {
    const Reported reported{report.id[i], report.by[i],    report.dv[i], {report.x[i], report.y[i]},
                            report.tick,  report.revision, true};
    if (MayReport(peer, reported, report.epoch[i])) Judge(reported, &check);
  }
}

bool AuthoritySource::MayReport(int peer, const Reported& reported, std::int32_t epoch) {
  Blow blow;
  if (reported.revision > replica_.revision() || !ToBlow(reported, &blow)) {
    Refuse(reported, &reports_.changed, &stats_.dropped_stale);
    return false;
  }
  switch (authority_.RightToMove(peer, blow.body, epoch)) {
    case AuthorityManager::Right::kYes: return true;
    case AuthorityManager::Right::kStale: ++stats_.dropped_stale; return false;
    case AuthorityManager::Right::kNo: ++stats_.dropped_right; return false;
  }
  return false;
}

bool AuthoritySource::ToBlow(const Reported& reported, Blow* blow) const {
  const World& world = replica_.world();
  blow->body = world.BodyOfId(reported.body);
  blow->by = reported.by < 0 ? -1 : world.BodyOfId(reported.by);
  blow->dv = reported.dv;
  blow->point = reported.point;
  return blow->body >= 0 && replica_.SameBody(blow->body, reported.revision) &&
         (reported.by < 0 || (blow->by >= 0 && replica_.SameBody(blow->by, reported.revision)));
}

void AuthoritySource::Refuse(const Reported& reported, std::int64_t* reason,
                             std::int64_t* dropped) {
  if (!reported.told) return;
  ++*reason;
  ++*dropped;
}

void AuthoritySource::Judge(const Reported& reported, ImpactCheck* check) {
  Blow blow;
  if (!ToBlow(reported, &blow)) return Refuse(reported, &reports_.changed, &stats_.dropped_stale);
  if (check->Possible(blow)) {
    if (!counted_.insert({reported.tick, reported.body, reported.by}).second) {
      return Refuse(reported, &reports_.repeated, &stats_.dropped_stale);
    }
    reports_.accepted += reported.told ? 1 : 0;
    accepted_.push_back(reported);
  } else if (Waits(reported, blow, *check) && waiting_.size() < kWaitingMax) {
    waiting_.push_back(reported);
  } else {
    Refuse(reported, &reports_.implausible, &stats_.dropped_implausible);
  }
}

bool AuthoritySource::Waits(const Reported& reported, const Blow& blow,
                            const ImpactCheck& check) const {
  return check.MoreMayCome(blow) && replica_.tick() - reported.tick <= kReportPast;
}

/// Judges those once more whose states have come, or whose time is up.
void AuthoritySource::JudgeWaiting() {
  for (const Reported& reported : std::exchange(waiting_, {})) {
    ImpactCheck check(replica_.world(), trail_, reported.tick);
    Blow blow;
    if (ToBlow(reported, &blow) && Waits(reported, blow, check)) {
      waiting_.push_back(reported);
    } else {
      Judge(reported, &check);
    }
  }
}

BodyState AuthoritySource::Read(int body) const {
  const StateTrail::Seen* newest = trail_.Newest(body);
  return Mine(body) || newest == nullptr ? replica_.world().Read(body) : newest->state;
}

std::vector<std::int64_t> AuthoritySource::Ticks() const {
  std::vector<std::int64_t> ticks = trail_.NewTicks();
  const std::int64_t now = replica_.world().tick();
  if (ticks.empty() || ticks.back() < now) ticks.push_back(now);
  return ticks;
}

BodyState AuthoritySource::ReadAt(int body, std::int64_t tick) const {
  const std::optional<BodyState> known = trail_.At(body, tick);
  return known ? *known : Read(body);
}

std::int64_t AuthoritySource::TickOf(int body, std::int64_t tick) const {
  const std::int64_t known = trail_.TickOf(body, tick);
  return known >= 0 ? known : replica_.world().tick();
}

std::vector<Blow> AuthoritySource::TakeImpacts() {
  std::vector<Blow> taken;
  for (const Reported& reported : std::exchange(accepted_, {})) {
    Blow blow;
    if (ToBlow(reported, &blow)) taken.push_back(blow);
  }
  return taken;
}

}  // namespace seam
