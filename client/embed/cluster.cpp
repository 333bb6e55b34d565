#include "client/embed/cluster.h"

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <utility>

#include "common/base/check.h"
#include "common/sync/method.h"

namespace seam {
namespace {

/// Virtual time advances in steps of at most this and at least kStepMinUs.
constexpr std::int64_t kStepMaxUs = 5000;
constexpr std::int64_t kStepMinUs = 200;
/// Without a tick for so long, nobody plays.
constexpr std::int64_t kStandstillUs = 30000000;

/// CPU time of this thread, us.
double CpuNowUs() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) * 1e6 + static_cast<double>(t.tv_nsec) * 1e-3;
}

/// Returns a seed of the server's random numbers, the session's among them: equal configurations
/// give the same, so that a run repeats, and different ones give different sessions.
std::uint64_t ServerSeed(const ClusterConfig& config, const Scene& scene) {
  const std::string text = fmt::format(
      "{}\n{}\n{}\n{}\n{}\n{} {} {} {} {} {} {} {} {}", scene.text, config.mode, config.reconcile,
      config.predict, config.impair, config.seed, config.duration_s, config.spectators,
      static_cast<int>(config.drive), static_cast<int>(config.publish), config.players,
      config.send_hz, config.smooth_rate, config.client_bytes_per_s);
  return Fnv1a(text.data(), text.size());
}

}  // namespace

void Cluster::Tap::Publish(const std::string& channel, std::int64_t, ByteView message) {
  if (cluster_.config_.keep) memory.Publish(channel, cluster_.now_us_, message);
  if (cluster_.config_.recorder != nullptr) {
    cluster_.config_.recorder->Publish(channel, cluster_.now_us_, message);
  }
}

void Cluster::Tap::EndTick(const std::string& channel, const LogSeal& seal, bool kept) {
  LogSeal now = seal;
  now.utime = cluster_.now_us_;
  if (cluster_.config_.keep) memory.EndTick(channel, now, kept);
  if (cluster_.config_.recorder != nullptr) cluster_.config_.recorder->EndTick(channel, now, kept);
}

Cluster::Cluster(const ClusterConfig& config)
    : Cluster(config, config.scene_text.empty() ? LoadScene("scenes/" + config.scene + ".toml")
                                                : ParseScene(config.scene_text, config.scene)) {}

Cluster::Cluster(const ClusterConfig& config, const Scene& scene) : config_(config), scene_(scene) {
  const ImpairProfile profile = FindProfile(config.impair);
  server_endpoint_ = network_.Attach(server_address_);
  server_net_ = std::make_unique<ImpairedNet>(*server_endpoint_, profile, profile,
                                              static_cast<std::uint64_t>(config.seed));
  ServerConfig server;
  server.sync = MakeSyncConfig(MethodNames{config.mode, config.reconcile, config.predict});
  server.sync.input_delay_ticks = server.sync.policy->InputDelay(scene_.input_delay_ticks);
  server.sync.tick_hz = scene_.solver.tick_hz;
  server.sync.send_hz = std::min(config.send_hz, scene_.solver.tick_hz);
  server.sync.seed = config.seed;
  server.sync.smooth_rate = config.smooth_rate;
  server.impair = config.impair;
  server.publish = config.publish;
  server.trust = config.trust;
  server.client_bytes_per_s = config.client_bytes_per_s;
  server.seed = config.seed;
  std::size_t players = scene_.players.size();
  if (config.players > 0) players = std::min(players, static_cast<std::size_t>(config.players));
  server.wait_players = static_cast<int>(players);
  server_entropy_ = std::make_unique<SeededEntropy>(ServerSeed(config, scene_));
  server_ = std::make_unique<Server>(scene_, server, *server_net_, recorder_, *server_entropy_);
  server_config_ = server;
  clients_.resize(players + static_cast<std::size_t>(config.spectators));
  for (std::size_t i = 0; i < clients_.size(); ++i) StartClient(i);
}

Cluster::~Cluster() = default;

void Cluster::RestartServer(const SavedRoom& saved, const LogTail& tail, std::int64_t down_us) {
  server_config_.identity = server_->keys();
  server_config_.wait_players = 0;
  server_.reset();
  server_net_.reset();
  server_endpoint_.reset();
  ++server_restarts_;
  server_endpoint_ = network_.Attach(server_address_);
  const ImpairProfile profile = FindProfile(config_.impair);
  const auto seed = static_cast<std::uint64_t>(config_.seed) + 1000003 * server_restarts_;
  server_net_ = std::make_unique<ImpairedNet>(*server_endpoint_, profile, profile, seed);
  server_entropy_ = std::make_unique<SeededEntropy>(ServerSeed(config_, scene_) + server_restarts_);
  server_ =
      std::make_unique<Server>(saved, server_config_, *server_net_, recorder_, *server_entropy_);
  const Status status = server_->Resume(saved, now_us_ + down_us, &tail);
  if (!status.ok()) throw OperatorError(status.why());
  server_busy_until_us_ = now_us_ + down_us;
}

void Cluster::StartClient(std::size_t i) {
  Peer& peer = clients_[i];
  peer.client.reset();
  peer.endpoint = network_.Attach(Address{0x7f000001, next_port_++});
  if (config_.client_net) peer.endpoint = config_.client_net(i, std::move(peer.endpoint));
  // Every machine's clock is off by something else.
  peer.clock_offset_us = 12345678 + 3777777 * static_cast<std::int64_t>(next_port_ - 20000);
  ClientConfig config;
  config.server = server_address_;
  const std::size_t players = clients_.size() - static_cast<std::size_t>(config_.spectators);
  config.watch = i >= players;
  config.name = config.watch ? "guest" + std::to_string(i - players) : scene_.players[i].name;
  config.drive = config.watch ? Drive::kNone : config_.drive;
  config.publish = config_.publish;
  config.shows = config_.shows;
  config.script_of = config.name;
  config.key = peer.key;
  config.smooth_rate = config_.smooth_rate;
  config.show_age_ticks = config_.show_age_ticks;
  peer.entropy =
      std::make_unique<SeededEntropy>(static_cast<std::uint64_t>(config_.seed) * 1000 + next_port_);
  peer.client = std::make_unique<Client>(config, *peer.endpoint, recorder_, *peer.entropy);
}

void Cluster::Instant() {
  std::int64_t next = now_us_ + kStepMaxUs;
  next = std::min(
      {next, std::max(server_busy_until_us_, server_->wake_us()), server_net_->next_due_us()});
  for (Peer& peer : clients_) {
    if (peer.client == nullptr || peer.paused) continue;
    const std::int64_t local = now_us_ + peer.clock_offset_us;
    const std::int64_t due = peer.client->next_tick_us(local) - peer.clock_offset_us;
    next = std::min(next, std::max(due, peer.busy_until_us));
  }
  now_us_ = std::max(next, now_us_ + kStepMinUs);
  RunServer();
  const double between_us = CpuNowUs();
  for (Peer& peer : clients_) {
    if (peer.client == nullptr || peer.paused) continue;
    TickClient(static_cast<std::size_t>(&peer - clients_.data()));
  }
  client_cpu_us_ += CpuNowUs() - between_us;
  if (each_instant) each_instant();
}

void Cluster::TickClient(std::size_t i) {
  Peer& peer = clients_[i];
  if (now_us_ < peer.busy_until_us) return;
  const std::int64_t before = peer.client->running() ? peer.client->replica()->tick() : -1;
  peer.client->Tick(now_us_ + peer.clock_offset_us, static_cast<std::int64_t>(peer.cpu_us));
  if (config_.client_body_us <= 0 || !peer.client->running()) return;
  const Replica& replica = *peer.client->replica();
  const std::int64_t replayed = replica.ticks_stepped_again();
  std::int64_t steps = before < 0 ? 0 : replica.tick() - before;
  steps += std::max<std::int64_t>(0, replayed - peer.replayed);  // it begins anew with a replica
  peer.replayed = replayed;
  const double slower = i < config_.client_throttle.size() ? config_.client_throttle[i] : 1;
  const double cost_us =
      static_cast<double>(steps * SteppedBodies(replica.world())) * config_.client_body_us * slower;
  peer.cpu_us += std::max(cost_us, 1.0);
  peer.busy_until_us = now_us_ + static_cast<std::int64_t>(cost_us);
}

int SteppedBodies(const World& world) {
  int stepped = 0;
  for (int body = 0; body < world.body_count(); ++body) {
    stepped += IsPresent(world.activity(body)) ? 1 : 0;
  }
  return stepped;
}

void Cluster::RunServer() {
  if (now_us_ < server_busy_until_us_) return;
  const std::int64_t before = server_->tick();
  const double begin_us = CpuNowUs();
  server_->Tick(now_us_, 0);
  server_cpu_us_ += CpuNowUs() - begin_us;
  if (!config_.server_tick_us) return;
  server_busy_until_us_ = now_us_;
  for (std::int64_t tick = before; tick < server_->tick(); ++tick) {
    server_busy_until_us_ += config_.server_tick_us(tick + 1);
  }
}

std::int64_t Cluster::ticks_stepped_again() { return Sum(&Replica::ticks_stepped_again); }
std::int64_t Cluster::replays_deferred() { return Sum(&Replica::replays_deferred); }

std::int64_t Cluster::Sum(std::int64_t (Replica::*count)() const) {
  std::int64_t sum = server_->started() ? (server_->replica().*count)() : 0;
  for (const Peer& peer : clients_) {
    if (peer.client == nullptr || peer.client->replica() == nullptr) continue;
    sum += (peer.client->replica()->*count)();
  }
  return sum;
}

void Cluster::RunToTick(std::int64_t tick) {
  std::int64_t last_progress_us = now_us_;
  std::int64_t last_tick = server_->tick();
  double last_share = 0;
  while (server_->tick() < tick) {
    Instant();
    double share = 0;  // of the room, that the clients have
    for (const Peer& peer : clients_) share += peer.client ? peer.client->room_share() : 0;
    if (server_->tick() != last_tick || share > last_share) last_progress_us = now_us_;
    last_tick = server_->tick();
    last_share = share;
    if (now_us_ - last_progress_us > kStandstillUs) {
      throw OperatorError(scene_.name + ": no tick within 30 s of virtual time: can its players " +
                          "join over the network \"" + config_.impair + "\"?");
    }
  }
}

void Cluster::Run() {
  const double seconds = config_.duration_s > 0 ? config_.duration_s : scene_.duration_s;
  RunToTick(static_cast<std::int64_t>(seconds * scene_.solver.tick_hz));
}

const Recording& Cluster::recording() {
  server_->PublishUnmoved();
  for (const Peer& peer : clients_) {
    if (peer.client != nullptr) peer.client->PublishUnmoved();
  }
  return recorder_.memory.builder.recording();
}

void Cluster::Kill(int client) {
  Peer& peer = clients_[static_cast<std::size_t>(client)];
  if (peer.client != nullptr) peer.key = peer.client->key();
  peer.client.reset();
}

void Cluster::Leave(int client) {
  Peer& peer = clients_[static_cast<std::size_t>(client)];
  if (peer.client != nullptr) peer.client->Shutdown(now_us_ + peer.clock_offset_us);
  Kill(client);
}

void Cluster::Revive(int client) { StartClient(static_cast<std::size_t>(client)); }

Recording RunCluster(const ClusterConfig& config) {
  Cluster cluster(config);
  cluster.Run();
  return cluster.recording();
}

}  // namespace seam
