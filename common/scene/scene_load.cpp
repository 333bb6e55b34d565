#include <algorithm>
#include <cmath>
#include <fstream>

#include "common/base/check.h"
#include "common/base/files_read.h"
#include "common/base/plain_file.h"
#include "common/scene/expected.h"
#include "common/scene/scene.h"
#include "common/scene/scene_draft.h"
#include "common/scene/scene_limits.h"
#include "common/scene/toml/scene_keys.h"
#include "common/scene/toml/scene_text.h"

namespace seam {
namespace {

std::string SceneName(const std::string& file) {
  std::string name = file.substr(file.find_last_of('/') + 1);
  const std::string ending = ".toml";
  if (name.size() > ending.size() &&
      name.compare(name.size() - ending.size(), ending.size(), ending) == 0) {
    name.resize(name.size() - ending.size());
  }
  return name;
}

void ReadSolver(const SceneReader& root, const std::string& file, Solver* solver) {
  const TomlNode* table = root.Table("solver");
  if (table == nullptr) return;
  const SceneReader r(*table, file, "solver",
                      {"tick_hz", "substeps", "velocity_iterations", "position_iterations", "sleep",
                       "continuous", "warm_starting", "skin", "welds", "faces", "joints",
                       "joint_substeps", "contacts", "contact_substeps"});
  solver->tick_hz = r.Integer("tick_hz", kTickHz, solver->tick_hz);
  solver->substeps =
      std::max(SubstepsMin(solver->tick_hz), r.Integer("substeps", {1, 32}, solver->substeps));
  solver->velocity_iterations =
      r.Integer("velocity_iterations", {1, 64}, solver->velocity_iterations);
  solver->position_iterations =
      r.Integer("position_iterations", {1, 64}, solver->position_iterations);
  solver->sleep = r.Flag("sleep", solver->sleep);
  solver->continuous = r.Flag("continuous", solver->continuous);
  solver->warm_starting = r.Flag("warm_starting", solver->warm_starting);
  const std::string contacts = r.Text("contacts", "engine");
  if (contacts != "engine" && contacts != "soft") {
    r.FailAt("contacts", "contacts must be 'engine' or 'soft'");
  }
  if (contacts == "soft") {
    solver->contacts = ContactSolving::kSoft;
    solver->skin = static_cast<float>(kSkinRange.min);
  }
  solver->contact_substeps = r.Integer("contact_substeps", {1, 16}, solver->contact_substeps);
  if (r.Has("skin")) solver->skin = r.Number("skin", kSkinRange, 0.0f);
  const std::string joints = r.Text("joints", "auto");
  if (joints != "auto" && joints != "exact" && joints != "iterative") {
    r.FailAt("joints", "joints must be 'auto', 'exact' or 'iterative'");
  }
  solver->joints = joints == "auto"    ? JointSolving::kAuto
                   : joints == "exact" ? JointSolving::kExact
                                       : JointSolving::kIterative;
  solver->joint_substeps = r.Integer("joint_substeps", {1, 16}, solver->joint_substeps);
  const std::string welds = r.Text("welds", "body");
  if (welds != "body" && welds != "joint") r.FailAt("welds", "welds must be 'body' or 'joint'");
  solver->weld_joints = welds == "joint";
  const std::string faces = r.Text("faces", "merged");
  if (faces != "merged" && faces != "outer" && faces != "all") {
    r.FailAt("faces", "faces must be 'merged', 'outer' or 'all'");
  }
  solver->faces = faces == "merged"  ? Faces::kMerged
                  : faces == "outer" ? Faces::kOuter
                                     : Faces::kAll;
}

void ReadBounds(const SceneReader& root, Scene* scene) {
  if (!root.Has("bounds")) return;
  const std::vector<Vec2> corners = root.Points("bounds", kCoordinate, 2);
  if (corners.size() != 2) root.FailAt("bounds", "bounds must be [[x, y], [x, y]]");
  scene->bounds_min = corners[0];
  scene->bounds_max = corners[1];
  if ((corners[1] - corners[0]).minCoeff() < 1) {
    root.FailAt("bounds", "bounds must be two corners, the lower left first, 1 m apart or more");
  }
}

void ReadExpected(const SceneReader& root, Scene* scene) {
  Expected expected;
  for (const std::string& text : root.Texts("expect")) {
    bool* happens = text == "contact"     ? &expected.contact
                    : text == "hand-over" ? &expected.hand_over
                    : text == "edit"      ? &expected.edit
                                          : nullptr;
    if (happens == nullptr) {
      root.FailAt("expect", "expect must name 'contact', 'hand-over' or 'edit'");
    }
    *happens = true;
  }
  if (root.Has("expect")) scene->expected.Set(expected);
}

}  // namespace

Scene ParseScene(const std::string& text, const std::string& file_name) {
  CheckSceneText(text, file_name);
  const TomlNode tree = ParseToml(text, file_name);
  SceneDraft draft{file_name, {}, kSizeMaxDefault};
  Scene& scene = draft.scene;
  scene.name = SceneName(file_name);
  scene.text = text;

  const SceneReader root(tree, file_name, "scene", kSceneKeys);
  scene.title = root.Text("title", scene.name);
  scene.gravity = root.Vector("gravity", {-100, 100}, scene.gravity);
  scene.duration_s = root.Seconds("duration", {0.1, 86400}, scene.duration_s);
  scene.server_follow = root.Integer("server_follow", {0, 65535}, scene.server_follow);
  scene.follow_bodies = root.Integer("follow", {0, 65535}, scene.follow_bodies);
  scene.buffer_m = root.Number("buffer", {0, 10000}, scene.buffer_m);
  scene.input_delay_ticks = root.Integer("input_delay", {0, kInputDelayTicksMax}, 0);
  scene.show_age_ticks = root.Integer("show_age", {0, kShowAgeTicksMax}, scene.show_age_ticks);
  scene.speed_limit = root.Number("speed_limit", {1, kSpeedMax}, scene.speed_limit);
  draft.size_max = root.Number("size_max", {kSizeMin, kSizeMaxMax}, kSizeMaxDefault);
  ReadBounds(root, &scene);
  ReadExpected(root, &scene);
  ReadPlanner(root, &draft);
  ReadSolver(root, file_name, &scene.solver);
  ReadPlayerNames(root, &draft);
  ReadSeatNames(root, &draft);
  ReadParts(root, &draft);
  ReadBricks(root, &draft);
  ReadCharacters(root, &draft);
  ReadJoints(root, &draft);
  ReadStrands(root, &draft);
  ReadThrusts(root, &draft);
  ReadWaters(root, &draft);
  ReadGrouping(root, &draft);
  ReadPlayers(root, &draft);
  LimitFollowing(root, &draft);
  ReadSeats(root, &draft);
  ReadTriggers(root, &draft);
  ReadCharges(root, &draft);
  ReadScripts(root, &draft);
  ReadLcm(root, &draft);
  ReadWatch(root, &draft);
  ReadCamera(root, &draft);
  CheckScene(scene, file_name);
  CheckPermissions(scene, file_name);
  return std::move(draft.scene);
}

Scene LoadScene(const std::string& path) {
  NoteFileRead(path);
  // One byte more than allowed, so that a huge file is refused without being read.
  return ParseScene(ReadPlainFile(path, kSceneBytesMax + 1, "no such scene file"), path);
}

}  // namespace seam
