#include "server/hub/hosted_room.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <utility>

#include "common/base/process.h"

namespace seam {
namespace {

/// Longest time between two runs of a room, us: each run also detects silent clients.
constexpr std::int64_t kRunUs = 20000;

/// Returns the net to use: a perfect network needs no simulation, which would copy every datagram.
Net& Through(const ImpairProfile& profile, Net& direct, Net& impaired) {
  return profile.name == "perfect" ? direct : impaired;
}

}  // namespace

HostedRoom::HostedRoom(const RoomPlan& plan, int index, RoomFinder& finder, Net& out)
    : plan_(plan),
      net_(finder, index, out),
      impaired_(net_, plan.profile, plan.profile, static_cast<std::uint64_t>(plan.config.seed)),
      sink_(plan.lcm_url, plan.record, plan.force, plan.config.room),
      server_(plan_.scene, plan_.config, Through(plan.profile, net_, impaired_), sink_, entropy_),
      publisher_(sink_, plan.config.room, server_.room().session) {
  newest_.room = plan.config.room;
}

void HostedRoom::Run(std::int64_t now_us) {
  ran_us_ = now_us;
  if (done()) {
    DrainNetwork(now_us);
    return;
  }
  const std::int64_t tick = server_.tick(), due_us = server_.next_tick_us();
  const std::int64_t cpu_us = plan_.alone ? 0 : ThreadCpuUs();
  server_.Tick(now_us, CpuForStats(now_us));
  sink_.Poll();
  watch_.NoteCall(server_, now_us, SteadyClockUs() - now_us, tick, due_us);
  if (!plan_.alone) watch_.NoteCpu(ThreadCpuUs() - cpu_us);
  if (server_.tick() != tick) NoteTicks();
  CollectReports();
  if (watch_.Due(now_us)) Tell(now_us);
  EndIfDone(now_us);
}

/// Returns the CPU time for the Stats. These clocks cost as much as a datagram, so they are read
/// only when Stats are due.
std::int64_t HostedRoom::CpuForStats(std::int64_t now_us) const {
  if (!plan_.alone) return watch_.cpu_us();
  return server_.stats_due(now_us) ? CpuUs() : 0;
}

void HostedRoom::EndIfDone(std::int64_t now_us) {
  if (plan_.last_tick == 0 || server_.tick() < plan_.last_tick) return;
  Close(now_us);
  const std::lock_guard<std::mutex> lock(mutex_);
  done_ = true;
}

std::int64_t HostedRoom::due_us() const {
  if (done()) {
    return impaired_.sending() ? ran_us_ + kRunUs : std::numeric_limits<std::int64_t>::max();
  }
  return std::min({server_.next_tick_us(), impaired_.next_due_us(), ran_us_ + kRunUs});
}

void HostedRoom::NoteTicks() {
  const std::lock_guard<std::mutex> lock(mutex_);
  newest_.tick = watch_.tick_total();
  newest_.late = watch_.late_total();
}

void HostedRoom::Tell(std::int64_t now_us) {
  if (plan_.alone) watch_.NoteCpu(CpuUs() - watch_.cpu_us());
  const Load load = watch_.Tell(now_us, server_, net_.traffic());
  publisher_.Publish(load);
  const std::lock_guard<std::mutex> lock(mutex_);
  newest_.load = load;
  newest_.connections = server_.connections();
}

/// Prefixes each event with its time: "12.3 s: bob is gone: left".
void HostedRoom::CollectReports() {
  std::vector<std::string> told = server_.TakeWarnings();
  const std::vector<std::string> come_and_gone = server_.TakeReports();
  if (plan_.news && !come_and_gone.empty()) {
    char when[40] = "";
    if (server_.started()) {
      const auto tick = static_cast<double>(std::max<std::int64_t>(0, server_.tick()));
      std::snprintf(when, sizeof when, "%.1f s: ", tick / plan_.config.sync.tick_hz);
    }
    for (const std::string& news : come_and_gone) told.push_back(when + news);
  }
  if (!trouble_reported_ && !sink_.trouble().ok()) {
    trouble_reported_ = true;
    told.push_back(sink_.trouble().why() + "; the room runs on");
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
  if (!done()) server_.Shutdown(now_us, "the server stops");
  sink_.Poll();
  sink_.Flush();
}

bool HostedRoom::DrainNetwork(std::int64_t now_us) {
  impaired_.Advance(now_us);
  impaired_.Flush();
  return impaired_.sending();
}

}  // namespace seam
