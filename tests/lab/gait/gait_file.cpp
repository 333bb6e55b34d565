#include "tests/lab/gait/gait_file.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/base/names.h"
#include "common/base/plain_file.h"
#include "common/scene/toml/scene_reader.h"
#include "common/scene/toml/scene_text.h"
#include "common/stages/character/character_gains.h"
#include "tests/lab/gait/ability.h"

namespace seam {
namespace {

constexpr int kStartMax = 1000000, kCountMax = 10000;

StartRange Starts(const SceneReader& file, const std::string& path, const char* key) {
  const TomlNode* node = file.Table(key);
  if (node == nullptr) {
    file.Fail(fmt::format("which starts? for example: {} = {{from = 1, count = 24}}", key));
  }
  const SceneReader r(*node, path, key, {"from", "count"});
  StartRange range;
  range.from = r.Integer("from", {1, kStartMax});
  range.count = r.Integer("count", {1, kCountMax});
  return range;
}

std::string KnownAbility(const SceneReader& r) {
  const std::string ability = r.Text("ability");
  if (FindAbility(ability) == nullptr) {
    std::string known;
    for (const Ability& each : Abilities()) known += (known.empty() ? "" : ", ") + each.name;
    r.FailAt("ability", fmt::format("no ability '{}' (there are {})", ability, known));
  }
  return ability;
}

AlsoTrained Also(const TomlNode& node, const std::string& path) {
  const SceneReader r(node, path, "also", {"ability", "train", "weight"});
  AlsoTrained also;
  also.ability = KnownAbility(r);
  also.train = Starts(r, path, "train");
  also.weight = r.Seconds("weight", {0, 1000}, 1.0);
  return also;
}

SearchedGain Gain(const TomlNode& node, const std::string& path) {
  const SceneReader r(node, path, "gain", {"name", "start", "sigma", "min", "max"});
  SearchedGain gain;
  gain.name = r.Text("name");
  CharacterGains built_in;
  const float* value = FindGain(&built_in, gain.name);
  if (value == nullptr) {
    r.FailAt("name", fmt::format("there is no gain '{}'; see character_gains.inc", gain.name));
  }
  gain.min = r.Seconds("min", {-1e6, 1e6});
  gain.max = r.Seconds("max", {-1e6, 1e6});
  if (!(gain.min < gain.max)) r.FailAt("max", "max must be above min");
  gain.start = r.Seconds("start", {gain.min, gain.max}, double{*value});
  if (gain.start < gain.min || gain.start > gain.max) {
    r.Fail(fmt::format("{} is built in as {}, outside of its bounds", gain.name, *value));
  }
  gain.sigma = r.Seconds("sigma", {1e-9, gain.max - gain.min});
  return gain;
}

}  // namespace

GaitFile ReadGaitFile(const std::string& path) {
  const std::string text = ReadPlainFile(path, 1 << 20);
  CheckSceneText(text, path);
  const TomlNode tree = ParseToml(text, path);
  const SceneReader r(tree, path, "objective",
                      {"ability", "train", "held_out", "solver", "character", "lambda",
                       "generations", "seed", "also", "gain"});
  GaitFile file;
  file.ability = KnownAbility(r);
  file.train = Starts(r, path, "train");
  file.held_out = Starts(r, path, "held_out");
  const bool apart = file.train.from + file.train.count <= file.held_out.from ||
                     file.held_out.from + file.held_out.count <= file.train.from;
  if (!apart) r.FailAt("held_out", "a start that is trained on is not held out");
  if (r.Has("solver")) file.solver = r.Code("solver");
  if (r.Has("character")) file.character = r.Code("character");
  file.lambda = r.Integer("lambda", {2, 1000}, file.lambda);
  file.generations = r.Integer("generations", {1, 100000}, file.generations);
  file.seed = r.Integer("seed", {0, kStartMax}, file.seed);
  for (const TomlNode* node : r.Tables("also")) file.also.push_back(Also(*node, path));
  for (const TomlNode* node : r.Tables("gain")) {
    file.gains.push_back(Gain(*node, path));
    const auto same = std::count_if(file.gains.begin(), file.gains.end(), [&](const auto& g) {
      return g.name == file.gains.back().name;
    });
    if (same > 1) r.Fail(fmt::format("gain '{}' stands there twice", file.gains.back().name));
  }
  if (file.gains.empty()) r.Fail("which gains? each is a [[gain]]");
  return file;
}

}  // namespace seam
