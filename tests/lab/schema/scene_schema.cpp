#include "tests/lab/schema/scene_schema.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <optional>
#include <set>

#include "common/base/check.h"
#include "common/base/find_scene.h"
#include "common/base/json_text.h"
#include "common/scene/scene.h"
#include "common/scene/toml/read_watch.h"

namespace seam {
namespace {

/// The types of a key, each with the union of its ranges.
using Types = std::map<ReadAs, Range>;
/// The keys of a table.
using Keys = std::map<std::string, Types>;

/// Tables that few scenes have, so that their keys are known with any scene.
constexpr const char* kRareTables = R"(
[planner]
[[player]]
name = "ann"
[[part]]
name = "a"
circle = 1
health = 1
damage = {}
permissions = {}
[[part]]
name = "b"
circle = 1
position = [5, 0]
[[joint]]
name = "servo"
kind = "motor"
a = "a"
b = "b"
force = 1
torque = 1
follow = {player = "ann", axis = "lift", reach = [0, 1]}
[[character]]
name = "c"
position = [20, 0]
torque = {}
[[lcm.publish]]
channel = "A"
parts = "a"
[[lcm.drive]]
channel = "B"
player = "ann"
[[lcm.message]]
channel = "C"
[[script]]
name = "s"
code = "function on_message() end"
)";

/// Notes tables by their path in the file: "", "part", "part.repeat".
class SchemaWatch : public ReadWatch {
 public:
  SchemaWatch() { WatchReads(this); }
  ~SchemaWatch() override { WatchReads(nullptr); }
  SchemaWatch(const SchemaWatch&) = delete;
  SchemaWatch& operator=(const SchemaWatch&) = delete;

  void OnTable(const TomlNode& table, const std::string& what,
               const std::vector<std::string>& keys) override {
    if (what == "scene") {
      paths_.clear();
      Walk(table, "");
    }
    const auto path = paths_.find(&table);
    if (path == paths_.end()) return;
    for (const std::string& key : keys) tables_[path->second][key];
  }
  void OnKey(const TomlNode& table, const std::string& key, ReadAs as, Range range) override {
    const auto path = paths_.find(&table);
    if (path == paths_.end()) return;
    const auto [at, first] = tables_[path->second][key].emplace(as, range);
    if (first) return;
    at->second.min = std::min(at->second.min, range.min);
    at->second.max = std::max(at->second.max, range.max);
  }
  const std::map<std::string, Keys>& tables() const { return tables_; }

 private:
  void Walk(const TomlNode& node, const std::string& path) {
    paths_[&node] = path;
    for (const auto& [key, member] : node.members) {
      const std::string below = path.empty() ? key : path + "." + key;
      if (member.kind == TomlNode::Kind::kTable) Walk(member, below);
      for (const TomlNode& item : member.items) {
        if (item.kind == TomlNode::Kind::kTable) Walk(item, below);
      }
    }
  }

  std::map<const TomlNode*, std::string> paths_;
  std::map<std::string, Keys> tables_;
};

std::string NumberSchema(const char* type, Range range) {
  return "{\"type\":\"" + std::string(type) + "\",\"minimum\":" + JsonNumber(range.min) +
         ",\"maximum\":" + JsonNumber(range.max) + "}";
}

std::string ArraySchema(const std::string& items, const char* more = "") {
  return "{\"type\":\"array\",\"items\":" + items + more + "}";
}

/// Returns the schema of one type. `table`: of the tables that may be there, or "{}".
std::string TypeSchema(ReadAs as, Range range, const std::string& table) {
  const std::string text = "{\"type\":\"string\"}";
  const auto vector = [&] {
    return ArraySchema(NumberSchema("number", range), ",\"minItems\":2,\"maxItems\":2");
  };
  switch (as) {
    case ReadAs::kNumber: return NumberSchema("number", range);
    case ReadAs::kInteger: return NumberSchema("integer", range);
    case ReadAs::kFlag: return "{\"type\":\"boolean\"}";
    case ReadAs::kText: return text;
    case ReadAs::kVector: return vector();
    case ReadAs::kPoints: return ArraySchema(vector());
    case ReadAs::kTexts: return "{\"anyOf\":[" + text + "," + ArraySchema(text) + "]}";
    case ReadAs::kItems: return ArraySchema("{}");
    case ReadAs::kTables: return ArraySchema(table);
    case ReadAs::kTable: return table;
  }
  return "{}";
}

/// Returns the schema of a key. An array that is also read in a known form has that form.
std::string KeySchema(Types types, const std::string& table) {
  const bool array =
      types.count(ReadAs::kPoints) + types.count(ReadAs::kTexts) + types.count(ReadAs::kTables) > 0;
  if (array) types.erase(ReadAs::kItems);
  if (types.empty()) return "{}";
  std::vector<std::string> each;
  for (const auto& [as, range] : types) each.push_back(TypeSchema(as, range, table));
  return each.size() == 1 ? each.front() : "{\"anyOf\":" + JsonList(each) + "}";
}

std::string TableSchema(const std::map<std::string, Keys>& tables, const std::string& path) {
  std::vector<std::string> keys;
  for (const auto& [key, types] : tables.at(path)) {
    const std::string below = path.empty() ? key : path + "." + key;
    const std::string table = tables.count(below) == 0
                                  ? "{\"type\":\"object\"}"
                                  : "{\"$ref\":" + JsonText("#/definitions/" + below) + "}";
    keys.push_back("\n   " + JsonText(key) + ":" + KeySchema(types, table));
  }
  std::string text = "{\"type\":\"object\",\"additionalProperties\":false,\"properties\":{";
  for (const std::string& key : keys) text += (&key == &keys.front() ? "" : ",") + key;
  return text + "}}";
}

}  // namespace

std::string SceneSchema(const std::vector<std::string>& scene_files) {
  SchemaWatch watch;
  ParseScene(kRareTables, "rare-tables.toml");
  for (const std::string& file : scene_files) LoadScene(file);
  const auto& tables = watch.tables();
  if (scene_files.empty()) throw OperatorError("which scenes? none is found by name here");
  std::string text = TableSchema(tables, "");
  text.erase(0, 1);  // its bracket: more keys come first
  std::string definitions;
  for (const auto& [path, keys] : tables) {
    if (path.empty()) continue;
    definitions +=
        (definitions.empty() ? "\n  " : ",\n  ") + JsonText(path) + ":" + TableSchema(tables, path);
  }
  return "{\"$schema\":\"http://json-schema.org/draft-07/schema#\",\"title\":\"a scene of "
         "Seam2D\",\n \"definitions\":{" +
         definitions + "},\n " + text + "\n";
}

int PrintSchema(const std::vector<std::string>& scenes) {
  std::vector<std::string> files;
  for (const std::string& word : scenes.empty() ? SceneNames() : scenes) {
    files.push_back(FindScene(word));
  }
  std::fputs(SceneSchema(files).c_str(), stdout);
  return 0;
}

}  // namespace seam
