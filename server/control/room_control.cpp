#include "server/control/room_control.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "common/base/check.h"
#include "common/base/json_text.h"
#include "common/base/nearest.h"
#include "common/codec/message_limits.h"
#include "common/codec/validate.h"
#include "server/chronicle.h"
#include "server/edits/edit_line.h"

namespace seam {
namespace {

/// Splits a line into its first word and the rest, without the spaces between.
std::pair<std::string, std::string> FirstWord(const std::string& line) {
  const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
  const std::size_t end = std::min(line.find(' ', begin), line.size());
  const std::size_t rest = std::min(line.find_first_not_of(' ', end), line.size());
  return {line.substr(begin, end - begin), line.substr(rest)};
}

/// Reads exactly so many finite numbers.
std::optional<std::vector<float>> Numbers(const std::string& words, std::size_t count) {
  std::istringstream in(words);
  std::vector<float> numbers;
  for (float number = 0; in >> number;) numbers.push_back(number);
  const bool finite = std::all_of(numbers.begin(), numbers.end(),
                                  [](float number) { return std::isfinite(number); });
  if (!in.eof() || numbers.size() != count || !finite) return std::nullopt;
  return numbers;
}

/// Returns the part of this name that is there; -1: none.
PartId PartNamed(const World& world, const std::string& name) {
  const std::vector<int>& assemblies = world.composition().assembly_of_part;
  for (const Part& part : world.scene().parts) {
    const auto index = static_cast<std::size_t>(part.id);
    if (part.name == name && assemblies[index] >= 0) return part.id;
  }
  return -1;
}

}  // namespace

RoomControl::RoomControl(Server& server, ImpairedNet& net, std::string impair)
    : server_(server), net_(net), impair_(std::move(impair)) {}

std::string RoomControl::Help() {
  std::string help = "impair PROFILE | ";
  for (const LiveSetting& setting : LiveSettings()) help += std::string(setting.name) + " TICKS | ";
  return help + "drag PART X Y TO_X TO_Y | release PART | " + EditLineHelp();
}

Status RoomControl::Do(std::int64_t now_us, const std::string& line) {
  const bool lines = line.rfind("insert ", 0) == 0;
  if (!IsPrintable(line, kTextBytesMax, lines)) {
    return Status::Error("the command is no printable line of at most 1000 bytes");
  }
  const auto [word, rest] = FirstWord(line);
  if (word == "impair") return Impair(now_us, rest);
  if (word == "drag") return Drag(now_us, rest);
  if (word == "release") return Release(now_us, rest);
  if (const LiveSetting* const setting = FindLiveSetting(word)) {
    const auto ticks = Numbers(rest, 1);
    const bool whole = ticks && std::floor((*ticks)[0]) == (*ticks)[0];
    // What is no number of ticks is refused as one out of range.
    const bool possible = whole && std::abs((*ticks)[0]) <= static_cast<float>(setting->most);
    return Set(now_us, *setting, possible ? static_cast<int>((*ticks)[0]) : -1);
  }
  return OrderEdit(now_us, line);
}

Status RoomControl::Set(std::int64_t now_us, const LiveSetting& setting, int ticks) {
  const Status changed = server_.settings().Change(setting, ticks);
  if (!changed.ok()) return changed;
  Event event =
      MakeEvent(EventKind::kControl, fmt::format("{} is now {} ticks", setting.title, ticks));
  event.index = setting.key;
  event.value_milli = 1000 * ticks;
  server_.chronicle().Say(now_us, event);
  return changed;
}

Status RoomControl::Impair(std::int64_t now_us, const std::string& profile) {
  if (profile.size() > kImpairBytesMax) return Status::Error("the profile is too long");
  try {
    const ImpairProfile found = FindProfile(profile);
    net_.Change(found, found);
  } catch (const OperatorError& error) {
    return Status::Error(error.what());
  }
  impair_ = profile;
  Say(now_us, "network is now " + impair_);
  return Status::Ok();
}

Status RoomControl::Drag(std::int64_t now_us, const std::string& words) {
  const auto [name, rest] = FirstWord(words);
  const auto numbers = Numbers(rest, 4);
  if (!numbers) return Status::Error("drag takes PART X Y TO_X TO_Y, in metres");
  const World& world = server_.replica().world();
  const PartId part = PartNamed(world, name);
  if (part < 0) {
    std::vector<std::string> names;
    for (const Part& each : world.scene().parts) names.push_back(each.name);
    return Status::Error("no part " + name + " (" + Suggestion(name, names) + ")");
  }
  const std::vector<float>& n = *numbers;
  Hand hand{{part, Vec2(n[0], n[1]), Vec2(n[2], n[3])}, name, now_us};
  if (!DragPush(world, hand.grip, PushInterval())) return Status::Error(name + " does not move");
  const auto held = hands_.find(part);
  if (held != hands_.end()) {
    held->second = std::move(hand);
    return Status::Ok();
  }
  if (hands_.size() == kHandsMax) return Status::Error("too many parts are dragged");
  hands_.emplace(part, std::move(hand));
  Say(now_us, name + " is dragged", part);
  return Status::Ok();
}

Status RoomControl::Release(std::int64_t now_us, const std::string& name) {
  for (auto hand = hands_.begin(); hand != hands_.end(); ++hand) {
    if (hand->second.name != name) continue;
    Say(now_us, name + " is let go", hand->first);
    hands_.erase(hand);
    return Status::Ok();
  }
  return Status::Error(name + " is not dragged");
}

Status RoomControl::OrderEdit(std::int64_t now_us, const std::string& line) {
  try {
    const Edit edit = ParseEditLine(line, server_.replica().world().topology());
    if (!server_.Order(edit)) return Status::Error("too many edits are waiting");
  } catch (const OperatorError& error) {
    return Status::Error(error.what());
  }
  Say(now_us, line.substr(0, line.find('\n')));
  return Status::Ok();
}

void RoomControl::BeforeTick(std::int64_t now_us) {
  for (auto hand = hands_.begin(); hand != hands_.end();) {
    const auto [part, held] = *hand++;
    if (now_us - held.moved_us > kHandHeldUs) (void)Release(now_us, held.name);
  }
  const std::int64_t tick = server_.tick();
  if (!server_.started() || (pushed_tick_ >= 0 && tick - pushed_tick_ < PushEvery())) return;
  for (auto hand = hands_.begin(); hand != hands_.end();) {
    const auto [part, held] = *hand++;
    const auto push = DragPush(server_.replica().world(), held.grip, PushInterval());
    if (!push) {  // it has gone, or moves no more
      (void)Release(now_us, held.name);
      continue;
    }
    server_.Order(Edit(*push, EditCause::kOutside));
    pushed_tick_ = tick;
  }
}

int RoomControl::PushEvery() const { return std::max(1, server_.room().tick_hz / kDragPushHz); }

float RoomControl::PushInterval() const {
  return static_cast<float>(PushEvery()) / static_cast<float>(server_.room().tick_hz);
}

void RoomControl::Say(std::int64_t now_us, const std::string& text, PartId part) {
  Event event = MakeEvent(EventKind::kControl, text);
  event.body = part;
  server_.chronicle().Say(now_us, event);
}

std::string RoomControl::Json() const {
  std::string values;
  for (const LiveSetting& setting : LiveSettings()) {
    values += fmt::format(R"("{}":{{"ticks":{},"most":{}}},)", setting.name,
                          server_.settings().newest(setting), setting.most);
  }
  std::vector<std::string> profiles, dragged;
  for (const std::string& name : ProfileNames()) profiles.push_back(JsonText(name));
  for (const auto& [part, hand] : hands_) dragged.push_back(JsonText(hand.name));
  return fmt::format(R"({{"impair":{},{}"tick_hz":{},"dragged":{},"profiles":{}}})",
                     JsonText(impair_), values, server_.room().tick_hz, JsonList(dragged),
                     JsonList(profiles));
}

}  // namespace seam
