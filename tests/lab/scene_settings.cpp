#include "tests/lab/scene_settings.h"

#include <algorithm>
#include <set>

#include "common/base/check.h"
#include "common/scene/toml/scene_text.h"
#include "common/scene/toml/toml_tree.h"

namespace seam {
namespace {

struct Setting {
  std::string table;  // "" : the scene itself
  std::string key, value;
};

[[noreturn]] void Refuse(const std::string& text, const std::string& why) {
  throw OperatorError("setting \"" + Printable(text) + "\": " + why);
}

std::string Trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

bool IsWord(const std::string& text) {
  return !text.empty() &&
         text.find_first_not_of("abcdefghijklmnopqrstuvwxyz_") == std::string::npos;
}

/// Throws OperatorError when the value is none.
TomlNode ValueOf(const Setting& setting) {
  const std::string text = "value = " + setting.value + "\n";
  CheckSceneText(text, "setting");
  return *ParseToml(text, "setting").Find("value");
}

Setting Parse(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) Refuse(text, "KEY=VALUE, such as solver.substeps=2");
  Setting setting;
  setting.key = Trimmed(text.substr(0, equals));
  setting.value = Trimmed(text.substr(equals + 1));
  const std::size_t dot = setting.key.find('.');
  if (dot != std::string::npos) {
    setting.table = setting.key.substr(0, dot);
    setting.key = setting.key.substr(dot + 1);
    if (!IsWord(setting.table)) Refuse(text, "no such table");
  }
  if (!IsWord(setting.key)) Refuse(text, "no such key");
  const bool plain = !setting.value.empty() && IsCleanText(setting.value, "") &&
                     setting.value.find('#') == std::string::npos;
  if (!plain) Refuse(text, "what value?");
  try {
    ValueOf(setting);
  } catch (const OperatorError&) {
    Refuse(text, "what value?");
  }
  return setting;
}

/// The table that a line opens, in its brackets; "" if it opens none.
std::string Opens(const std::string& line) {
  const std::string text = Trimmed(line);
  if (text.empty() || text[0] != '[') return "";
  const std::size_t begin = text.find_first_not_of('['), end = text.find(']');
  if (begin > 2 || end == std::string::npos || end < begin) return "";
  const std::string name = text.substr(begin, end - begin);
  return IsWord(Trimmed(name)) ? text.substr(0, end + begin) : "";  // else a row of an array
}

bool Assigns(const std::string& line, const std::string& key) {
  const std::size_t equals = line.find('=');
  return equals != std::string::npos && Trimmed(line.substr(0, equals)) == key;
}

std::vector<std::string> Lines(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

std::string Set(const std::string& text, const Setting& setting) {
  std::vector<std::string> lines = Lines(text);
  const std::string header = "[" + setting.table + "]";
  const std::string wanted = setting.key + " = " + setting.value;
  bool inside = setting.table.empty();
  auto opening = inside ? lines.begin() : lines.end();  // a new line goes here
  auto line = lines.begin();
  for (; line != lines.end(); ++line) {
    const std::string opened = Opens(*line);
    if (!opened.empty()) {
      inside = !setting.table.empty() && opened == header;
      if (inside) opening = line + 1;
    } else if (inside && Assigns(*line, setting.key)) {
      break;
    }
  }
  if (line != lines.end()) {
    *line = wanted;
  } else if (opening != lines.end() || setting.table.empty()) {
    lines.insert(opening, wanted);
  } else {
    lines.insert(lines.end(), {header, wanted});
  }
  std::string joined;
  for (const std::string& each : lines) joined += each + '\n';
  return joined;
}

bool SameValue(const TomlNode& a, const TomlNode& b) {
  if (a.kind != b.kind || a.items.size() != b.items.size()) return false;
  for (std::size_t i = 0; i < a.items.size(); ++i) {
    if (!SameValue(a.items[i], b.items[i])) return false;
  }
  return a.boolean == b.boolean && a.number == b.number && a.text == b.text;
}

/// Whether a changed text says what was meant: a key within a value of several lines would not.
bool Says(const TomlNode& tree, const Setting& setting) {
  const TomlNode* table = setting.table.empty() ? &tree : tree.Find(setting.table);
  const TomlNode* found = table == nullptr ? nullptr : table->Find(setting.key);
  return found != nullptr && SameValue(*found, ValueOf(setting));
}

}  // namespace

std::vector<std::string> SplitSettings(const std::string& text) {
  std::vector<std::string> settings;
  std::set<std::string> keys;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(';', at), text.size());
    const Setting setting = Parse(text.substr(at, end - at));
    const std::string key = (setting.table.empty() ? "" : setting.table + ".") + setting.key;
    if (!keys.insert(key).second) Refuse(text, key + " is set twice");
    settings.push_back(key + "=" + setting.value);
    at = end + 1;
  }
  return settings;
}

std::string JoinSettings(const std::vector<std::string>& settings) {
  std::string text;
  for (const std::string& setting : settings) text += (text.empty() ? "" : ";") + setting;
  return text;
}

std::string WithSettings(const std::string& text, const std::vector<std::string>& settings,
                         const std::string& file) {
  std::string changed = text;
  for (const std::string& each : SplitSettings(JoinSettings(settings))) {
    const Setting setting = Parse(each);
    changed = Set(changed, setting);
    CheckSceneText(changed, file);
    bool good = false;
    try {
      good = Says(ParseToml(changed, file), setting);
    } catch (const OperatorError&) {  // it was there already, in another revision
    }
    if (!good) Refuse(each, file + " cannot be set so: the key needs a line of its own there");
  }
  return changed;
}

Scene LoadSceneWith(const std::string& path, const std::vector<std::string>& settings) {
  Scene scene = LoadScene(path);
  if (settings.empty()) return scene;
  try {
    return ParseScene(WithSettings(scene.text, settings, path), path);
  } catch (const OperatorError& error) {
    throw OperatorError(std::string(error.what()) + " (with " + JoinSettings(settings) + ")");
  }
}

}  // namespace seam
