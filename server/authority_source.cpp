#include "server/authority_source.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <utility>

#include "common/scene/saved/persist_state.h"
#include "common/sync/quantize.h"
#include "server/rules/touch_check.h"

namespace seam {
namespace {

/// Reports farther in the past or future than this are dropped, ticks. The past is long because a
/// report is retransmitted until it arrives.
constexpr std::int64_t kReportPast = 120, kReportFuture = 30;
/// Most reports that wait; a hostile peer must not fill the memory.
constexpr std::size_t kWaitingReportsMax = 1024;

}  // namespace

AuthoritySource::AuthoritySource(const Replica& replica, const AuthorityManager& authority,
                                 Stats& stats)
    : replica_(replica),
      authority_(authority),
      stats_(stats),
      trail_(replica.table()),
      holders_(replica.table(), BodyRule::kOrigin) {}

void AuthoritySource::NoteStates(const States& accepted) {
  for (std::size_t i = 0; i < accepted.id.size(); ++i) {
    const int body = replica_.world().BodyOfId(accepted.id[i]);
    if (body < 0) continue;
    Holders& holders = holders_[body];
    const Held held{accepted.peer, accepted.epoch[i]};
    if (!(holders.last == held)) holders = {held, holders.last};
    // Unwraps the angle towards the server's copy: it may be off by whole turns.
    const BodyState told = Unpack(accepted, i, replica_.world().Read(body).angle);
    const auto way = [this, body](std::int64_t tick) { return replica_.SettledPast(body, tick); };
    trail_.Add(body, accepted.tick, told, way);
  }
}

void AuthoritySource::NoteTick(const std::vector<NewTouch>& touches) {
  const auto old = [this](const ToldTouch& told) {
    return told.is.tick < replica_.tick() - kReportPast;
  };
  told_.erase(std::remove_if(told_.begin(), told_.end(), old), told_.end());
  for (const NewTouch& touch : touches) NoteTouch(0, touch);
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

/// Two peers tell of one touch if its authority changes hands at that moment.
void AuthoritySource::NoteTouch(int peer, const NewTouch& touch) {
  const bool known = std::any_of(told_.begin(), told_.end(), [&](const ToldTouch& told) {
    return told.peer != peer && told.is.touch == touch.touch &&
           std::llabs(told.is.tick - touch.tick) <= ImpactReporter::kSameImpactTicks;
  });
  told_.push_back({touch, peer});
  if (!known) touches_.push_back(touch.touch);
}

void AuthoritySource::NoteReport(int peer, const TouchReport& report) {
  const std::int64_t age = replica_.tick() - report.tick;
  if (age > kReportPast || age < -kReportFuture || report.revision > replica_.revision()) {
    ++stats_.dropped_stale;
    return;
  }
  for (std::size_t i = 0; i < report.a.size(); ++i) {
    if (IsGone(report.a[i]) || IsGone(report.b[i])) {
      ++stats_.dropped_stale;
    } else if (!MayReport(peer, report, i)) {
      ++stats_.dropped_right;
    } else if (DoubtedPart(report.a[i]) || DoubtedPart(report.b[i]) ||
               !MayTouch(replica_.world(), trail_, {report.a[i], report.b[i]}, report.tick)) {
      ++stats_.dropped_implausible;
    } else {
      NoteTouch(peer, {{report.a[i], report.b[i]}, report.tick});
    }
  }
}

bool AuthoritySource::IsGone(PartId part) const {
  const std::vector<int>& assembly = replica_.world().composition().assembly_of_part;
  const auto index = static_cast<std::size_t>(part);
  return index >= assembly.size() || assembly[index] < 0;
}

bool AuthoritySource::DoubtedPart(PartId part) const {
  const World& world = replica_.world();
  const int assembly = world.composition().assembly_of_part[static_cast<std::size_t>(part)];
  const Assembly& its = world.composition().assemblies[static_cast<std::size_t>(assembly)];
  return !its.anchored && Doubted(world.BodyOfId(its.id));
}

bool AuthoritySource::MayReport(int peer, const TouchReport& report, std::size_t i) const {
  const World& world = replica_.world();
  for (const PartId part : {report.a[i], report.b[i]}) {
    const int assembly = world.composition().assembly_of_part[static_cast<std::size_t>(part)];
    const Assembly& its = world.composition().assemblies[static_cast<std::size_t>(assembly)];
    if (!its.anchored) return MayTell(peer, world.BodyOfId(its.id), report.epoch[i]);
  }
  return false;
}

/// A touch just before a hand-over is told after it: states of that epoch show that the peer had
/// it.
bool AuthoritySource::MayTell(int peer, int body, std::int32_t epoch) const {
  if (authority_.RightToMove(peer, body, epoch) == AuthorityManager::Right::kYes) return true;
  const Held held{peer, epoch};
  return holders_[body].last == held || holders_[body].before == held;
}

bool AuthoritySource::MayReport(int peer, const Reported& reported, std::int32_t epoch) {
  Blow blow;
  if (reported.revision > replica_.revision() || !ToBlow(reported, &blow)) {
    Refuse(reported, &reports_.changed, &stats_.dropped_stale);
    return false;
  }
  if (Doubted(blow.body) || (blow.by >= 0 && Doubted(blow.by))) {
    Refuse(reported, &reports_.implausible, &stats_.dropped_implausible);
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
  } else if (Waits(reported, blow, *check) && waiting_.size() < kWaitingReportsMax) {
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

void AuthoritySource::Persist(StateArchive& a) {
  trail_.Persist(a);
  a.Section("reports");
  a.Exactly(&holders_, [&](Holders* holders) {
    for (Held* held : {&holders->last, &holders->before}) {
      a.Int(&held->peer, -1, kPeersMax - 1);
      a.Int(&held->epoch, -1, INT32_MAX);
    }
  });
  PersistReports(a);
}

void AuthoritySource::PersistReports(StateArchive& a) {
  const std::size_t parts = replica_.world().scene().parts.size();
  const auto touch = [&](PartTouch* t) {
    PersistPart(a, &t->a, parts);
    PersistPart(a, &t->b, parts);
    a.Require(t->a >= 0 && t->b >= 0, "a touch is of no part");
  };
  a.List(&told_, StateArchive::kListMost, [&](ToldTouch* told) {
    touch(&told->is.touch);
    a.Tick(&told->is.tick);
    a.Int(&told->peer, 0, kPeersMax - 1);
  });
  a.List(&touches_, StateArchive::kListMost, touch);
  for (std::vector<Reported>* reports : {&accepted_, &waiting_}) {
    a.List(reports, StateArchive::kListMost, [&](Reported* r) {
      PersistPart(a, &r->body, parts);
      PersistPart(a, &r->by, parts);
      a.Real(&r->dv, std::numeric_limits<float>::max());
      seam::Persist(a, &r->point, std::numeric_limits<float>::max());
      a.Tick(&r->tick);
      a.Int(&r->revision, 0, replica_.revision());
      a.Flag(&r->told);
    });
  }
  a.Members(&counted_, StateArchive::kListMost, [&](std::tuple<std::int64_t, PartId, PartId>* of) {
    a.Tick(&std::get<0>(*of));
    PersistPart(a, &std::get<1>(*of), parts);
    PersistPart(a, &std::get<2>(*of), parts);
  });
}

}  // namespace seam
