#include <algorithm>
#include <string>
#include <vector>

#include "common/base/nearest.h"
#include "common/scene/scene_draft.h"
#include "common/scene/scene_limits.h"
#include "common/scene/toml/scene_text.h"

namespace seam {
namespace {

constexpr std::size_t kSeatsMax = 32;

SceneReader SeatReader(const TomlNode& node, const SceneDraft& draft) {
  return SceneReader(node, draft.file, "seat", {"name", "part", "at", "angle", "reach", "button"});
}

}  // namespace

void ReadSeatNames(const SceneReader& root, SceneDraft* draft) {
  for (const TomlNode* node : root.Tables("seat")) {
    const SceneReader r = SeatReader(*node, *draft);
    Seat seat;
    seat.name = r.Name("name");
    seat.line = r.line();
    for (const Player& player : draft->scene.players) {
      if (player.name == seat.name) r.FailAt("name", "there is a player of this name");
    }
    for (const Seat& other : draft->scene.seats) {
      if (other.name == seat.name) r.FailAt("name", "there is another seat of this name");
    }
    if (draft->scene.seats.size() == kSeatsMax) {
      r.Fail("a scene may have at most " + std::to_string(kSeatsMax) + " seats");
    }
    draft->scene.seats.push_back(seat);
  }
}

void ReadSeats(const SceneReader& root, SceneDraft* draft) {
  std::size_t index = 0;
  for (const TomlNode* node : root.Tables("seat")) {
    SceneReader r = SeatReader(*node, *draft);
    Seat& seat = draft->scene.seats[index++];
    r.Rename("seat '" + seat.name + "'");
    seat.part = FindPart(r, "part", *draft);
    if (draft->scene.parts[static_cast<std::size_t>(seat.part)].anchored) {
      r.FailAt("part", "the part of a seat must move");
    }
    seat.at = r.Vector("at", {-100, 100}, Vec2(0, 0));
    seat.angle = r.Number("angle", {-10, 10, true}, 0.0f);
    seat.reach = r.Number("reach", {0.1, 100}, seat.reach);
    seat.button = r.Integer("button", {0, 14});
  }
}

int FindDriver(const SceneReader& reader, const char* key, const std::string& name,
               const SceneDraft& draft) {
  for (std::size_t s = 0; s < draft.scene.seats.size(); ++s) {
    if (draft.scene.seats[s].name == name) {
      return static_cast<int>(draft.scene.players.size() + s);
    }
  }
  std::vector<std::string> seats;
  for (const Seat& seat : draft.scene.seats) seats.push_back(seat.name);
  const std::string meant = DidYouMean(name, seats);
  const bool player = std::any_of(draft.scene.players.begin(), draft.scene.players.end(),
                                  [&](const Player& p) { return p.name == name; });
  if (!player && !meant.empty()) {
    reader.FailAt(key, std::string(key) + ": there is no seat '" + Printable(name) + "'" + meant);
  }
  return FindPlayer(reader, key, name, draft);
}

}  // namespace seam
