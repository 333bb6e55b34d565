#pragma once
/// The sections of a scene file, one function each; ParseScene calls them in this order.

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

/// `repeat = {count, step}`: how often a part or joint is copied, and where each copy goes.
/// Of a part also `weld` or `glue`: copies that follow each other in a column or row are joined.
struct Repeat {
  int columns = 1, rows = 1;
  bool copies = false;  ///< something says `repeat`
  bool joined = false;
  JointKind kind = JointKind::kWeld;
  float strength = 0;  ///< N; of glue
  bool grid = false;   ///< names get two numbers
  Vec2 step{0, 0};     ///< m; grid: x per column, y per row; else per copy

  Vec2 Offset(int column, int row) const;
  /// ".3", or in a grid ".3.1".
  std::string Suffix(int column, int row) const;
};
/// `of_players`: nothing is welded or glued, and without a step the copies are where the first is.
Repeat ReadRepeat(const SceneReader& owner, const std::string& file, bool of_players = false);

/// Players that one [[player]] has made: a column after the other, as `repeat` says.
struct PlayerGroup {
  int first = 0;  ///< index in the scene
  Repeat repeat;
};

/// A scene that is being read.
struct SceneDraft {
  const std::string& file;
  Scene scene;
  float size_max = 10;  ///< m
  std::map<std::string, PartId> part_of_name = {};
  std::map<std::string, std::vector<PartId>> group_of_name = {};  ///< what `repeat` made of a name
  std::set<std::string> joint_names = {};
  std::map<std::string, PlayerGroup> players_of_name = {};  ///< of each [[player]]
};

/// The part that comes as many copies after `part` ("link.0" and column 2: "link.2"), for a copy of
/// what names it; a part that is no copy stays. Complains at `repeat` when there is none.
PartId PartAfter(const SceneReader& r, PartId part, int column, int row, bool grid,
                 const SceneDraft& draft);
/// "bot-3", or in a grid "bot-3-1": a player's name has no dots.
std::string PlayerCopyName(const std::string& name, const Repeat& repeat, int column, int row);
/// The same of the players that `repeat` made; seats, and -1, stay.
int PlayerAfter(const SceneReader& r, int player, int column, int row, bool grid,
                const SceneDraft& draft);

/// [[player]]: only names, so that parts and joints can refer to them.
void ReadPlayerNames(const SceneReader& root, SceneDraft* draft);
/// [[part]], repetitions written out.
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
/// follow and server_follow, unless the scene says them: less where many players begin farther from
/// each other than twice what they hear. Requires players and the planner's rules.
void LimitFollowing(const SceneReader& root, SceneDraft* draft);
/// [[seat]]: only names, so that motors can refer to them. Requires players' names.
void ReadSeatNames(const SceneReader& root, SceneDraft* draft);
/// [[seat]]: all but the names. Requires parts.
void ReadSeats(const SceneReader& root, SceneDraft* draft);
/// What a [[part]] says of health, score and permissions.
PartRules ReadPartRules(const SceneReader& r, const SceneDraft& draft);
/// [[trigger]]. Requires parts and players.
void ReadTriggers(const SceneReader& root, SceneDraft* draft);
/// [[charges]]. Requires parts and triggers.
void ReadCharges(const SceneReader& root, SceneDraft* draft);
/// [[script]]. Requires the text.
void ReadScripts(const SceneReader& root, SceneDraft* draft);
/// [[watch]]. Requires parts.
void ReadWatch(const SceneReader& root, SceneDraft* draft);
/// [planner].
void ReadPlanner(const SceneReader& root, SceneDraft* draft);
/// [camera]. Requires parts.
void ReadCamera(const SceneReader& root, SceneDraft* draft);

/// The part that `key` names; complains if there is none.
PartId FindPart(const SceneReader& reader, const char* key, const SceneDraft& draft);
/// The parts of a name, or of all copies of a repeated part for "name.*".
std::vector<PartId> FindParts(const SceneReader& reader, const char* key, const std::string& name,
                              const SceneDraft& draft);
/// The player's index; complains at `key` if there is none.
int FindPlayer(const SceneReader& reader, const char* key, const std::string& name,
               const SceneDraft& draft);

/// Whose axis (`axis`, the drive unless said) something follows, as FindDriver; -1 without
/// `player`.
int ReadFollowed(const SceneReader& r, const SceneDraft& draft, InputAxis* axis);

/// The players named at `key`; "bot-*" are all copies of a repeated player.
std::vector<int> FindPlayers(const SceneReader& reader, const char* key, const SceneDraft& draft);

/// Whose inputs: a player's index, or players.size() + a seat's; complains at `key` if there is
/// neither.
int FindDriver(const SceneReader& reader, const char* key, const std::string& name,
               const SceneDraft& draft);
/// The player whose axis (`axis`, the drive unless said) something follows; -1 without `player`.
int ReadFollowed(const SceneReader& r, const SceneDraft& draft, InputAxis* axis);

/// Whole scenes: what only shows when everything is known (who is welded and joined to whom).
/// Throws OperatorError.
void CheckScene(const Scene& scene, const std::string& file);

/// A part's conveyor: a number or a table.
void ReadConveyor(const SceneReader& r, const SceneDraft& draft, Part* part);
/// [[strand]]. Requires parts and characters.
void ReadStrands(const SceneReader& root, SceneDraft* draft);
/// [[thrust]] and [[propeller]]. Requires parts and players.
void ReadThrusts(const SceneReader& root, SceneDraft* draft);

/// The one of box, circle, capsule, wedge, polygon, chain and segment that the table has.
void ReadShape(const SceneReader& r, float size_max, Part* part);

/// Nobody has to do what the permissions forbid. Throws OperatorError.
void CheckPermissions(const Scene& scene, const std::string& file);

/// Box2D's and our own demands on shapes.
Status ValidatePolygon(const std::vector<Vec2>& points, float size_max);
Status ValidateChain(const std::vector<Vec2>& points);

}  // namespace seam
