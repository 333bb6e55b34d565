#pragma once
/// A TOML text as a plain tree with line numbers. Only toml_tree.cpp includes toml11, so that the
/// differences between its versions 3 and 4 stay in one place.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace seam {

struct TomlNode {
  enum class Kind { kBoolean, kInteger, kNumber, kText, kArray, kTable, kOther };

  Kind kind = Kind::kOther;  ///< kOther: dates and times
  int line = 0;              ///< line of its beginning, from 1
  bool boolean = false;
  std::int64_t integer = 0;
  double number = 0;  ///< also set for integers
  std::string text;
  std::vector<TomlNode> items;                            ///< an array's
  std::vector<std::pair<std::string, TomlNode>> members;  ///< a table's, by line, then by key

  /// Returns nullptr if this is no table or has no such member.
  const TomlNode* Find(const std::string& key) const;
};

/// Returns "text", "a number" ... for messages.
const char* KindName(TomlNode::Kind kind);

/// Requires a text that passed CheckSceneText. Throws OperatorError "file:line: FAULT".
TomlNode ParseToml(const std::string& text, const std::string& file);

}  // namespace seam
