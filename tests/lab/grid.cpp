#include "tests/lab/grid.h"

#include <fmt/format.h>

#include <fstream>
#include <set>
#include <sstream>

#include "common/base/bytes.h"
#include "common/base/check.h"
#include "common/physics/scene_reader.h"
#include "common/physics/scene_text.h"

namespace seam {
namespace {

/// What the file says, each list in its order.
struct Lists {
  std::vector<std::shared_ptr<const Scene>> scenes;
  std::vector<std::string> scene_paths;
  std::vector<std::string> methods, impair, drive, smooth;
  std::vector<std::int64_t> one_way_ms, send_hz, seeds;
  double duration_s = 0;
  bool floor = true;
};

std::string ReadText(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf())) throw OperatorError(path + ": cannot be read");
  return text.str();
}

std::vector<std::string> Texts(const SceneReader& r, const char* key, const char* fallback) {
  std::vector<std::string> texts = r.Texts(key);
  if (r.Has(key) && texts.empty()) r.FailAt(key, std::string(key) + " is empty");
  for (const std::string& text : texts) {   // each becomes part of a line
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

Lists ReadLists(const std::string& path) {
  const std::string text = ReadText(path);
  CheckSceneText(text, path);
  const TomlNode tree = ParseToml(text, path);
  const SceneReader r(tree, path, "sweep",
                      {"scenes", "methods", "impair", "one_way_ms", "send_hz", "drive", "smooth",
                       "duration", "seeds", "floor"});
  Lists lists;
  lists.scene_paths = Texts(r, "scenes", nullptr);
  if (lists.scene_paths.empty()) {
    r.Fail("which scenes? for example: scenes = [\"scenes/wall.toml\"]");
  }
  for (const std::string& scene : lists.scene_paths) {
    lists.scenes.push_back(std::make_shared<Scene>(LoadScene(scene)));
  }
  lists.methods = Texts(r, "methods", "buffer");
  lists.impair = Texts(r, "impair", r.Has("one_way_ms") ? "perfect" : "demo");
  lists.one_way_ms = Integers(r, "one_way_ms", 0, 60000);
  lists.send_hz = Integers(r, "send_hz", 1, kSendHzMax);
  if (lists.send_hz.empty()) lists.send_hz.push_back(30);
  lists.drive = Texts(r, "drive", "script");
  lists.smooth = Texts(r, "smooth", "on");
  for (const std::string& smooth : lists.smooth) {
    if (smooth != "on" && smooth != "off") r.FailAt("smooth", "smooth takes \"on\" and \"off\"");
  }
  lists.seeds = Seeds(r, tree, path);
  lists.duration_s = r.Seconds("duration", {0, kDurationMax}, 0.0);
  lists.floor = r.Flag("floor", true);
  return lists;
}

/// Every profile, with every delay if there are any.
std::vector<std::string> Networks(const Lists& lists, const std::string& path) {
  if (lists.one_way_ms.empty()) return lists.impair;
  std::vector<std::string> networks;
  for (const std::string& impair : lists.impair) {
    const bool list = impair.find('=') != std::string::npos;
    if (impair != "perfect" && (!list || ("," + impair).find(",delay=") != std::string::npos)) {
      throw OperatorError(path + ": one_way_ms goes with \"perfect\" and with lists without " +
                          "delay=, not with \"" + impair + "\"");
    }
    for (const std::int64_t ms : lists.one_way_ms) {
      networks.push_back(fmt::format("delay={}ms{}", ms, list ? "," + impair : ""));
    }
  }
  return networks;
}

std::string Key(const GridPoint& point) {
  const SessionSettings& s = point.settings;
  const std::string& text = point.scene->text;
  return fmt::format("{},{},{:016x},{},{},{},{},{},{},{},{}", kLabVersion, CsvField(s.scene),
                     Fnv1a(text.data(), text.size()), s.mode, s.reconcile, CsvField(s.impair),
                     s.send_hz, s.drive, s.smooth ? "on" : "off", s.duration_s, s.seed);
}

/// Mode and reconciler from "buffer/fade" or "strict", the rule by its full name.
void SetMethod(const std::string& method, SessionSettings* settings) {
  const std::size_t slash = method.find('/');
  settings->mode = method.substr(0, slash);
  const std::string rule = slash == std::string::npos ? "" : method.substr(slash + 1);
  settings->reconcile = MakeSyncConfig(settings->mode, rule).reconcile_name;
}

/// All combinations for one scene and method, appended.
void AddPoints(const Lists& lists, const std::vector<std::string>& networks, GridPoint point,
               std::vector<GridPoint>* points) {
  SessionSettings& s = point.settings;
  for (const std::string& network : networks) {
    for (const std::int64_t send_hz : lists.send_hz) {
      for (const std::string& drive : lists.drive) {
        for (const std::string& smooth : lists.smooth) {
          s.impair = network;
          s.send_hz = static_cast<int>(send_hz);
          s.drive = drive;
          s.smooth = smooth == "on";
          s.seed = lists.seeds.front();
          Configure(s, *point.scene);   // throws what is wrong with it
          for (const std::int64_t seed : lists.seeds) {
            s.seed = seed;
            point.key = Key(point);
            points->push_back(point);
          }
        }
      }
    }
  }
}

}  // namespace

std::string CsvField(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

std::string GridHeader() {
  return "version,scene,scene_hash,mode,reconcile,impair,send_hz,drive,smooth,duration_s,seed";
}

Grid ReadGrid(const std::string& path) {
  const Lists lists = ReadLists(path);
  const std::vector<std::string> networks = Networks(lists, path);
  const double size = static_cast<double>(lists.scenes.size() * lists.methods.size()) *
                      static_cast<double>(networks.size() * lists.send_hz.size()) *
                      static_cast<double>(lists.drive.size() * lists.smooth.size()) *
                      static_cast<double>(lists.seeds.size());
  if (size > static_cast<double>(kGridPointsMax)) {
    throw OperatorError(
        fmt::format("{}: {:.0f} runs are more than {}", path, size, kGridPointsMax));
  }
  Grid grid;
  grid.floor = lists.floor;
  for (std::size_t i = 0; i < lists.scenes.size(); ++i) {
    GridPoint point;
    point.scene = lists.scenes[i];
    point.settings.scene = lists.scene_paths[i];
    const bool own = lists.duration_s == 0;
    point.settings.duration_s = own ? point.scene->duration_s : lists.duration_s;
    for (const std::string& method : lists.methods) {
      SetMethod(method, &point.settings);
      AddPoints(lists, networks, point, &grid.points);
    }
  }
  std::set<std::string> keys;
  for (const GridPoint& point : grid.points) {
    if (!keys.insert(point.key).second) {
      throw OperatorError(path + ": the same run twice: " + point.key);
    }
  }
  return grid;
}

}  // namespace seam
