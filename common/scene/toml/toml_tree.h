#pragma once
/// A TOML text as a plain tree that knows its lines. toml_tree.cpp alone includes toml11, so that
/// the differences between its versions 3 and 4 stay in one place.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace seam {

struct TomlNode {
  enum class Kind { kBoolean, kInteger, kNumber, kText, kArray, kTable, kOther };

  Kind kind = Kind::kOther;  ///< kOther: dates and times
  int line = 0;              ///< where it begins, from 1
  bool boolean = false;
  std::int64_t integer = 0;
  double number = 0;  ///< of integers too
  std::string text;
  std::vector<TomlNode> items;                            ///< of an array
  std::vector<std::pair<std::string, TomlNode>> members;  ///< of a table, by line, then by key

  /// nullptr when this is no table or has no such member.
  const TomlNode* Find(const std::string& key) const;
};

/// "text", "a number": for messages.
const char* KindName(TomlNode::Kind kind);

/// Requires a text that passed CheckSceneText. Throws OperatorError "file:line: what".
TomlNode ParseToml(const std::string& text, const std::string& file);

}  // namespace seam
