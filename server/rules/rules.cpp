#include "server/rules/rules.h"

#include <algorithm>

#include "common/scene/charges/charge.h"
#include "common/scene/part_rules.h"
#include "server/rules/part_owner.h"
#include "server/rules/script_room.h"
#include "server/script/script.h"

namespace seam {
namespace {

/// Hazards wait at most this long for a state of a body inside, ticks: 0.5 s. A smaller value hurts
/// bodies that have already left; a larger one hurts sleeping bodies late.
constexpr std::int64_t kSilentTicksMax = 30;

}  // namespace

bool Rules::Needed(const Scene& scene) { return NeedsRules(scene); }

Rules::Rules(const World& world, std::int64_t seed, RoomCommands& commands, RuleSource* source)
    : world_(world),
      seed_(seed),
      commands_(commands),
      own_world_(world),
      source_(source != nullptr ? *source : own_world_),
      triggers_(world.scene().triggers),
      room_(std::make_unique<ScriptRoom>(*this)) {
  for (const Trigger& trigger : scene().triggers) {
    last_checkpoint_ = std::max(last_checkpoint_, trigger.order);
  }
  NoteNewParts();
  for (std::size_t i = 0; i < scene().scripts.size(); ++i) {
    scripts_.push_back(StartScript(i, nullptr));
  }
}

std::unique_ptr<Script> Rules::StartScript(std::size_t index, const SavedScript* saved) {
  // Errors name the file; Lua truncates names of more than 59 characters.
  const std::string file = scene().name.substr(0, 48) + ".toml";
  const std::uint64_t own = static_cast<std::uint64_t>(seed_) * 64 + index;
  return std::make_unique<Script>(scene().scripts[index], file, own, *room_, saved);
}

Rules::~Rules() = default;

void Rules::OnJoin(int player) { player_events_.push_back({player, true}); }
void Rules::OnLeave(int player) { player_events_.push_back({player, false}); }

bool Rules::Queue(LcmHeard message) {
  if (queued_.size() == kMessagesMax) return false;
  queued_.push_back(std::move(message));
  return true;
}

void Rules::AfterTick() {
  NoteNewParts();
  RunTriggers();
  RunCharges();
  RunHazards();
  RunDamage();
  RunScripts();
  RunDeaths();
  happened_.clear();
  player_events_.clear();
  seat_events_.clear();
  messages_.clear();
  struck_by_.clear();
  violence_ = Violence{};
}

void Rules::NoteNewParts() {
  const std::vector<Part>& parts = scene().parts;
  for (; parts_noted_ < parts.size(); ++parts_noted_) {
    const Part& part = parts[parts_noted_];
    if (part.rules->health <= 0) continue;
    table_.Set({kMetaPart, part.id, kMetaHealth}, part.rules->health);
  }
}

bool Rules::Exists(PartId part) const {
  BodyState state;
  return ReadPart(world_, part, &state);
}

float Rules::Health(PartId part) const { return table_.Get({kMetaPart, part, kMetaHealth}); }

std::string Rules::PlayerName(int player) const {
  return player >= 0 ? scene().players[static_cast<std::size_t>(player)].name : "nobody";
}

void Rules::RunTriggers() {
  if (scene().triggers.empty()) return;
  for (const std::int64_t tick : source_.Ticks()) RunTriggersAt(tick);
  source_.MarkProcessed();
}

void Rules::RunTriggersAt(std::int64_t tick) {
  const auto place_of = [this, tick](PartId part) -> std::optional<Vec2> {
    BodyState state;
    const auto read = [this, tick](int body) { return source_.ReadAt(body, tick); };
    if (!ReadPart(world_, part, read, &state)) return std::nullopt;
    return state.position;
  };
  const auto player_of = [this](PartId part) {
    return PlayerOf(world_, MechanismOf(world_, part));
  };
  const auto doubted = [this](PartId part) {
    bool any = false;
    BodyState unused;
    const auto read = [&](int body) {
      any = any || source_.Doubted(body);
      return BodyState();
    };
    ReadPart(world_, part, read, &unused);
    return any;
  };
  for (const TriggerEvent& event : triggers_.Update(place_of, player_of, doubted)) {
    if (event.entered) OnEntered(event);
    happened_.push_back(event);
  }
  NoteHazards(tick);
}

void Rules::OnEntered(const TriggerEvent& event) {
  const Trigger& trigger = scene().triggers[static_cast<std::size_t>(event.trigger)];
  const std::int32_t player = event.player;
  switch (trigger.kind) {
    case TriggerKind::kCheckpoint: return OnCheckpoint(event);
    case TriggerKind::kPickup: OnPickup(event); break;
    case TriggerKind::kArea:
    case TriggerKind::kHazard: break;
  }
  if (trigger.score != 0 && player >= 0)
    table_.Add({kMetaPlayer, player, kMetaScore}, trigger.score);
}

/// Counts checkpoints in their order only; the last one completes a lap.
void Rules::OnCheckpoint(const TriggerEvent& event) {
  const Trigger& trigger = scene().triggers[static_cast<std::size_t>(event.trigger)];
  if (event.player < 0) return;
  const std::int32_t player = event.player;
  const MetaKey reached{kMetaPlayer, player, kMetaCheckpoint};
  const auto last = static_cast<float>(last_checkpoint_);  // a saved value may be any
  const auto before = static_cast<int>(std::clamp(table_.Get(reached), 0.0f, last));
  // The next existing order: orders may have gaps.
  int next = last_checkpoint_;
  for (const Trigger& other : scene().triggers) {
    if (other.order > before) next = std::min(next, other.order);
  }
  if (trigger.order != next) return;
  table_.Set(reached, static_cast<float>(trigger.order));
  if (trigger.score != 0) table_.Add({kMetaPlayer, player, kMetaScore}, trigger.score);
  SayTrigger(event.trigger, player, PlayerName(player) + " passes " + trigger.name);
  if (trigger.order != last_checkpoint_) return;
  table_.Set(reached, 0);
  table_.Add({kMetaPlayer, player, kMetaLaps}, 1);
  SayTrigger(event.trigger, player, PlayerName(player) + " has done a lap");
}

void Rules::SayTrigger(int trigger, int player, const std::string& text) {
  Event event = MakeEvent(EventKind::kTrigger, text, player);
  event.body = scene().triggers[static_cast<std::size_t>(trigger)].part;
  event.index = trigger;
  commands_.Say(event);
}

void Rules::OnPickup(const TriggerEvent& event) {
  const Trigger& trigger = scene().triggers[static_cast<std::size_t>(event.trigger)];
  if (trigger.part >= 0) {
    const auto id = trigger.part;
    table_.Set({kMetaPart, id, kMetaTaken}, static_cast<float>(event.player + 1));
    try {
      commands_.RemovePart(trigger.part);
    } catch (const ScriptRefusal&) {
      // A script has removed the part in the same tick: it counts as taken all the same.
    }
  }
  const Part& taker = scene().parts[static_cast<std::size_t>(event.part)];
  if (trigger.health != 0 && taker.rules->health > 0 && dead_.count(event.part) == 0) {
    const float health = std::min(Health(event.part) + trigger.health, taker.rules->health);
    table_.Set({kMetaPart, event.part, kMetaHealth}, health);
  }
  SayTrigger(event.trigger, event.player, PlayerName(event.player) + " takes " + trigger.name);
}

void Rules::NoteHazards(std::int64_t tick) {
  for (const auto& [index, part] : triggers_.inside()) {
    if (scene().triggers[static_cast<std::size_t>(index)].kind != TriggerKind::kHazard) continue;
    std::int64_t at = tick;
    const auto read = [&](int body) {
      at = source_.TickOf(body, tick);
      return source_.ReadAt(body, tick);
    };
    BodyState unused;
    ReadPart(world_, part, read, &unused);
    Stay& stay = stays_.emplace(std::make_pair(index, part), Stay{at, at - 1, 0, 0}).first->second;
    if (at > stay.last) stay.silent = 0;
    stay.last = std::max(stay.last, at);
  }
}

/// Hurts bodies inside once per tick of their authority's time, independent of network jitter.
/// After a long silence, the server's time counts.
void Rules::RunHazards() {
  for (auto it = stays_.begin(); it != stays_.end();) {
    auto& [index_part, stay] = *it;
    const Trigger& trigger = scene().triggers[static_cast<std::size_t>(index_part.first)];
    const bool is_inside = triggers_.inside().count(index_part) != 0;
    const bool is_silent = is_inside && stay.silent++ > kSilentTicksMax;
    const std::int64_t known = stay.last - stay.first + 1 + (is_silent ? stay.silent : 0);
    const std::int64_t ticks = std::max<std::int64_t>(0, known - stay.hurt);
    stay.hurt += ticks;
    const float amount = static_cast<float>(ticks) * trigger.health * world_.dt();
    if (ticks > 0) Hurt(index_part.second, amount, -1);
    it = is_inside ? std::next(it) : stays_.erase(it);
  }
}

}  // namespace seam
