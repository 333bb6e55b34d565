#include "client/swarm/swarm.h"

#include <sys/resource.h>

#include <algorithm>
#include <utility>

#include "common/base/check.h"
#include "common/base/process.h"
#include "common/physics/prepare_threads.h"
#include "common/scene/scene.h"

namespace seam {
namespace {

/// Period of counting moving bodies by authority, us. Each time a part of the clients is counted:
/// counting all would make many late.
constexpr std::int64_t kSampleUs = 500000;
constexpr std::size_t kSampleParts = 10;

/// Raises the limit of open files to the system's maximum: each client has a socket.
void RaiseFileLimit() {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max;
  (void)setrlimit(RLIMIT_NOFILE, &limit);
}

}  // namespace

struct Swarm::Lane {
  Group group;
  std::thread thread;
  std::atomic<int> running{0};
  // Used by the thread alone, until it has ended.
  bool measuring = false;
  std::int64_t sample_us = 0, samples = 0;
  std::size_t part = 0;                                             // of the current sample
  MovingBodies sample, moving;                                      // so far; sum of the samples
  std::vector<std::pair<std::int64_t, std::int64_t>> bytes_before;  // in, out, by member
};

Swarm::Swarm(const SwarmConfig& config) : config_(config) {
  RaiseFileLimit();
  const std::size_t rooms = config.rooms.size();
  for (int t = 0; t < std::min(config.threads, config.clients); ++t) {
    lanes_.push_back(std::make_unique<Lane>());
  }
  for (std::size_t r = 0; r < rooms && static_cast<int>(r) < config.clients && g_stop == 0; ++r) {
    const Room room = AskForRoom(config.server, config.rooms[r]);
    if (r == 0) room_ = room;
    const Scene scene = ParseScene(room.scene_text, room.scene_name + ".toml");
    for (std::size_t i = r; i < static_cast<std::size_t>(config.clients); i += rooms) {
      if (i / rooms >= scene.players.size()) {
        const std::size_t wanted = (static_cast<std::size_t>(config.clients) - r - 1) / rooms + 1;
        throw OperatorError("--clients " + std::to_string(config.clients) + ": room " + room.room +
                            " would get " + std::to_string(wanted) + ", but its scene " +
                            room.scene_name + " has " + std::to_string(scene.players.size()) +
                            " player(s)");
      }
      ClientConfig member;
      member.server = config.server;
      member.name = scene.players[i / rooms].name;
      member.room = config.rooms[r];
      member.drive = config.drive;
      member.script_of = member.name;
      member.publish = Publish::kNone;
      member.smooth_rate = 0;
      lanes_[i % lanes_.size()]->group.Add(member, i == r);
    }
  }
}

Swarm::~Swarm() {
  stop_ = true;
  for (const auto& lane : lanes_) {
    if (lane->thread.joinable()) lane->thread.join();
  }
}

void Swarm::Start() {
  PrepareForThreads();
  for (const auto& lane : lanes_) {
    lane->thread = std::thread([this, &lane] { Run(lane.get()); });
  }
}

void Swarm::Run(Lane* lane) {
  while (!stop_) {
    lane->group.Run(SteadyClockUs() + 50000);
    Look(lane);
  }
}

void Swarm::Look(Lane* lane) {
  lane->running = lane->group.running();
  if (lane->group.Closed()) closed_ = true;
  const std::string fatal = lane->group.Fatal();
  if (!fatal.empty()) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (fatal_.empty()) fatal_ = fatal;
  }
  if (!measure_) return;
  if (!lane->measuring) {
    lane->measuring = true;
    lane->group.Forget();
    for (const auto& member : lane->group.members()) {
      const Stats& stats = member->client().stats();
      lane->bytes_before.emplace_back(stats.bytes_in, stats.bytes_out);
    }
  }
  const std::int64_t now_us = SteadyClockUs();
  if (now_us < lane->sample_us) return;
  const std::size_t parts = lane->samples == 0 ? 1 : kSampleParts;  // the first at once
  lane->sample_us = now_us + kSampleUs / static_cast<std::int64_t>(kSampleParts);
  lane->sample.Add(lane->group.Moving(lane->part, parts));
  lane->part = (lane->part + 1) % parts;
  if (lane->part != 0) return;
  lane->moving.Add(std::exchange(lane->sample, {}));
  ++lane->samples;
}

int Swarm::running() const {
  int sum = 0;
  for (const auto& lane : lanes_) sum += lane->running;
  return sum;
}

std::string Swarm::Fatal() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return fatal_;
}

void Swarm::BeginToMeasure(std::int64_t now_us) {
  measured_since_us_ = now_us;
  cpu_before_us_ = CpuUs();
  measure_ = true;
}

void Swarm::Finish(std::int64_t now_us) {
  if (measure_) {
    measured_s_ = static_cast<double>(now_us - measured_since_us_) * 1e-6;
    cpu_s_ = static_cast<double>(CpuUs() - cpu_before_us_) * 1e-6;
  }
  stop_ = true;
  for (const auto& lane : lanes_) {
    if (lane->thread.joinable()) lane->thread.join();
    lane->group.Leave(SteadyClockUs());
  }
}

MemberFigures Swarm::Figures() const {
  MemberFigures all;
  for (const auto& lane : lanes_) {
    if (lane->measuring) all.Add(lane->group.Figures());
  }
  return all;
}

MovingBodies Swarm::Moving() const {
  MovingBodies all;
  for (const auto& lane : lanes_) {
    const auto samples = static_cast<double>(std::max<std::int64_t>(1, lane->samples));
    all.held += lane->moving.held / samples;
    all.server += lane->moving.server / samples;
  }
  return all;
}

Swarm::Traffic Swarm::TrafficOfAll() const {
  Traffic sum;
  double members = 0;
  for (const auto& lane : lanes_) {
    for (std::size_t i = 0; i < lane->bytes_before.size(); ++i) {
      const Client& client = lane->group.members()[i]->client();
      const Stats& stats = client.stats();
      sum.bytes_in += static_cast<double>(stats.bytes_in - lane->bytes_before[i].first);
      sum.bytes_out += static_cast<double>(stats.bytes_out - lane->bytes_before[i].second);
      const double loss = stats.loss_ppm * 1e-6, rtt_s = std::max(0, stats.rtt_us) * 1e-6;
      sum.loss_mean += loss;
      sum.rtt_mean_s += rtt_s;
      sum.loss_worst = std::max(sum.loss_worst, loss);
      sum.rtt_worst_s = std::max(sum.rtt_worst_s, rtt_s);
      const double load = std::max<int>(0, client.load_permille()) * 1e-3;
      sum.load_mean += load;
      sum.load_worst = std::max(sum.load_worst, load);
      sum.rejoins += client.rejoins();
      ++members;
    }
  }
  sum.loss_mean /= std::max(1.0, members);
  sum.rtt_mean_s /= std::max(1.0, members);
  sum.load_mean /= std::max(1.0, members);
  return sum;
}

}  // namespace seam
