#include "client/embed/local_session.h"

#include <algorithm>
#include <utility>

#include "common/base/check.h"
#include "common/sync/method.h"

namespace seam {
namespace {

/// Virtual time advances by at most and at least so much, us.
constexpr std::int64_t kInstantMaxUs = 5000, kInstantMinUs = 200;
/// Without a tick for so long, nobody plays, us.
constexpr std::int64_t kNobodyPlaysUs = 30000000;
/// Largest seed, as of seam-server.
constexpr std::int64_t kSessionSeedMax = 1000000000;
constexpr Address kServerPlace{0x7f000001, 7777};
constexpr std::uint16_t kFirstClientPort = 20000;

Drive DriveOf(const std::string& name) {
  if (name == "inputs") return Drive::kLive;
  if (name == "script") return Drive::kScript;
  if (name == "bot") return Drive::kBot;
  throw OperatorError("no drive \"" + name + "\"; there are inputs, script and bot");
}

/// Returns a seed of the server's random numbers: equal settings give equal sessions.
std::uint64_t EntropyOf(const Scene& scene, const LocalSessionConfig& config) {
  std::uint64_t seed = Fnv1a(scene.text.data(), scene.text.size());
  for (const std::string& name :
       {config.mode, config.reconcile, config.predict, config.impair, config.drive}) {
    seed = Fnv1a(name.c_str(), name.size() + 1, seed);
  }
  seed = Fnv1a(&config.send_hz, sizeof config.send_hz, seed);
  return Fnv1a(&config.seed, sizeof config.seed, seed);
}

void RequireWithin(const char* name, std::int64_t value, std::int64_t least, std::int64_t most) {
  if (value >= least && value <= most) return;
  throw OperatorError(std::string(name) + " is " + std::to_string(value) + ", not from " +
                      std::to_string(least) + " to " + std::to_string(most));
}

}  // namespace

bool LocalSession::Tap::listening() const { return session_.config_.keep || log != nullptr; }

void LocalSession::Tap::Publish(const std::string& channel, std::int64_t, ByteView message) {
  if (session_.config_.keep) memory.Publish(channel, session_.now_us_, message);
  if (log != nullptr) log->Publish(channel, session_.now_us_, message);
}

void LocalSession::Tap::EndTick(const std::string& channel, const LogSeal& seal, bool kept) {
  LogSeal now = seal;
  now.utime = session_.now_us_;
  if (session_.config_.keep) memory.EndTick(channel, now, kept);
  if (log != nullptr) log->EndTick(channel, now, kept);
}

LocalSession::LocalSession(const Scene& scene, const LocalSessionConfig& config)
    : scene_(scene), config_(config) {
  RequireWithin("seed", config.seed, 0, kSessionSeedMax);
  RequireWithin("send_hz", config.send_hz, 1, kSendHzMax);
  const Drive drive = DriveOf(config.drive);
  ServerConfig server;
  server.sync = MakeSyncConfig(MethodNames{config.mode, config.reconcile, config.predict});
  server.sync.input_delay_ticks = scene.input_delay_ticks;
  server.sync.tick_hz = scene.solver.tick_hz;
  server.sync.send_hz = std::min(config.send_hz, scene.solver.tick_hz);
  server.sync.seed = config.seed;
  server.impair = config.impair;
  server.publish = Publish::kAll;
  server.seed = config.seed;
  server.wait_players = static_cast<int>(scene.players.size());
  const ImpairProfile profile = FindProfile(config.impair);
  endpoint_ = network_.Attach(kServerPlace);
  impaired_ = std::make_unique<ImpairedNet>(*endpoint_, profile, profile,
                                            static_cast<std::uint64_t>(config.seed));
  if (!config.record.empty()) {
    tap_.log = std::make_unique<RoomLog>(config.record, config.force, nullptr);
  }
  entropy_ = std::make_unique<SeededEntropy>(EntropyOf(scene, config));
  server_ = std::make_unique<Server>(scene_, server, *impaired_, tap_, *entropy_);
  for (std::size_t i = 0; i < scene_.players.size(); ++i) StartClient(drive);
}

LocalSession::~LocalSession() = default;

void LocalSession::StartClient(Drive drive) {
  const auto i = static_cast<std::int64_t>(peers_.size());
  Peer& peer = peers_.emplace_back();
  const auto port = static_cast<std::uint16_t>(kFirstClientPort + i);
  peer.endpoint = network_.Attach(Address{kServerPlace.ip, port});
  peer.clock_offset_us = 12345678 + 3777777 * i;  // every machine's clock is off by something else
  ClientConfig client;
  client.server = kServerPlace;
  client.name = scene_.players[static_cast<std::size_t>(i)].name;
  client.drive = drive;
  client.script_of = client.name;
  client.publish = Publish::kAll;
  client.shows = true;
  peer.entropy = std::make_unique<SeededEntropy>(static_cast<std::uint64_t>(config_.seed) * 1000 +
                                                 static_cast<std::uint64_t>(i));
  peer.client = std::make_unique<Client>(client, *peer.endpoint, tap_, *peer.entropy);
}

void LocalSession::Instant() {
  std::int64_t next =
      std::min({now_us_ + kInstantMaxUs, server_->next_tick_us(), impaired_->next_due_us()});
  for (const Peer& peer : peers_) {
    const std::int64_t local = now_us_ + peer.clock_offset_us;
    next = std::min(next, peer.client->next_tick_us(local) - peer.clock_offset_us);
  }
  now_us_ = std::max(next, now_us_ + kInstantMinUs);
  server_->Tick(now_us_, 0);
  for (const Peer& peer : peers_) {
    peer.client->Tick(now_us_ + peer.clock_offset_us, 0);
    if (peer.client->fatal().empty()) continue;
    throw OperatorError(peer.client->name() + ": " + peer.client->fatal());
  }
}

void LocalSession::RunToTick(std::int64_t tick) {
  std::int64_t progress_us = now_us_, last = server_->tick();
  double had = 0;
  while (server_->tick() < tick) {
    Instant();
    double share = 0;  // of the room, that the clients have
    for (const Peer& peer : peers_) share += peer.client->room_share();
    if (server_->tick() != last || share > had) progress_us = now_us_;
    last = server_->tick();
    had = share;
    if (now_us_ - progress_us <= kNobodyPlaysUs) continue;
    throw OperatorError(scene_.name + ": no tick within 30 s of virtual time: can its players " +
                        "join over the network \"" + config_.impair + "\"?");
  }
  if (tap_.log != nullptr && !tap_.log->trouble().ok()) {
    throw OperatorError(tap_.log->trouble().why());
  }
}

void LocalSession::SetInput(int player, const Input& input) {
  if (DriveOf(config_.drive) != Drive::kLive) {
    throw OperatorError("this session is driven by \"" + config_.drive + "\", not by inputs");
  }
  if (player < 0 || player >= client_count()) {
    throw OperatorError("there is no player " + std::to_string(player) + ": the scene has " +
                        std::to_string(client_count()));
  }
  peers_[static_cast<std::size_t>(player)].client->SetLiveInput(input);
}

View LocalSession::ViewOf(int peer) const {
  if (peer < 0 || peer > client_count()) {
    throw OperatorError("there is no peer " + std::to_string(peer) + ": 0 is the server, clients " +
                        "are 1 to " + std::to_string(client_count()));
  }
  if (peer == 0) return server_->replica().MakeView();
  const Client& from = client(peer - 1);
  return from.running() ? from.replica()->MakeView() : View();
}

void LocalSession::Flush() {
  if (tap_.log == nullptr) return;
  tap_.log->Flush();
  if (!tap_.log->trouble().ok()) throw OperatorError(tap_.log->trouble().why());
}

}  // namespace seam
