#include "common/scene/toml/toml_tree.h"

#include <algorithm>
#include <sstream>
#include <toml.hpp>

#include "common/base/check.h"
#include "common/scene/toml/scene_text.h"
#include "common/scene/toml/toml_hint.h"

namespace seam {
namespace {

/// Positions of a text's line ends.
class LineEnds {
 public:
  explicit LineEnds(const std::string& text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] == '\n') ends_.push_back(static_cast<std::ptrdiff_t>(i));
    }
  }
  /// Returns the line of a character, from 1.
  int LineOf(std::ptrdiff_t offset) const {
    const auto before = std::lower_bound(ends_.begin(), ends_.end(), offset) - ends_.begin();
    return static_cast<int>(before) + 1;
  }

 private:
  std::vector<std::ptrdiff_t> ends_;
};

// Differences between toml11 3 (Debian 12) and 4 (Debian 13): the positions of values and errors.
#if TOML11_VERSION_MAJOR >= 4
int LineOf(const toml::source_location& at) { return static_cast<int>(at.first_line_number()); }
int LineOf(const toml::value& value, const LineEnds&) { return LineOf(value.location()); }

std::pair<int, std::string> Explain(const toml::syntax_error& e) {
  if (e.errors().empty()) return {1, "not valid TOML"};
  const toml::error_info& first = e.errors().front();
  const int line = first.locations().empty() ? 1 : LineOf(first.locations().front().first);
  return {line, first.title()};
}
#else
int LineOf(const toml::source_location& at) { return static_cast<int>(at.line()); }
/// toml11's own answer counts all lines before the value, for each value.
int LineOf(const toml::value& value, const LineEnds& ends) {
  const auto* at = dynamic_cast<const toml::detail::region*>(toml::detail::get_region(value));
  return at == nullptr ? LineOf(value.location()) : ends.LineOf(at->first() - at->begin());
}

std::pair<int, std::string> Explain(const toml::syntax_error& e) {
  return {LineOf(e.location()), e.what()};
}
#endif

/// "[error] toml::parse_table: invalid line format" -> "invalid line format".
std::string FirstLine(const std::string& what) {
  std::string line = what.substr(0, what.find('\n'));
  for (const char* prefix : {"[error]", "toml::"}) {
    const auto at = line.find(prefix);
    if (at == std::string::npos) continue;
    const auto end = line.find(prefix[0] == '[' ? "]" : ": ", at);
    if (end != std::string::npos) line.erase(0, end + 1);
  }
  const auto first = line.find_first_not_of(" :");
  return first == std::string::npos ? "syntax error" : Printable(line.substr(first));
}

TomlNode Convert(const toml::value& value, const LineEnds& ends) {
  TomlNode node;
  node.line = LineOf(value, ends);
  if (value.is_boolean()) {
    node.kind = TomlNode::Kind::kBoolean;
    node.boolean = value.as_boolean();
  } else if (value.is_integer()) {
    node.kind = TomlNode::Kind::kInteger;
    node.integer = value.as_integer();
    node.number = static_cast<double>(node.integer);
  } else if (value.is_floating()) {
    node.kind = TomlNode::Kind::kNumber;
    node.number = value.as_floating();
  } else if (value.is_string()) {
    node.kind = TomlNode::Kind::kText;
    node.text = toml::get<std::string>(value);
  } else if (value.is_array()) {
    node.kind = TomlNode::Kind::kArray;
    for (const toml::value& item : value.as_array()) node.items.push_back(Convert(item, ends));
  } else if (value.is_table()) {
    node.kind = TomlNode::Kind::kTable;
    for (const auto& [key, member] : value.as_table()) {
      node.members.emplace_back(key, Convert(member, ends));
    }
    // toml11's tables are hash maps: order must not depend on its hashes.
    std::sort(node.members.begin(), node.members.end(), [](const auto& x, const auto& y) {
      return x.second.line != y.second.line ? x.second.line < y.second.line : x.first < y.first;
    });
  }
  return node;
}

}  // namespace

const TomlNode* TomlNode::Find(const std::string& key) const {
  for (const auto& [name, member] : members) {
    if (name == key) return &member;
  }
  return nullptr;
}

const char* KindName(TomlNode::Kind kind) {
  switch (kind) {
    case TomlNode::Kind::kBoolean: return "true or false";
    case TomlNode::Kind::kInteger: return "an integer";
    case TomlNode::Kind::kNumber: return "a number";
    case TomlNode::Kind::kText: return "text";
    case TomlNode::Kind::kArray: return "an array";
    case TomlNode::Kind::kTable: return "a table";
    case TomlNode::Kind::kOther: break;
  }
  return "a date or time";
}

TomlNode ParseToml(const std::string& text, const std::string& file) {
  try {
    std::istringstream in(text);
    return Convert(toml::parse(in, file), LineEnds(text));
  } catch (const toml::syntax_error& e) {
    const auto [line, what] = Explain(e);
    const TomlSlip slip = FindTomlSlip(text, line).value_or(TomlSlip{line, FirstLine(what)});
    throw OperatorError(file + ":" + std::to_string(slip.line) + ": " + slip.text);
  } catch (const std::exception& e) {
    // Some mistakes (a number that does not fit) reach us without a position.
    throw OperatorError(file + ":1: not valid TOML: " + FirstLine(e.what()));
  }
}

}  // namespace seam
