#include "server/rules/script_room.h"

#include <algorithm>
#include <utility>

#include "common/scene/bricks.h"
#include "common/scene/character.h"
#include "common/scene/joint_kinds.h"
#include "common/scene/part_rules.h"
#include "common/scene/toml/scene_text.h"
#include "server/rules/part_owner.h"

namespace seam {
namespace {

/// Longest text of a script's event, bytes.
constexpr std::size_t kSayMax = 200;

}  // namespace

PartId ScriptRoom::FindPart(const std::string& name) const {
  const std::vector<Part>& parts = rules_.scene().parts;
  for (; parts_known_ < parts.size(); ++parts_known_) {
    part_of_name_[parts[parts_known_].name] = parts[parts_known_].id;
  }
  const auto found = part_of_name_.find(name);
  return found != part_of_name_.end() ? found->second : -1;
}

PartId ScriptRoom::NeedPart(const std::string& name) const {
  const PartId part = FindPart(name);
  if (part < 0 || !rules_.Exists(part)) {
    throw ScriptRefusal("there is no part '" + Printable(name) + "'");
  }
  return part;
}

int ScriptRoom::NeedPlayer(const std::string& name) const {
  const std::vector<Player>& players = rules_.scene().players;
  for (std::size_t p = 0; p < players.size(); ++p) {
    if (players[p].name == name) return static_cast<int>(p);
  }
  throw ScriptRefusal("there is no player '" + Printable(name) + "'");
}

bool ScriptRoom::ReadPart(const std::string& part, BodyState* state) const {
  return seam::ReadPart(rules_.world_, FindPart(part), state);
}

bool ScriptRoom::Present(const std::string& player) const {
  return rules_.commands_.Present(NeedPlayer(player));
}

Input ScriptRoom::ReadInput(const std::string& player) const {
  return rules_.commands_.ReadInput(NeedPlayer(player));
}

int ScriptRoom::FindSeat(int player) const {
  const std::vector<Seat>& seats = rules_.scene().seats;
  const auto found = std::find_if(seats.begin(), seats.end(),
                                  [player](const Seat& seat) { return seat.player == player; });
  return found == seats.end() ? -1 : static_cast<int>(found - seats.begin());
}

const std::string& ScriptRoom::SeatOf(const std::string& player) const {
  const int seat = FindSeat(NeedPlayer(player));
  return seat < 0 ? none_ : rules_.scene().seats[static_cast<std::size_t>(seat)].name;
}

void ScriptRoom::Unseat(const std::string& player) {
  const int seat = FindSeat(NeedPlayer(player));
  if (seat < 0) throw ScriptRefusal("'" + Printable(player) + "' sits in no seat");
  rules_.commands_.LeaveSeat(seat);
}

void ScriptRoom::Push(const std::string& part, const Vec2& impulse, const std::string& /*why*/) {
  const PartId id = NeedPart(part);
  const int mechanism = MechanismOf(rules_.world_, id);
  if (mechanism < 0) throw ScriptRefusal("'" + Printable(part) + "' is anchored");
  const Composition& c = rules_.world_.composition();
  const int assembly = c.assembly_of_part[static_cast<std::size_t>(id)];
  const PartId root = c.assemblies[static_cast<std::size_t>(assembly)].id;
  const float mass = rules_.world_.mass(rules_.world_.BodyOfId(root));
  if (impulse.norm() > rules_.scene().speed_limit * mass) {
    throw ScriptRefusal("the push makes '" + Printable(part) + "' faster than the speed_limit");
  }
  rules_.commands_.Push(id, impulse);
}

void ScriptRoom::Limp(const std::string& character, float seconds) {
  for (const Character& each : rules_.scene().characters) {
    if (!each.active || each.name != character) continue;
    for (const PartId part : each.parts) {
      if (rules_.Exists(part)) return rules_.commands_.Limp(part, seconds);
    }
  }
  throw ScriptRefusal("there is no active character '" + Printable(character) + "'");
}

void ScriptRoom::Blast(const Vec2& centre, float radius, float speed, float impulse) {
  rules_.Blast({centre, radius, speed, impulse});
}

void ScriptRoom::AddPart(const TomlNode& table) { rules_.commands_.Insert(ToToml("part", table)); }
void ScriptRoom::AddJoint(const TomlNode& table) {
  rules_.commands_.Insert(ToToml("joint", table));
}
void ScriptRoom::RemovePart(const std::string& part) {
  rules_.commands_.RemovePart(NeedPart(part));
}

void ScriptRoom::Weld(const std::string& a, const std::string& b, float strength) {
  if (strength < 0) throw ScriptRefusal("a strength below 0");
  rules_.commands_.Bond(NeedPart(a), NeedPart(b), strength);
}

void ScriptRoom::Unweld(const std::string& a, const std::string& b) {
  const PartId first = NeedPart(a), second = NeedPart(b);
  const std::vector<Joint>& joints = rules_.scene().joints;
  bool any = false;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const Joint& joint = joints[j];
    const bool rigid = HoldOf(joint.kind) == JointHold::kBond;
    const bool between =
        (joint.a == first && joint.b == second) || (joint.a == second && joint.b == first);
    if (joint.gone || !rigid || !between) continue;
    rules_.commands_.BreakJoint(static_cast<int>(j));
    any = true;
  }
  if (!any) {
    throw ScriptRefusal("'" + Printable(a) + "' and '" + Printable(b) + "' are not welded");
  }
}

void ScriptRoom::RemoveJoint(const std::string& joint) {
  const std::vector<Joint>& joints = rules_.scene().joints;
  for (std::size_t j = joints.size(); j-- > 0;) {
    if (joints[j].gone || joints[j].name != joint) continue;
    return rules_.commands_.BreakJoint(static_cast<int>(j));
  }
  throw ScriptRefusal("there is no joint '" + Printable(joint) + "'");
}

MetaKey ScriptRoom::KeyOf(const std::string& subject, const std::string& key) const {
  MetaKey meta;
  const PartId part = FindPart(subject);
  const std::vector<Player>& players = rules_.scene().players;
  const bool is_player = std::any_of(players.begin(), players.end(),
                                     [&](const Player& p) { return p.name == subject; });
  if (is_player) {
    meta.kind = kMetaPlayer;
    meta.id = NeedPlayer(subject);
  } else if (part >= 0) {
    meta.id = part;
  } else {
    throw ScriptRefusal("there is no player or part '" + Printable(subject) + "'");
  }
  const std::pair<const char*, std::int8_t> known[] = {{"health", kMetaHealth},
                                                       {"score", kMetaScore},
                                                       {"checkpoint", kMetaCheckpoint},
                                                       {"laps", kMetaLaps},
                                                       {"taken", kMetaTaken}};
  for (const auto& [name, code] : known) {
    if (key != name) continue;
    meta.key = code;
    return meta;
  }
  const bool own =
      key.size() == 6 && key.compare(0, 5, "value") == 0 && key[5] >= '0' && key[5] <= '9';
  if (!own) {
    throw ScriptRefusal("no value '" + Printable(key) +
                        "': health, score, checkpoint, laps, taken, value0 .. value9");
  }
  meta.key = static_cast<std::int8_t>(kMetaScripts + key[5] - '0');
  return meta;
}

float ScriptRoom::Get(const std::string& subject, const std::string& key) const {
  return rules_.table_.Get(KeyOf(subject, key));
}

void ScriptRoom::Set(const std::string& subject, const std::string& key, float value) {
  const MetaKey meta = KeyOf(subject, key);
  if (meta.key == kMetaHealth && meta.kind == kMetaPart) {
    const Part& part = rules_.scene().parts[static_cast<std::size_t>(meta.id)];
    if (part.rules->health <= 0) {
      throw ScriptRefusal("'" + part.name + "' has no health in the scene");
    }
    value = std::min(std::max(value, 0.0f), part.rules->health);
  }
  rules_.table_.Set(meta, value);
}

void ScriptRoom::Say(const std::string& text) {
  if (text.size() > kSayMax) throw ScriptRefusal("more than 200 bytes of text");
  if (!IsCleanText(text, "")) throw ScriptRefusal("text with a control character");
  rules_.commands_.Say(MakeEvent(EventKind::kScript, text));
}

}  // namespace seam
