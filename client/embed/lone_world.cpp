#include "client/embed/lone_world.h"

#include <cmath>
#include <cstring>
#include <utility>

#include "common/base/check.h"
#include "common/base/state_archive.h"
#include "common/scene/saved/persist_state.h"
#include "common/sync/edits/edit_order.h"

namespace seam {
namespace {

/// The bytes begin with this, the version, a hash of the scene's text and one of all that follows.
constexpr char kWorldMagic[8] = {'S', 'E', 'A', 'M', 'W', 'R', 'L', 'D'};
/// Raised with every change of the bytes.
constexpr std::uint32_t kWorldStateVersion = 1;
struct WorldHeader {
  char magic[8];
  std::uint32_t version;
  std::uint32_t unused;
  std::uint64_t scene;
  std::uint64_t hash;
};

std::uint64_t HashOf(const Scene& scene) { return Fnv1a(scene.text.data(), scene.text.size()); }

bool Within(double value, double most) { return std::abs(value) <= most; }  // false for NaN

}  // namespace

LoneWorld::LoneWorld(const Scene& scene) : scene_(scene) { Reset(); }
LoneWorld::~LoneWorld() = default;

void LoneWorld::Reset() {
  Become(std::make_unique<World>(scene_), {}, std::vector<Input>(scene_.players.size()));
}

void LoneWorld::Become(std::unique_ptr<World> world, std::vector<Edit> edits,
                       std::vector<Input> inputs) {
  world_ = std::move(world);
  edits_ = std::move(edits);
  inputs_ = std::move(inputs);
  held_.clear();
  for (const Input& input : inputs_) held_.push_back(input.buttons);
}

Status LoneWorld::SetInput(int player, const Input& input) {
  if (player < 0 || player >= player_count()) {
    return Status::Error("there is no player " + std::to_string(player) + ": the scene has " +
                         std::to_string(player_count()));
  }
  inputs_[static_cast<std::size_t>(player)] = input;
  return Status::Ok();
}

Status LoneWorld::Write(PartId id, const BodyState& state) {
  const int body = world_->BodyOfId(id);
  if (body < 0) return Status::Error("there is no moving body with the id " + std::to_string(id));
  const bool good =
      Within(state.position.x(), kSavedPlaceMost) && Within(state.position.y(), kSavedPlaceMost) &&
      Within(state.angle, kSavedAngleMost) && Within(state.velocity.x(), kSavedSpeedMost) &&
      Within(state.velocity.y(), kSavedSpeedMost) && Within(state.spin, kSavedSpeedMost);
  if (!good) return Status::Error("a pose or velocity is not finite, or far beyond any scene's");
  world_->Write(body, state);
  return Status::Ok();
}

void LoneWorld::Step(int ticks) {
  for (int i = 0; i < ticks; ++i) StepOnce();
}

void LoneWorld::StepOnce() {
  for (int player = 0; player < player_count(); ++player) {
    const auto p = static_cast<std::size_t>(player);
    world_->SetInput(player, inputs_[p]);
    const int pressed = inputs_[p].buttons & ~held_[p];
    held_[p] = inputs_[p].buttons;
    const auto& actions = scene_.players[p].actions;
    for (std::size_t a = 0; a < actions.size(); ++a) {
      if ((pressed >> actions[a].button) & 1) world_->Act(player, static_cast<int>(a));
    }
  }
  world_->Step();
  for (const Edit& edit : world_->ProposeEdits()) {  // one by one, as every peer does
    edits_.push_back(edit);
    world_->Apply({edit});
  }
}

Bytes LoneWorld::Save() {
  WorldSnapshot snapshot = world_->Barrier();
  StateArchive a;
  a.Section("edits");
  a.List(&edits_, StateArchive::kListMost, [&](Edit* edit) { Persist(a, edit); });
  a.Section("inputs");
  a.Exactly(&inputs_, [&](Input* input) { Persist(a, input); });
  std::vector<int> held = held_;
  a.Exactly(&held, [&](int* buttons) { a.Int(buttons, -32768, 32767); });
  Persist(a, &snapshot);
  const Bytes rest = a.Take();
  WorldHeader header{};
  std::memcpy(header.magic, kWorldMagic, sizeof kWorldMagic);
  header.version = kWorldStateVersion;
  header.scene = HashOf(scene_);
  header.hash = Fnv1a(rest.data(), rest.size());
  Bytes all(sizeof header + rest.size());
  std::memcpy(all.data(), &header, sizeof header);
  std::memcpy(all.data() + sizeof header, rest.data(), rest.size());
  return all;
}

Status LoneWorld::Load(ByteView bytes) {
  const auto fail = [](const std::string& why) {
    return Status::Error("this is no saved world of the scene: " + why);
  };
  WorldHeader header{};
  if (bytes.size < sizeof header) return fail("it is too short");
  std::memcpy(&header, bytes.data, sizeof header);
  if (std::memcmp(header.magic, kWorldMagic, sizeof kWorldMagic) != 0) {
    return fail("it begins otherwise");
  }
  if (header.version != kWorldStateVersion) {
    return fail("it is of version " + std::to_string(header.version));
  }
  if (header.scene != HashOf(scene_)) return fail("it is of another scene");
  const ByteView rest(bytes.data + sizeof header, bytes.size - sizeof header);
  if (header.unused != 0 || header.hash != Fnv1a(rest.data, rest.size))
    return fail("it is damaged");
  StateArchive a(rest);
  a.Section("edits");
  std::vector<Edit> edits;
  a.List(&edits, StateArchive::kListMost, [&](Edit* edit) { Persist(a, edit); });
  a.Section("inputs");
  std::vector<Input> inputs(inputs_.size());
  a.Exactly(&inputs, [&](Input* input) { Persist(a, input); });
  std::vector<int> held(inputs_.size());
  a.Exactly(&held, [&](int* buttons) { a.Int(buttons, -32768, 32767); });
  WorldSnapshot snapshot;
  Persist(a, &snapshot);
  if (a.ok() && a.left() > 0) a.Fail("there is more than the world");
  if (!a.ok()) return fail(a.status().why());
  Topology topology(scene_);
  topology.Apply(edits);
  auto world = std::make_unique<World>(topology);
  const Status loaded = world->Load(snapshot);
  if (!loaded.ok()) return fail(loaded.why());
  Become(std::move(world), std::move(edits), std::move(inputs));
  held_ = std::move(held);
  return Status::Ok();
}

}  // namespace seam
