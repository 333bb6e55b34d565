#pragma once
/// The sections of a scene file, one function each; ParseScene calls them in this order.

#include <map>
#include <string>
#include <vector>

#include "common/physics/scene.h"
#include "common/physics/scene_reader.h"

namespace seam {

/// A scene that is being read.
struct SceneDraft {
  const std::string& file;
  Scene scene;
  float size_max = 10;                                 ///< m
  std::map<std::string, PartId> part_of_name;
  std::map<std::string, std::vector<PartId>> group_of_name;  ///< what `repeat` made of a name
};

/// `repeat = {count, step}`: how often a part or joint is copied, and where each copy goes.
struct Repeat {
  int columns = 1, rows = 1;
  bool grid = false;                ///< names get two numbers
  Vec2 step{0, 0};                  ///< m; grid: x per column, y per row; else per copy

  Vec2 Offset(int column, int row) const;
  /// ".3", or in a grid ".3.1".
  std::string Suffix(int column, int row) const;
};
Repeat ReadRepeat(const SceneReader& owner, const std::string& file);

/// [[player]]: only names, so that parts and joints can refer to them.
void ReadPlayerNames(const SceneReader& root, SceneDraft* draft);
/// [[part]], repetitions written out.
void ReadParts(const SceneReader& root, SceneDraft* draft);
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
/// [[watch]]. Requires parts.
void ReadWatch(const SceneReader& root, SceneDraft* draft);
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

/// Whole scenes: what only shows when everything is known (who is welded and joined to whom).
/// Throws OperatorError.
void CheckScene(const Scene& scene, const std::string& file);

/// The one of box, circle, capsule, wedge, polygon, chain and segment that the table has.
void ReadShape(const SceneReader& r, float size_max, Part* part);

/// Box2D's and our own demands on shapes; empty when they are met.
std::string PolygonComplaint(const std::vector<Vec2>& points, float size_max);
std::string ChainComplaint(const std::vector<Vec2>& points);

}  // namespace seam
