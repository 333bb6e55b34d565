/// Client, incoming messages. The server is distrusted, too.

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "client/client.h"
#include "common/base/check.h"
#include "common/base/compress.h"
#include "common/base/nearest.h"
#include "common/scene/part_rules.h"
#include "common/sync/method.h"

namespace seam {

namespace {

/// True if a script has a callback for touches, or seems to.
bool AsksForTouches(const Scene& scene) {
  const auto& all = scene.scripts;
  return std::any_of(all.begin(), all.end(), [](const ScriptSource& script) {
    return script.code.find("on_touch") != std::string::npos;
  });
}

}  // namespace

void Client::ReceiveAll(std::int64_t now_us) {
  Address from;
  Bytes datagram;
  for (int n = 0; n < 1024 && net_.Receive(&from, &datagram); ++n) {
    stats_.bytes_in += static_cast<std::int64_t>(datagram.size());
    stats_.datagrams_in += 1;
    const bool ours = from == config_.server || (link_ != nullptr && from == at_) ||
                      (knocks_at_ && from == *knocks_at_);
    const bool good = ours && (OnHandshake(now_us, datagram) || OnSealed(now_us, datagram));
    if (!good) ++stats_.dropped_malformed;
  }
  stats_.dropped_malformed += net_.discarded() - discarded_;
  discarded_ = net_.discarded();
}

void Client::OnMessage(std::int64_t now_us, ByteView bytes) {
  const AnyMessage any = Decode(bytes);
  if (config_.tap != nullptr) config_.tap->OnMessage(any, bytes);
  if (const auto* redirect = std::get_if<Redirect>(&any)) {
    OnRedirect(*redirect);
  } else if (const auto* chunk = std::get_if<Chunk>(&any)) {
    OnChunk(now_us, *chunk);
  } else if (const auto* pong = std::get_if<Pong>(&any)) {
    OnPong(now_us, *pong);
  } else if (const auto* grants = std::get_if<Grants>(&any)) {
    OnGrants(now_us, *grants);
  } else if (const auto* exact = std::get_if<ExactStates>(&any)) {
    if (replica_ != nullptr && started_ && !released_) replica_->TakeOver(*exact);
  } else if (const auto* order = std::get_if<EditOrder>(&any)) {
    OnEdit(*order);
  } else if (const auto* snapshot = std::get_if<Snapshot>(&any)) {
    OnSnapshot(*snapshot);
  } else if (const auto* meta = std::get_if<Meta>(&any)) {
    metadata_.Apply(*meta);
    settings_.Take(*meta, player_, room_.tick_hz);
  } else if (const auto* event = std::get_if<Event>(&any)) {
    notice_ = event->text;
  } else if (const auto* states = std::get_if<States>(&any)) {
    OnStates(*states);
  } else if (const auto* packed = std::get_if<PackedStates>(&any)) {
    OnPacked(*packed);
  } else if (const auto* rest = std::get_if<Rest>(&any)) {
    if (started_) {
      replica_->Receive(*rest);
    } else {
      held_.Add(*rest);
    }
  } else if (const auto* inputs = std::get_if<PackedInputs>(&any)) {
    OnInputs(*inputs);
  } else if (const auto* differing = std::get_if<Differing>(&any)) {
    if (replica_ != nullptr) replica_->NoteDiffering(*differing);
  } else if (const auto* reset = std::get_if<Reset>(&any)) {
    if (packer_) packer_->Reset(static_cast<std::uint16_t>(reset->number));
  } else if (const auto* bye = std::get_if<Bye>(&any)) {
    if (moving_) return;  // the server that has sent us on ends
    if (asked_names_us_ >= 0) return GiveUpName(bye->reason);
    closed_ = true;
  } else {
    ++stats_.dropped_malformed;
  }
}

void Client::OnStates(const States& states) {
  if (config_.tap != nullptr) config_.tap->OnStates(states);
  if (started_) {
    replica_->NoteDivergences(states);
    stats_.dropped_stale += replica_->Receive(states).stale;
  } else {
    held_.Add(states);
  }
}

/// Unpacks states before the start, too: the server counts on those that have arrived.
void Client::OnPacked(const PackedStates& packed) {
  const std::vector<States>* all = nullptr;
  if (unpacker_) all = unpacker_->Take(packed);
  if (all == nullptr) {
    ++stats_.dropped_malformed;
    link_->SendUnreliable(Encode(StatesUnpacker::Refusal(packed)));
    return;
  }
  for (const States& states : *all) OnStates(states);
}

void Client::OnInputs(const PackedInputs& packed) {
  const std::optional<std::vector<Inputs>> all = UnpackInputs(packed);
  if (!all) {
    ++stats_.dropped_malformed;
    return;
  }
  if (scene_ == nullptr) return;
  for (const Inputs& inputs : *all) {
    const bool known = inputs.player != player_ &&
                       static_cast<std::size_t>(inputs.player) < scene_->players.size();
    if (known) replica_->RecordInputs(inputs);
  }
}

void Client::OnPong(std::int64_t now_us, const Pong& pong) {
  if (pong.client_us > now_us || pong.client_us < now_us - 10000000) return;
  answered_us_ = std::max(answered_us_, pong.client_us);
  clock_.AddSample(pong.client_us, pong.utime, now_us);
  timeline_.Add(pong);
  if (replica_ == nullptr || !started_) return;
  const RestCommit& rest = replica_->rest();
  rest_agrees_ = rest.Hash() == static_cast<std::uint64_t>(pong.rest);
  const RestBlock at{pong.rest_blocks, pong.rest_block};
  const auto theirs = static_cast<std::uint32_t>(pong.rest_own);
  const std::int64_t sent_us = link_->SentUntilUs(now_us);
  if (at.blocks == 0 || !rest_.Lost(now_us, sent_us, at, rest.HashOf(at, peer_), theirs)) return;
  for (Rest& own : rest.Again(at, peer_)) {
    own.utime = now_us;
    if (!released_) link_->SendReliable(Encode(own));
  }
}

/// Applies grants and confirms what we release: the server waits for that before it grants it to
/// others.
void Client::OnGrants(std::int64_t now_us, const Grants& grants) {
  // Where all simulate everything, authority means nothing.
  if (replica_ == nullptr || released_ || policy_->InputsOnly()) return;
  Release release;
  for (const int m : replica_->ApplyGrants(grants)) {
    release.mechanism.push_back(replica_->authority().id(m));
    release.epoch.push_back(replica_->authority().at(m).epoch);
  }
  if (release.mechanism.empty()) return;
  for (ExactStates& exact : replica_->TakeReleased()) {
    exact.utime = now_us;
    link_->SendUrgent(Encode(exact));
  }
  release.utime = now_us;
  release.tick = replica_->tick();
  link_->SendUrgent(Encode(release));
}

void Client::SendReleaseOfAll(std::int64_t now_us) {
  const AuthorityTable& table = replica_->authority();
  Release release;
  release.utime = now_us;
  release.tick = replica_->tick();
  for (int m = 0; m < table.count() && release.mechanism.size() < kReleasesMax; ++m) {
    if (table.at(m).authority != peer_) continue;
    release.mechanism.push_back(table.id(m));
    release.epoch.push_back(table.at(m).epoch);
  }
  // One message is enough: on it the server takes everything back.
  if (!release.mechanism.empty()) link_->SendUrgent(Encode(release));
}

void Client::OnEdit(const EditOrder& order) {
  if (replica_ == nullptr) return;
  if (order.number >= 0) {
    if (!released_ && !replica_->Queue(order)) ++stats_.dropped_stale;
    return;
  }
  // Our composition differed from the room's: start again from the scene; the rest follows.
  MakeReplica();
}

void Client::OnSnapshot(const Snapshot& part) {
  if (replica_ == nullptr || released_) return;
  if (snapshot_ == nullptr || part.part == 0) snapshot_ = std::make_unique<SnapshotReader>(*scene_);
  const Status status = snapshot_->Take(part);
  if (!status.ok()) {
    fatal_ = "cannot use the server's world: " + status.why();
    return;
  }
  if (!snapshot_->complete()) return;
  MakeReplica(&snapshot_->topology());
  snapshot_.reset();
}

void Client::MakeReplica(const Topology* become) {
  edits_wait_revision_ = -1;
  SyncConfig sync = MakeSyncConfig(MethodNames{room_.mode, room_.reconcile, room_.predict});
  policy_ = sync.policy;
  sync.tick_hz = room_.tick_hz;
  sync.send_hz = room_.send_hz;
  sync.smooth_rate = config_.smooth_rate;
  sync.show_age_ticks = config_.show_age_ticks.value_or(scene_->show_age_ticks);
  sync.seed = room_.seed;
  sync.input_delay_ticks = room_.input_delay_ticks;
  const Topology topology = become != nullptr ? *become : Topology(*scene_);
  const auto& assemblies = topology.composition().assemblies;
  const auto bodies = std::count_if(assemblies.begin(), assemblies.end(),
                                    [](const Assembly& a) { return !a.anchored; });
  sync.shows_far = config_.shows || Published(static_cast<int>(bodies)) == Publish::kAll;
  const std::unique_ptr<Replica> before = std::move(replica_);
  replica_ = std::make_unique<Replica>(topology, sync, peer_, player_);
  replica_->OnCorrected([this](int, const BodyState&) { ++corrections_; });
  if (recorder_.listening()) replica_->WatchDivergences();
  if (!policy_->IsOracle() && AsksForTouches(*scene_)) replica_->WatchTouches();
  if (before == nullptr) return;
  // Keep all known inputs: our own of the next ticks may have been sent, and others do not repeat
  // the inputs that we acknowledged.
  for (int p = 0; p < static_cast<int>(scene_->players.size()); ++p) {
    replica_->RecordInputs(before->inputs(p).Export(p, InputTrack::kKeepTicks));
  }
  if (!started_) return;
  replica_->StartAt(before->tick());
  replica_->GoOnFrom(before->world());  // so that the start of the scene is not displayed
}

void Client::OnChunk(std::int64_t now_us, const Chunk& chunk) {
  if (scene_ != nullptr) return OnWorldPiece(chunk);
  if (room_size_ == 0) return;
  if (static_cast<std::size_t>(chunk.offset_bytes) != room_bytes_.size() ||
      room_bytes_.size() + chunk.data.size() > room_size_) {
    fatal_ = "the server's room does not fit its welcome";
    return;
  }
  room_bytes_.insert(room_bytes_.end(), chunk.data.begin(), chunk.data.end());
  received_us_ = now_us;
  if (room_bytes_.size() == room_size_) Build(now_us);
}

void Client::Build(std::int64_t now_us) {
  const std::optional<Bytes> bytes = Decompress(std::exchange(room_bytes_, {}), kRoomBytesMax);
  AnyMessage any = bytes ? Decode(*bytes) : AnyMessage();
  Room* const room = std::get_if<Room>(&any);
  if (room == nullptr) {
    fatal_ = "the server's room does not decode";
    return;
  }
  room_ = std::move(*room);
  loaded_now_ = true;
  try {
    SceneCache own;
    SceneCache& scenes = config_.scenes != nullptr ? *config_.scenes : own;
    scene_ = scenes.Of(room_.scene_text, room_.scene_name + ".toml");
    const Scene& scene = *scene_;
    const PackedMotion motion(scene.gravity.x(), scene.gravity.y(), scene.solver.tick_hz);
    unpacker_.emplace(motion);
    packer_.emplace(motion);
    if (scene.solver.tick_hz != room_.tick_hz) {
      throw OperatorError("its tick rate is not its scene's");
    }
    if (config_.drive == Drive::kScript) {
      std::vector<std::string> names;
      for (const Player& p : scene_->players) names.push_back(p.name);
      if (std::count(names.begin(), names.end(), config_.script_of) == 0) {
        names.insert(names.end(), {"none", "bot", "keyboard"});  // of --drive, too
        throw OperatorError("it has no player \"" + config_.script_of + "\" to script" +
                            DidYouMean(config_.script_of, names));
      }
    }
    if (player_ < 0 && !config_.watch) return AskNames(now_us);
    MakeReplica();
  } catch (const OperatorError& e) {
    fatal_ = "cannot use the server's scene: " + std::string(e.what());
    return;
  }
  if (config_.tap != nullptr) config_.tap->OnRoom();
  if (publisher_ != nullptr && publisher_->session() == room_.session) return;
  publisher_ = std::make_unique<Publisher>(recorder_, room_.room, room_.session);
}

}  // namespace seam
