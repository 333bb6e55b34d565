#include "common/scene/toml/scene_reader.h"

#include <algorithm>
#include <cstdio>

#include "common/base/check.h"
#include "common/base/names.h"
#include "common/base/nearest.h"
#include "common/scene/toml/read_watch.h"
#include "common/scene/toml/scene_keys.h"
#include "common/scene/toml/scene_text.h"

namespace seam {
namespace {

thread_local ReadWatch* g_watch = nullptr;

void Note(const TomlNode& table, const char* key, ReadAs as, Range range = {}) {
  if (g_watch != nullptr) g_watch->OnKey(table, key, as, range);
}

std::string Suggested(const std::string& key, std::initializer_list<const char*> keys) {
  return Suggestion(key, {keys.begin(), keys.end()}, keys.size());
}

}  // namespace

void WatchReads(ReadWatch* watch) { g_watch = watch; }

std::string Decimal(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.7g", value);
  return text;
}

SceneReader::SceneReader(const TomlNode& table, const std::string& file, std::string what,
                         std::initializer_list<const char*> keys)
    : table_(table), file_(file), what_(std::move(what)) {
  if (table.kind != TomlNode::Kind::kTable) {
    FailLine(table.line, std::string("must be a table, not ") + KindName(table.kind));
  }
  if (g_watch != nullptr) g_watch->OnTable(table, what_, {keys.begin(), keys.end()});
  for (const auto& [key, node] : table.members) {
    const std::string& name = key;
    const auto same = [&name](const char* known) { return name == known; };
    if (std::any_of(keys.begin(), keys.end(), same)) continue;
    const std::string shown = Printable(key);
    const bool of_file = std::any_of(kSceneKeys.begin(), kSceneKeys.end(),
                                     [&](const char* top) { return key == top; });
    FailLine(node.line, "unknown key '" + shown + "'" +
                            (of_file ? ": it belongs above the first table"
                                     : " (" + Suggested(shown, keys) + ")"));
  }
}

void SceneReader::FailLine(int line, const std::string& complaint) const {
  throw OperatorError(file_ + ":" + std::to_string(std::max(line, 1)) + ": " + what_ + ": " +
                      complaint);
}

void SceneReader::Fail(const std::string& complaint) const { FailLine(table_.line, complaint); }

void SceneReader::FailAt(const char* key, const std::string& complaint) const {
  FailLine(LineOf(key), complaint);
}

void SceneReader::Expected(const TomlNode& node, const char* key, const std::string& what) const {
  std::string got = KindName(node.kind);
  if (node.kind == TomlNode::Kind::kInteger || node.kind == TomlNode::Kind::kNumber) {
    got = Decimal(node.number);
  } else if (node.kind == TomlNode::Kind::kArray) {
    got += " of " + std::to_string(node.items.size());
  }
  FailLine(node.line, std::string(key) + " must be " + what + ", not " + got);
}

int SceneReader::LineOf(const char* key) const {
  const TomlNode* node = table_.Find(key);
  return node != nullptr ? node->line : table_.line;
}

const TomlNode* SceneReader::Get(const char* key, bool required) const {
  const TomlNode* node = table_.Find(key);
  if (node == nullptr && required) Fail(std::string(key) + " is missing");
  return node;
}

double SceneReader::NumberIn(const TomlNode& node, const char* key, Range range) const {
  const bool is_number =
      node.kind == TomlNode::Kind::kInteger || node.kind == TomlNode::Kind::kNumber;
  // Compared in single precision, as the limits are: 0.05 is not below 0.05f. NaN fails.
  const auto value = static_cast<float>(node.number);
  const bool inside =
      value >= static_cast<float>(range.min) && value <= static_cast<float>(range.max);
  if (!is_number || !inside) {
    const bool degrees = is_number && range.radians;
    Expected(node, key,
             "a number from " + Decimal(range.min) + " to " + Decimal(range.max) +
                 (degrees ? " (in radians: 180 degrees are 3.1416)" : ""));
  }
  return node.number;
}

Vec2 SceneReader::VectorIn(const TomlNode& node, const char* key, Range range) const {
  if (node.kind != TomlNode::Kind::kArray || node.items.size() != 2) {
    Expected(node, key, "two numbers [x, y]");
  }
  return {static_cast<float>(NumberIn(node.items[0], key, range)),
          static_cast<float>(NumberIn(node.items[1], key, range))};
}

float SceneReader::Number(const char* key, Range range, std::optional<float> fallback) const {
  Note(table_, key, ReadAs::kNumber, range);
  const TomlNode* node = Get(key, !fallback);
  return node == nullptr ? *fallback : static_cast<float>(NumberIn(*node, key, range));
}

double SceneReader::Seconds(const char* key, Range range, std::optional<double> fallback) const {
  Note(table_, key, ReadAs::kNumber, range);
  const TomlNode* node = Get(key, !fallback);
  return node == nullptr ? *fallback : NumberIn(*node, key, range);
}

int SceneReader::Integer(const char* key, Range range, std::optional<int> fallback) const {
  Note(table_, key, ReadAs::kInteger, range);
  const TomlNode* node = Get(key, !fallback);
  if (node == nullptr) return *fallback;
  if (node->kind != TomlNode::Kind::kInteger || !(node->number >= range.min) ||
      !(node->number <= range.max)) {
    Expected(*node, key, "an integer from " + Decimal(range.min) + " to " + Decimal(range.max));
  }
  return static_cast<int>(node->integer);
}

bool SceneReader::Flag(const char* key, bool fallback) const {
  Note(table_, key, ReadAs::kFlag);
  const TomlNode* node = Get(key, false);
  if (node == nullptr) return fallback;
  if (node->kind != TomlNode::Kind::kBoolean) Expected(*node, key, "true or false");
  return node->boolean;
}

std::string SceneReader::Text(const char* key, std::optional<std::string> fallback) const {
  Note(table_, key, ReadAs::kText);
  const TomlNode* node = Get(key, !fallback);
  if (node == nullptr) return *fallback;
  if (node->kind != TomlNode::Kind::kText) Expected(*node, key, "text");
  if (node->text.size() > 200) FailAt(key, std::string(key) + " is longer than 200 bytes");
  if (!IsCleanText(node->text, "")) FailAt(key, std::string(key) + " has a control character");
  return node->text;
}

std::string SceneReader::Code(const char* key) const {
  Note(table_, key, ReadAs::kText);
  const TomlNode* node = Get(key, true);
  if (node->kind != TomlNode::Kind::kText) Expected(*node, key, "text");
  if (!IsCleanText(node->text, "\n\r\t")) {
    FailAt(key, std::string(key) + " has a control character");
  }
  return node->text;
}

bool SceneReader::IsText(const char* key) const {
  const TomlNode* node = table_.Find(key);
  return node != nullptr && node->kind == TomlNode::Kind::kText;
}

std::string SceneReader::Name(const char* key) const {
  const std::string name = Text(key);
  if (!IsName(name) || name[0] == '_' || name[0] == '-') {
    FailAt(key, std::string(key) + " '" + Printable(name) +
                    "' must be 1 to 32 letters, digits, '_' or '-', a letter or digit first");
  }
  return name;
}

Vec2 SceneReader::Vector(const char* key, Range range, std::optional<Vec2> fallback) const {
  Note(table_, key, ReadAs::kVector, range);
  const TomlNode* node = Get(key, !fallback);
  return node == nullptr ? *fallback : VectorIn(*node, key, range);
}

std::vector<Vec2> SceneReader::Points(const char* key, Range range, std::size_t count_max) const {
  Note(table_, key, ReadAs::kPoints, range);
  std::vector<Vec2> points;
  for (const TomlNode& item : Items(key)) {
    if (points.size() == count_max) {
      FailAt(key, std::string(key) + " has more than " + std::to_string(count_max) + " points");
    }
    points.push_back(VectorIn(item, key, range));
  }
  return points;
}

std::vector<std::string> SceneReader::Texts(const char* key) const {
  Note(table_, key, ReadAs::kTexts);
  std::vector<std::string> texts;
  const TomlNode* node = Get(key, false);
  if (node == nullptr) return texts;
  if (node->kind == TomlNode::Kind::kText) return {node->text};
  for (const TomlNode& item : Items(key)) {
    if (item.kind != TomlNode::Kind::kText) Expected(item, key, "names");
    texts.push_back(item.text);
  }
  return texts;
}

std::vector<const TomlNode*> SceneReader::Tables(const char* key) const {
  Note(table_, key, ReadAs::kTables);
  std::vector<const TomlNode*> tables;
  if (IsTable(key)) {
    const std::string name = key;
    FailAt(key, name + " needs two brackets, [[" + name + "]]: there may be several");
  }
  for (const TomlNode& item : Items(key)) {
    if (item.kind != TomlNode::Kind::kTable) Expected(item, key, "tables");
    tables.push_back(&item);
  }
  return tables;
}

const std::vector<TomlNode>& SceneReader::Items(const char* key) const {
  Note(table_, key, ReadAs::kItems);
  static const std::vector<TomlNode> kNone;
  const TomlNode* node = Get(key, false);
  if (node == nullptr) return kNone;
  if (node->kind != TomlNode::Kind::kArray) Expected(*node, key, "an array");
  return node->items;
}

bool SceneReader::IsTable(const char* key) const {
  const TomlNode* node = Get(key, false);
  return node != nullptr && node->kind == TomlNode::Kind::kTable;
}

const TomlNode* SceneReader::Table(const char* key) const {
  Note(table_, key, ReadAs::kTable);
  const TomlNode* node = Get(key, false);
  if (node != nullptr && node->kind != TomlNode::Kind::kTable) Expected(*node, key, "a table");
  return node;
}

}  // namespace seam
