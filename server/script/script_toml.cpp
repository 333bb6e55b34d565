/// Writes parts and joints of scripts as TOML of a scene: one reader checks both, and one text goes
/// to every peer.

#include <cmath>
#include <cstdio>

#include "common/scene/toml/scene_text.h"
#include "server/script/script_host.h"

namespace seam {
namespace {

std::string Key(const std::string& key) {
  for (const char c : key) {
    const bool plain = (c >= 'a' && c <= 'z') || c == '_';
    if (!plain) throw ScriptRefusal("no key '" + Printable(key) + "' is known");
  }
  if (key.empty() || key == "repeat") throw ScriptRefusal("no repeat, and no empty keys");
  return key;
}

std::string Text(const std::string& text) {
  if (!IsCleanText(text, "")) throw ScriptRefusal("text with a control character");
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

std::string Number(double number) {
  if (!std::isfinite(number)) throw ScriptRefusal("a number is not finite");
  char text[40];
  std::snprintf(text, sizeof text, "%.9g", number);  // enough for single precision
  std::string out = text;
  // TOML reads 1e+06 as a float, but 3 as an integer.
  if (out.find_first_of(".e") == std::string::npos) out += ".0";
  return out;
}

std::string Value(const TomlNode& node) {
  std::string out;
  switch (node.kind) {
    case TomlNode::Kind::kBoolean: return node.boolean ? "true" : "false";
    case TomlNode::Kind::kInteger: return std::to_string(node.integer);
    case TomlNode::Kind::kNumber: return Number(node.number);
    case TomlNode::Kind::kText: return Text(node.text);
    case TomlNode::Kind::kArray:
      for (const TomlNode& item : node.items) out += (out.empty() ? "" : ", ") + Value(item);
      return "[" + out + "]";
    case TomlNode::Kind::kTable:
      for (const auto& [key, member] : node.members) {
        out += (out.empty() ? "" : ", ") + Key(key) + " = " + Value(member);
      }
      return "{" + out + "}";
    case TomlNode::Kind::kOther: break;
  }
  throw ScriptRefusal("a value of a kind that no scene has");
}

}  // namespace

std::string ToToml(const std::string& kind, const TomlNode& table) {
  if (table.kind != TomlNode::Kind::kTable) throw ScriptRefusal("a table with names is needed");
  std::string out = "[[" + kind + "]]\n";
  for (const auto& [key, member] : table.members) out += Key(key) + " = " + Value(member) + "\n";
  return out;
}

}  // namespace seam
