#include "tests/lab/sweep_file.h"

#include <fmt/format.h>

#include <sstream>

#include "common/base/check.h"
#include "common/base/files_read.h"
#include "common/base/find_scene.h"
#include "common/base/plain_file.h"
#include "common/scene/toml/scene_reader.h"
#include "common/scene/toml/scene_text.h"
#include "tests/lab/grid.h"
#include "tests/lab/scene_settings.h"

namespace seam {
namespace {

/// Lists that set a scene's key, in the order in which they vary, the slowest first.
struct ScenesKey {
  const char* list;  // in the sweep file
  const char* key;   // in the scene, which checks the range
};
constexpr ScenesKey kScenesKeys[] = {{"tick_hz", "solver.tick_hz"},
                                     {"substeps", "solver.substeps"},
                                     {"velocity_iterations", "solver.velocity_iterations"},
                                     {"position_iterations", "solver.position_iterations"},
                                     {"skin", "solver.skin"},
                                     {"buffer_m", "buffer"},
                                     {"input_delay", "input_delay"}};

std::string ReadText(const std::string& path) {
  NoteFileRead(path);
  return ReadPlainFile(path, kSceneBytesMax + 1);
}

std::vector<std::string> Texts(const SceneReader& r, const char* key, const char* fallback) {
  std::vector<std::string> texts = r.Texts(key);
  if (r.Has(key) && texts.empty()) r.FailAt(key, std::string(key) + " is empty");
  for (const std::string& text : texts) {  // each becomes part of a line
    if (!IsCleanText(text, "")) r.FailAt(key, std::string(key) + " has a control character");
  }
  if (texts.empty() && fallback != nullptr) texts.push_back(fallback);
  return texts;
}

std::vector<std::int64_t> Integers(const SceneReader& r, const char* key, std::int64_t min,
                                   std::int64_t max) {
  std::vector<std::int64_t> numbers;
  for (const TomlNode& item : r.Items(key)) {
    if (item.kind != TomlNode::Kind::kInteger || item.integer < min || item.integer > max) {
      r.FailAt(key, fmt::format("{} takes integers from {} to {}", key, min, max));
    }
    numbers.push_back(item.integer);
  }
  if (r.Has(key) && numbers.empty()) r.FailAt(key, std::string(key) + " is empty");
  return numbers;
}

/// The shortest decimal of each number of a list: "5", "0.25".
std::vector<std::string> DecimalTexts(const SceneReader& r, const char* key, double min,
                                      double max) {
  std::vector<std::string> decimals;
  for (const TomlNode& item : r.Items(key)) {
    const bool number =
        item.kind == TomlNode::Kind::kInteger || item.kind == TomlNode::Kind::kNumber;
    if (!number || !(item.number >= min && item.number <= max)) {
      r.FailAt(key, fmt::format("{} takes numbers from {} to {}", key, min, max));
    }
    decimals.push_back(item.kind == TomlNode::Kind::kInteger ? std::to_string(item.integer)
                                                             : fmt::format("{}", item.number));
  }
  if (r.Has(key) && decimals.empty()) r.FailAt(key, std::string(key) + " is empty");
  return decimals;
}

/// [1, 2, 5], or {from = 1, count = 100}.
std::vector<std::int64_t> Seeds(const SceneReader& r, const TomlNode& tree,
                                const std::string& file) {
  const TomlNode* seeds = tree.Find("seeds");
  if (seeds == nullptr) return {1};
  if (seeds->kind != TomlNode::Kind::kTable) return Integers(r, "seeds", 0, kSeedMax);
  const SceneReader range(*seeds, file, "seeds", {"from", "count"});
  const double most = static_cast<double>(kGridPointsMax);
  const int from = range.Integer("from", {0, static_cast<double>(kSeedMax) - most}, 1);
  const int count = range.Integer("count", {1, most});
  std::vector<std::int64_t> numbers;
  for (int i = 0; i < count; ++i) numbers.push_back(from + i);
  return numbers;
}

/// Each of `texts` with each of `values` put behind it, `between` them where both say something.
std::vector<std::string> Combined(const std::vector<std::string>& texts, const std::string& before,
                                  const std::vector<std::string>& values, const char* after,
                                  const char* between) {
  if (values.empty()) return texts;
  std::vector<std::string> combined;
  for (const std::string& text : texts) {
    for (const std::string& value : values) {
      combined.push_back(text + (text.empty() ? "" : between) + before + value + after);
    }
  }
  return combined;
}

std::vector<std::vector<std::string>> Settings(const SceneReader& r) {
  std::vector<std::string> all = Texts(r, "set", "");
  for (const ScenesKey& k : kScenesKeys) {
    const std::string before = std::string(k.key) + "=";
    all = Combined(all, before, DecimalTexts(r, k.list, 0, 1e6), "", ";");
    if (all.size() > kGridScenesMax) r.FailAt(k.list, "these are too many different scenes");
  }
  std::vector<std::vector<std::string>> settings;
  for (const std::string& each : all) settings.push_back(SplitSettings(each));
  return settings;
}

/// Whether a list of impairments says something about `key`.
bool Says(const std::string& impair, const std::string& key) {
  return ("," + impair).find("," + key + "=") != std::string::npos;
}

/// Every profile, with every delay, jitter and loss if there are any.
std::vector<std::string> Networks(const SceneReader& r) {
  const std::vector<std::string> delays = DecimalTexts(r, "one_way_ms", 0, 60000);
  const std::vector<std::string> jitters = DecimalTexts(r, "jitter_ms", 0, 60000);
  const std::vector<std::string> losses = DecimalTexts(r, "loss_percent", 0, 100);
  const bool composed = !delays.empty() || !jitters.empty() || !losses.empty();
  const std::vector<std::string> given = Texts(r, "impair", composed ? "perfect" : "demo");
  if (!composed) return given;
  std::vector<std::string> networks;
  for (const std::string& impair : given) {
    const bool list = impair.find('=') != std::string::npos;
    const bool twice = (!delays.empty() && Says(impair, "delay")) ||
                       (!jitters.empty() && Says(impair, "jitter")) ||
                       (!losses.empty() && (Says(impair, "loss") || Says(impair, "burst")));
    if (twice || (!list && impair != "perfect")) {
      r.FailAt("impair",
               "one_way_ms, jitter_ms and loss_percent go with \"perfect\" and with "
               "lists that do not say the same, not with \"" +
                   impair + "\"");
    }
    std::vector<std::string> these = Combined({""}, "delay=", delays, "ms", ",");
    these = Combined(these, "jitter=", jitters, "ms", ",");
    these = Combined(these, "loss=", losses, "%", ",");
    for (const std::string& network : these) {
      networks.push_back(list ? network + "," + impair : network);
    }
  }
  return networks;
}

}  // namespace

SweepFile ReadSweepFile(const std::string& path) {
  const std::string text = ReadText(path);
  CheckSceneText(text, path);
  const TomlNode tree = ParseToml(text, path);
  const SceneReader r(tree, path, "sweep",
                      {"scenes", "set",        "tick_hz",     "substeps", "velocity_iterations",
                       "skin",   "buffer_m",   "input_delay", "methods",  "position_iterations",
                       "impair", "one_way_ms", "jitter_ms",   "send_hz",  "loss_percent",
                       "drive",  "smooth",     "duration",    "seeds",    "floor",
                       "limit",  "show_age"});
  SweepFile file;
  file.scenes = Texts(r, "scenes", nullptr);
  for (std::string& scene : file.scenes) scene = FindScene(scene);
  if (file.scenes.empty()) r.Fail("which scenes? for example: scenes = [\"scenes/wall.toml\"]");
  file.settings = Settings(r);
  file.methods = Texts(r, "methods", "buffer");
  file.networks = Networks(r);
  file.send_hz = Integers(r, "send_hz", 1, kSendHzMax);
  if (file.send_hz.empty()) file.send_hz.push_back(30);
  file.drive = Texts(r, "drive", "script");
  file.smooth = Texts(r, "smooth", "on");
  for (const std::string& smooth : file.smooth) {
    try {
      ParseSmoothRate(smooth);
    } catch (const OperatorError& error) {
      r.FailAt("smooth", error.what());
    }
  }
  file.seeds = Seeds(r, tree, path);
  file.duration_s = r.Seconds("duration", {0, kDurationMax}, 0.0);
  file.show_age = r.Integer("show_age", {-1, kShowAgeTicksMax}, -1);
  file.floor = r.Flag("floor", true);
  file.limit = r.Flag("limit", false);
  return file;
}

}  // namespace seam
