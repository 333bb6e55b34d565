#include "server/hub/hosted_room.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <utility>

#include "common/base/check.h"
#include "common/base/process.h"
#include "common/scene/lcm/lcm_tables.h"
#include "common/sync/method.h"
#include "server/chronicle.h"

namespace seam {
namespace {

/// Longest time between two runs of a room, us: each run also detects silent clients.
constexpr std::int64_t kRunUs = 20000;

/// Returns the net to use: a network that stays perfect needs no simulation, which would copy every
/// datagram.
Net& Through(const RoomPlan& plan, Net& direct, Net& impaired) {
  return plan.profile.name == "perfect" && !plan.control ? direct : impaired;
}

Sink MakeSink(const RoomPlan& plan) {
  const LogPlace place = plan.resumed != nullptr ? plan.resumed->tail.end : LogPlace();
  const bool goes_on = plan.resumed != nullptr && (!plan.resumed->new_log || place.segment > 0);
  if (!goes_on) {
    // A log of this epoch without a snapshot is that of a server that died at once.
    const bool force = plan.force || (plan.resumed != nullptr && plan.config.epoch > 1);
    return Sink(plan.lcm_url, plan.record, force, plan.config.room, plan.log_key,
                plan.segment_bytes);
  }
  return Sink(plan.lcm_url, plan.record, place, plan.config.room, plan.log_key, plan.segment_bytes);
}

}  // namespace

HostedRoom::HostedRoom(const RoomPlan& plan, int index, RoomFinder& finder, Net& out)
    : plan_(plan),
      net_(finder, index, out),
      impaired_(net_, plan.profile, plan.profile, static_cast<std::uint64_t>(plan.config.seed)),
      sink_(MakeSink(plan)) {
  Net& net = Through(plan, net_, impaired_);
  newest_.room = plan.config.room;
  if (!plan.state.empty()) {
    keeper_ = std::make_unique<RoomKeeper>(plan.state, plan.config.room, sink_, plan.config.epoch,
                                           plan.keep_s);
  }
  if (plan.resumed == nullptr) {
    server_ = std::make_unique<Server>(plan_.scene, plan_.config, net, sink_, entropy_);
  } else {
    server_ = std::make_unique<Server>(*plan.resumed->saved, plan_.config, net, sink_, entropy_);
  }
  if (plan.control) {
    control_ = std::make_unique<RoomControl>(*server_, impaired_, plan.config.impair);
  }
  OpenLcm();
  if (!plan.writers.empty()) server_->chronicle().Keep();
  if (plan.resumed == nullptr) return;
  GoOn(*plan.resumed);
  // In a log of its own the ticks before are not: they are in a snapshot.
  if (keeper_ != nullptr && plan.resumed->new_log) keeper_->Begin(*server_, SteadyClockUs());
}

/// Opens the channels of the scene's [lcm].
void HostedRoom::OpenLcm() {
  const LcmTables& lcm = *plan_.scene.lcm;
  if (sink_.bus() != nullptr) {
    lcm_ = std::make_unique<LcmBridge>(*server_, *sink_.bus());
  } else if (!lcm.publish.empty() || !lcm.message.empty()) {
    news_.push_back("the scene's [lcm] does nothing: the room is not on the bus (--lcm-url)");
  }
}

void HostedRoom::GoOn(const ResumedRoom& resumed) {
  const std::int64_t begin_us = SteadyClockUs();
  const Status status = server_->Resume(*resumed.saved, begin_us, &resumed.tail);
  if (!status.ok()) throw OperatorError(plan_.state + ": " + status.why());
  TakeSummaries();
  news_.insert(news_.end(), resumed.notes.begin(), resumed.notes.end());
  const std::string from = resumed.saved_tick > 0
                               ? "snapshot of tick " + std::to_string(resumed.saved_tick)
                               : "no snapshot";
  char line[200];
  std::snprintf(line, sizeof line, "resumed at tick %lld: %s and %lld ticks of the log, in %.0f ms",
                static_cast<long long>(server_->tick()), from.c_str(),
                static_cast<long long>(server_->tick() - resumed.saved_tick),
                static_cast<double>(SteadyClockUs() - begin_us) * 1e-3);
  news_.push_back(line);
  if (server_->unlike_log() < 0) return;
  news_.push_back("tick " + std::to_string(server_->unlike_log()) +
                  " of the log came out otherwise than it was: bodies may be elsewhere");
}

Status HostedRoom::trouble() const {
  if (!sink_.trouble().ok()) return sink_.trouble();
  if (keeper_ != nullptr && !keeper_->trouble().ok()) return keeper_->trouble();
  for (const auto& writer : plan_.writers) {
    const Status status = writer->trouble();
    if (!status.ok()) return status;
  }
  return Status::Ok();
}

void HostedRoom::Run(std::int64_t now_us) {
  ran_us_ = now_us;
  if (done()) {
    DrainNetwork(now_us);
    return;
  }
  if (over()) return RunOver(now_us);
  const std::int64_t tick = server_->tick(), due_us = server_->next_tick_us();
  const std::int64_t cpu_us = plan_.alone ? 0 : ThreadCpuUs();
  if (control_ != nullptr) control_->BeforeTick(now_us);
  if (lcm_ != nullptr) lcm_->Listen(now_us);
  server_->Tick(now_us, CpuForStats(now_us));
  sink_.Poll();
  watch_.NoteCall(*server_, now_us, SteadyClockUs() - now_us, tick, due_us);
  if (!plan_.alone) watch_.NoteCpu(ThreadCpuUs() - cpu_us);
  if (server_->tick() != tick) NoteTicks();
  if (server_->tick() != tick && lcm_ != nullptr) lcm_->Publish();
  if (server_->tick() != tick && keeper_ != nullptr) keeper_->AfterTick(*server_, now_us);
  CollectReports();
  if (watch_.Due(now_us)) Tell(now_us);
  EndIfDone(now_us);
  // Behind a tick: the next one is due at the other server when it has read this one.
  if (!done()) FollowDirectory(now_us);
  if (over()) RunOver(now_us);
}

void HostedRoom::RunOver(std::int64_t now_us) {
  FollowDirectory(now_us);
  server_->Tick(now_us, 0);
  CollectReports();
}

/// Returns the CPU time for the Stats. These clocks cost as much as a datagram, so they are read
/// only when Stats are due.
std::int64_t HostedRoom::CpuForStats(std::int64_t now_us) const {
  if (!plan_.alone) return watch_.cpu_us();
  return server_->stats_due(now_us) ? CpuUs() : 0;
}

void HostedRoom::EndIfDone(std::int64_t now_us) {
  if (plan_.last_tick == 0 || server_->tick() < plan_.last_tick) return;
  Close(now_us);
  const std::lock_guard<std::mutex> lock(mutex_);
  done_ = true;
}

void HostedRoom::Supersede(const Redirect& elsewhere) {
  const std::lock_guard<std::mutex> lock(mutex_);
  superseded_ = elsewhere;
}

void HostedRoom::FollowDirectory(std::int64_t now_us) {
  Redirect by;
  std::string standby;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (superseded_) by = *std::exchange(superseded_, std::nullopt);
    standby.swap(standby_);
  }
  server_->NameStandby(now_us, standby);
  const bool told = by.epoch > server_->epoch();
  if (!told && server_->shown_epoch() <= server_->epoch()) return;
  if (over() && (by.address.empty() || !told)) return;
  const std::int32_t epoch = std::max(told ? by.epoch : 0, server_->shown_epoch());
  if (by.address.empty()) {
    server_->Forsake(now_us);
  } else {
    server_->RedirectAll(now_us, by);
  }
  sink_.Flush();
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!std::exchange(over_, true)) {
    news_.push_back("room " + plan_.config.room + ": another server has its epoch " +
                    std::to_string(epoch) + ": stopped here in epoch " +
                    std::to_string(server_->epoch()) + ", its files stay");
  }
}

void HostedRoom::NameStandby(const std::string& address) {
  const std::lock_guard<std::mutex> lock(mutex_);
  standby_ = address;
}

bool HostedRoom::over() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return over_;
}

std::int32_t HostedRoom::GiveAway(std::int64_t now_us) {
  sink_.Poll();
  const std::int32_t next = server_->epoch() + 1;
  server_->GiveAway(next);
  if (keeper_ != nullptr) keeper_->Finish(*server_, now_us);
  const std::lock_guard<std::mutex> lock(mutex_);
  over_ = true;
  return next;
}

void HostedRoom::EndGivenAway(std::int64_t now_us) {
  server_->Shutdown(now_us, "the server stops");
  TakeSummaries();
  sink_.Flush();
}

void HostedRoom::RedirectAll(std::int64_t now_us, const Redirect& to) {
  server_->RedirectAll(now_us, to);
  TakeSummaries();
  sink_.Flush();
}

Status HostedRoom::Control(std::int64_t now_us, const std::string& command) {
  if (done() || over()) return Status::Error("the room is over");
  return control_->Do(std::max(now_us, ran_us()), command);
}

std::int64_t HostedRoom::due_us() const {
  if (done()) {
    return impaired_.sending() ? ran_us_ + kRunUs : std::numeric_limits<std::int64_t>::max();
  }
  return std::min({server_->wake_us(), impaired_.next_due_us(), ran_us_ + kRunUs});
}

void HostedRoom::NoteTicks() {
  const std::lock_guard<std::mutex> lock(mutex_);
  newest_.tick = watch_.tick_total();
  newest_.late = watch_.late_total();
}

void HostedRoom::Tell(std::int64_t now_us) {
  if (plan_.alone) watch_.NoteCpu(CpuUs() - watch_.cpu_us());
  const Load load = watch_.Tell(now_us, *server_);
  server_->PublishLoad(load);
  if (!plan_.writers.empty()) Put(server_->Sum(now_us), server_->chronicle().TakeEvents());
  const std::lock_guard<std::mutex> lock(mutex_);
  newest_.load = load;
  newest_.connections = server_->connections();
  newest_.connections.unkept = trouble_reported_ ? 1 : 0;
}

/// Prefixes each event with its time: "12.3 s: bob is gone: left".
void HostedRoom::CollectReports() {
  std::vector<std::string> told = server_->TakeWarnings();
  if (lcm_ != nullptr) {
    for (std::string& refused : lcm_->TakeReports()) told.push_back(std::move(refused));
  }
  const std::vector<std::string> come_and_gone = server_->TakeReports();
  if (plan_.news && !come_and_gone.empty()) {
    char when[40] = "";
    if (server_->started()) {
      const auto tick = static_cast<double>(std::max<std::int64_t>(0, server_->tick()));
      std::snprintf(when, sizeof when, "%.1f s: ", tick / plan_.config.sync.tick_hz);
    }
    for (const std::string& news : come_and_gone) told.push_back(when + news);
  }
  if (keeper_ != nullptr) {
    for (std::string& news : keeper_->TakeNews()) told.push_back(std::move(news));
  }
  if (!trouble_reported_ && !trouble().ok()) {
    trouble_reported_ = true;
    told.push_back(trouble().why() + "; the room runs on");
  }
  if (told.empty()) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const std::string& each : told) {
    news_.push_back(plan_.alone ? each : "room " + plan_.config.room + ": " + each);
  }
}

RoomLoad HostedRoom::newest() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return newest_;
}

bool HostedRoom::done() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return done_;
}

std::vector<std::string> HostedRoom::TakeReports() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(news_, {});
}

void HostedRoom::Close(std::int64_t now_us) {
  sink_.Poll();
  if (over()) {
    server_->Forsake(now_us);
    TakeSummaries();
  } else if (!done()) {
    if (keeper_ != nullptr) keeper_->Finish(*server_, now_us);
    server_->Shutdown(now_us, "the server stops");
    TakeSummaries();
  }
  sink_.Flush();
}

void HostedRoom::TakeSummaries() {
  for (Summary& summary : server_->chronicle().TakeEnded()) {
    const bool ours = summary.of == server_->room().session;
    if (!plan_.writers.empty()) {
      Put(summary, ours ? server_->chronicle().TakeEvents() : std::vector<Event>());
    }
    summaries_.push_back(std::move(summary));
  }
}

void HostedRoom::Put(const Summary& summary, std::vector<Event> events) {
  StoredSession part;
  part.room = plan_.config.room;
  part.scene = plan_.scene.name;
  const MethodNames method = NamesOf(plan_.config.sync);
  part.method = method.mode + (method.reconcile.empty() ? "" : "/" + method.reconcile);
  part.tick_hz = plan_.config.sync.tick_hz;
  part.now_us = WallClockUs();
  part.summary = summary;
  part.events = std::move(events);
  for (const auto& writer : plan_.writers) writer->Put(part);
}

bool HostedRoom::DrainNetwork(std::int64_t now_us) {
  impaired_.Advance(now_us);
  impaired_.Flush();
  return impaired_.sending();
}

}  // namespace seam
