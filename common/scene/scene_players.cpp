#include <cmath>

#include "common/base/names.h"
#include "common/scene/scene_draft.h"
#include "common/scene/scene_limits.h"

namespace seam {
namespace {

constexpr int kPaletteColours = 10;  // render/canvas/palette.h
constexpr int kButtons = 15;         // Input::buttons is an int16_t: 15 bits without the sign

SceneReader PlayerReader(const TomlNode& node, const SceneDraft& draft) {
  return SceneReader(node, draft.file, "player",
                     {"name", "vehicle", "region", "colour", "actions", "script", "repeat"});
}

/// Converts a script's time in seconds to the nearest tick.
std::int64_t ToTick(double seconds, const Scene& scene) {
  return std::llround(seconds * scene.solver.tick_hz);
}

Input ReadInput(const SceneReader& r) {
  Input input;
  const auto axis = [&r](const char* key) {
    return static_cast<std::int8_t>(std::lround(127 * r.Number(key, {-1, 1}, 0.0f)));
  };
  input.drive = axis("drive");
  input.lift = axis("lift");
  for (const TomlNode& button : r.Items("buttons")) {
    if (button.kind != TomlNode::Kind::kInteger || button.integer < 0 ||
        button.integer >= kButtons) {
      r.FailAt("buttons", "buttons must be a list of integers from 0 to 14");
    }
    input.buttons = static_cast<std::int16_t>(input.buttons | (1 << button.integer));
  }
  return input;
}

void ReadScript(const SceneReader& r, const SceneDraft& draft, Player* player) {
  for (const TomlNode& item : r.Items("script")) {
    if (player->script.size() == kScriptMax) {
      r.FailAt("script", "script has more than " + std::to_string(kScriptMax) + " entries");
    }
    const bool pair = item.kind == TomlNode::Kind::kArray && item.items.size() == 2;
    const TomlNode& time = pair ? item.items[0] : item;
    const bool number =
        time.kind == TomlNode::Kind::kInteger || time.kind == TomlNode::Kind::kNumber;
    if (!pair || !number || !(time.number >= 0 && time.number <= 86400)) {
      r.FailAt("script", "each entry must be [seconds from 0 to 86400, {drive = 1.0}]");
    }
    const SceneReader input(item.items[1], draft.file, r.what() + ": script",
                            {"drive", "lift", "buttons"});
    const InputSpan span{ToTick(time.number, draft.scene), ReadInput(input)};
    if (!player->script.empty() && player->script.back().from_tick >= span.from_tick) {
      input.Fail("times must ascend by a tick or more, " + Decimal(time.number) + " s does not");
    }
    player->script.push_back(span);
  }
}

void ReadActions(const SceneReader& r, const SceneDraft& draft, Player* player) {
  for (const TomlNode* node : r.Tables("actions")) {
    const SceneReader a(*node, draft.file, r.what() + ": action", {"button", "part", "impulse"});
    Action action;
    action.line = node->line;
    action.button = a.Integer("button", {0, kButtons - 1});
    action.part = FindPart(a, "part", draft);
    action.impulse = a.Vector("impulse", {-1e7, 1e7});
    if (player->actions.size() == kActionsMax) {
      a.Fail("a player may have at most " + std::to_string(kActionsMax) + " actions");
    }
    player->actions.push_back(action);
  }
}

void ReadRegion(const SceneReader& r, Player* player) {
  if (!r.Has("region")) return;
  const std::vector<Vec2> corners = r.Points("region", kCoordinate, 2);
  if (corners.size() != 2 || (corners[1] - corners[0]).minCoeff() <= 0) {
    r.FailAt("region", "region must be two corners [[x, y], [x, y]], the lower left first");
  }
  player->has_region = true;
  player->region_min = corners[0];
  player->region_max = corners[1];
}

/// Checks for "#rrggbb", or the number of a palette colour; player_colours.h reads it for pictures.
void CheckColour(const SceneReader& r) {
  if (!r.Has("colour")) return;
  if (!r.IsText("colour")) {
    r.Integer("colour", {1, kPaletteColours});
    return;
  }
  const std::string text = r.Text("colour");
  const bool digits = text.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos;
  if (text.size() != 7 || text[0] != '#' || !digits)
    r.FailAt("colour", "colour must be \"#rrggbb\", or 1 to 10 of the palette");
}

void AddName(const SceneReader& r, const std::string& name, SceneDraft* draft) {
  std::vector<Player>& players = draft->scene.players;
  if (!IsName(name)) r.FailAt("name", "the copy's name '" + name + "' is too long");
  for (const Player& other : players) {
    if (other.name == name) r.FailAt("name", "there is another player of this name");
  }
  if (players.size() == static_cast<std::size_t>(kPlayersMax)) {
    r.Fail("a scene may have at most " + std::to_string(kPlayersMax) + " players");
  }
  players.emplace_back();
  players.back().name = name;
}

/// Adapts copy (column, row): the vehicle and the actions' parts become the corresponding copies,
/// and the region is shifted.
void MoveCopy(const SceneReader& r, const Repeat& repeat, int column, int row,
              const SceneDraft& draft, Player* player) {
  const auto after = [&](PartId part) {
    return PartAfter(r, part, column, row, repeat.grid, draft);
  };
  if (player->vehicle >= 0) player->vehicle = after(player->vehicle);
  for (Action& action : player->actions) action.part = after(action.part);
  player->region_min += repeat.Offset(column, row);
  player->region_max += repeat.Offset(column, row);
}

}  // namespace

void ReadPlayerNames(const SceneReader& root, SceneDraft* draft) {
  for (const TomlNode* node : root.Tables("player")) {
    const SceneReader r = PlayerReader(*node, *draft);
    const std::string name = r.Name("name");
    const PlayerGroup group{static_cast<int>(draft->scene.players.size()),
                            ReadRepeat(r, draft->file, true)};
    const Repeat& repeat = group.repeat;
    if (!draft->players_of_name.emplace(name, group).second) {
      r.FailAt("name", "there is another player of this name");
    }
    for (int column = 0; column < repeat.columns; ++column) {
      for (int row = 0; row < repeat.rows; ++row) {
        AddName(r, repeat.copies ? PlayerCopyName(name, repeat, column, row) : name, draft);
      }
    }
  }
}

void ReadPlayers(const SceneReader& root, SceneDraft* draft) {
  std::size_t index = 0;
  for (const TomlNode* node : root.Tables("player")) {
    SceneReader r = PlayerReader(*node, *draft);
    const std::string name = r.Name("name");
    r.Rename("player '" + name + "'");
    Player player;
    player.line = node->line;
    if (r.Has("vehicle")) player.vehicle = FindPart(r, "vehicle", *draft);
    ReadRegion(r, &player);
    CheckColour(r);
    ReadActions(r, *draft, &player);
    ReadScript(r, *draft, &player);
    const Repeat& repeat = draft->players_of_name.at(name).repeat;
    for (int column = 0; column < repeat.columns; ++column) {
      for (int row = 0; row < repeat.rows; ++row) {
        Player& copy = draft->scene.players[index++];
        player.name = copy.name;
        copy = player;
        if (repeat.copies) MoveCopy(r, repeat, column, row, *draft, &copy);
      }
    }
  }
}

void ReadWatch(const SceneReader& root, SceneDraft* draft) {
  for (const TomlNode* node : root.Tables("watch")) {
    const SceneReader r(*node, draft->file, "watch", {"struck", "around"});
    WatchCollision watch;
    watch.line = node->line;
    for (const std::string& name : r.Texts("struck")) {
      for (const PartId part : FindParts(r, "struck", name, *draft)) watch.struck.push_back(part);
    }
    if (watch.struck.empty()) r.Fail("struck must name one part or more");
    watch.around_tick = ToTick(r.Seconds("around", {0, 86400}, 0.0), draft->scene);
    if (draft->scene.watch.size() == kWatchMax) r.Fail("there are more than 16 [[watch]]");
    draft->scene.watch.push_back(watch);
  }
}

void ReadCamera(const SceneReader& root, SceneDraft* draft) {
  const TomlNode* table = root.Table("camera");
  if (table == nullptr) return;
  const SceneReader r(*table, draft->file, "camera", {"min", "max", "follow"});
  Camera& camera = draft->scene.camera;
  camera.given = r.Has("min") || r.Has("max");
  camera.min = r.Vector("min", kCoordinate, camera.min);
  camera.max = r.Vector("max", kCoordinate, camera.max);
  if ((camera.max - camera.min).minCoeff() < 0.1f) {
    r.Fail("max must lie 0.1 m or more right of and above min");
  }
  if (r.Has("follow")) camera.follow = FindPart(r, "follow", *draft);
}

}  // namespace seam
