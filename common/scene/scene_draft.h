#pragma once
/// Readers of a scene file's sections, one function each; ParseScene calls them in this order.

#include <map>
#include <set>
#include <string>
#include <vector>

#include "common/base/status.h"
#include "common/scene/connectors.h"
#include "common/scene/part_rules.h"
#include "common/scene/scene.h"
#include "common/scene/toml/scene_reader.h"

namespace seam {

/// `repeat = {count, step}`: number and placement of the copies of a part or joint. For parts also
/// `weld` or `glue`: neighbouring copies in a column or row are joined.
struct Repeat {
  int columns = 1, rows = 1;
  bool copies = false;  ///< `repeat` is present
  bool joined = false;
  JointKind kind = JointKind::kWeld;
  float strength = 0;  ///< N; for glue
  bool grid = false;   ///< names get two numbers
  Vec2 step{0, 0};     ///< m; grid: x per column, y per row; else per copy

  Vec2 Offset(int column, int row) const;
  /// Returns ".3", or in a grid ".3.1".
  std::string Suffix(int column, int row) const;
};
/// Reads `repeat`. With `of_players`, no weld or glue is read, and copies without a step share one
/// position.
Repeat ReadRepeat(const SceneReader& owner, const std::string& file, bool of_players = false);

/// Players made by one [[player]]: column by column, as `repeat` says.
struct PlayerGroup {
  int first = 0;  ///< index in the scene
  Repeat repeat;
};

/// A scene while it is being read.
struct SceneDraft {
  const std::string& file;
  Scene scene;
  float size_max = 10;  ///< m
  std::map<std::string, PartId> part_of_name = {};
  std::map<std::string, std::vector<PartId>> group_of_name = {};  ///< copies made by `repeat`
  std::set<std::string> joint_names = {};
  std::map<std::string, PlayerGroup> players_of_name = {};  ///< by the name of each [[player]]
};

/// Returns the part that follows `part` by the given number of copies ("link.0" and column 2:
/// "link.2"), for a copy of an item that names it; a part that is no copy stays. Complains at
/// `repeat` if there is none.
PartId PartAfter(const SceneReader& r, PartId part, int column, int row, bool grid,
                 const SceneDraft& draft);
/// Returns "bot-3", or in a grid "bot-3-1": a player's name has no dots.
std::string PlayerCopyName(const std::string& name, const Repeat& repeat, int column, int row);
/// Like PartAfter, for copies of players; seats, and -1, stay.
int PlayerAfter(const SceneReader& r, int player, int column, int row, bool grid,
                const SceneDraft& draft);

/// [[player]]: only the names, so that parts and joints can refer to them.
void ReadPlayerNames(const SceneReader& root, SceneDraft* draft);
/// [[part]], with all repeated copies.
void ReadParts(const SceneReader& root, SceneDraft* draft);
/// A part's inlets and outlets.
Connectors ReadConnectors(const SceneReader& part);
/// [grouping].
void ReadGrouping(const SceneReader& root, SceneDraft* draft);
/// [[bricks]]. Requires parts.
void ReadBricks(const SceneReader& root, SceneDraft* draft);
/// [[character]], as parts and joints. Requires parts and players.
void ReadCharacters(const SceneReader& root, SceneDraft* draft);
/// [[joint]]. Requires parts, characters and players.
void ReadJoints(const SceneReader& root, SceneDraft* draft);
/// [[water]]. Requires gravity.
void ReadWaters(const SceneReader& root, SceneDraft* draft);
/// [[player]]: all but the names. Requires parts.
void ReadPlayers(const SceneReader& root, SceneDraft* draft);
/// Sets follow and server_follow unless the scene does: lower where many players start farther
/// apart than twice their radius of interest. Requires players and the planner's rules.
void LimitFollowing(const SceneReader& root, SceneDraft* draft);
/// [[seat]]: only the names, so that motors can refer to them. Requires the players' names.
void ReadSeatNames(const SceneReader& root, SceneDraft* draft);
/// [[seat]]: all but the names. Requires parts.
void ReadSeats(const SceneReader& root, SceneDraft* draft);
/// Reads the health, score and permissions of a [[part]].
PartRules ReadPartRules(const SceneReader& r, const SceneDraft& draft);
/// [[trigger]]. Requires parts and players.
void ReadTriggers(const SceneReader& root, SceneDraft* draft);
/// [[charges]]. Requires parts and triggers.
void ReadCharges(const SceneReader& root, SceneDraft* draft);
/// [[script]]. Requires the text.
void ReadScripts(const SceneReader& root, SceneDraft* draft);
/// [lcm]. Requires parts, players, scripts and the solver.
void ReadLcm(const SceneReader& root, SceneDraft* draft);
/// [[watch]]. Requires parts.
void ReadWatch(const SceneReader& root, SceneDraft* draft);
/// [planner].
void ReadPlanner(const SceneReader& root, SceneDraft* draft);
/// [camera]. Requires parts.
void ReadCamera(const SceneReader& root, SceneDraft* draft);

/// Returns the part that `key` names; complains if there is none.
PartId FindPart(const SceneReader& reader, const char* key, const SceneDraft& draft);
/// Returns the part of a name, or for "name.*" all copies of a repeated part.
std::vector<PartId> FindParts(const SceneReader& reader, const char* key, const std::string& name,
                              const SceneDraft& draft);
/// Returns the player's index; complains at `key` if there is none.
int FindPlayer(const SceneReader& reader, const char* key, const std::string& name,
               const SceneDraft& draft);

/// Reads `player` and `axis` (default: drive). Returns the driver as FindDriver does; -1 without
/// `player`.
int ReadAxisDriver(const SceneReader& r, const SceneDraft& draft, InputAxis* axis);

/// Returns the players named at `key`; "bot-*" names all copies of a repeated player.
std::vector<int> FindPlayers(const SceneReader& reader, const char* key, const SceneDraft& draft);

/// Returns the source of inputs: a player's index, or players.size() + a seat's; complains at `key`
/// if there is neither.
int FindDriver(const SceneReader& reader, const char* key, const std::string& name,
               const SceneDraft& draft);
/// See above.
int ReadAxisDriver(const SceneReader& r, const SceneDraft& draft, InputAxis* axis);

/// Checks that need the whole scene (its composition). Throws OperatorError.
void CheckScene(const Scene& scene, const std::string& file);

/// Reads a part's conveyor: a number or a table.
void ReadConveyor(const SceneReader& r, const SceneDraft& draft, Part* part);
/// [[strand]]. Requires parts and characters.
void ReadStrands(const SceneReader& root, SceneDraft* draft);
/// [[thrust]] and [[propeller]]. Requires parts and players.
void ReadThrusts(const SceneReader& root, SceneDraft* draft);

/// Reads the shape of the table: one of box, circle, capsule, wedge, polygon, chain and segment.
void ReadShape(const SceneReader& r, float size_max, Part* part);

/// Checks that no player needs a forbidden permission. Throws OperatorError.
void CheckPermissions(const Scene& scene, const std::string& file);

/// Check shapes against the demands of Box2D and of this project.
Status ValidatePolygon(const std::vector<Vec2>& points, float size_max);
Status ValidateChain(const std::vector<Vec2>& points);

}  // namespace seam
