#pragma once
/// The words of a Lua script, with their lines, for checks of its text.

#include <cstddef>
#include <string>
#include <vector>

namespace seam {

struct LuaWord {
  enum class Kind { kName, kKeyword, kText, kNumber, kSymbol, kEnd };
  Kind kind = Kind::kEnd;
  std::string text;  ///< of kText: its content, escapes as written
  int line = 0;      ///< in the scene file
};

class LuaWords {
 public:
  /// `line`: of the scene file on which the code begins. Requires code that Lua has compiled.
  LuaWords(const std::string& code, int line);

  std::size_t size() const { return words_.size(); }
  /// A word of kind kEnd beyond both ends.
  const LuaWord& at(std::size_t index) const;
  bool Is(std::size_t index, const char* symbol_or_keyword) const;
  bool IsName(std::size_t index) const { return at(index).kind == LuaWord::Kind::kName; }
  /// True for a name after a point or colon.
  bool IsField(std::size_t index) const { return Is(index - 1, ".") || Is(index - 1, ":"); }
  bool IsText(std::size_t index) const { return at(index).kind == LuaWord::Kind::kText; }
  /// Returns the index of the bracket that closes the one at `open`; size() if there is none.
  std::size_t CloseOf(std::size_t open) const;
  /// Returns the index of the `end` or `until` of the block whose keyword (function, do, then of an
  /// if, repeat) is at `begin`; size() if there is none.
  std::size_t EndOf(std::size_t begin) const;
  /// Writes t["name"] as t.name, and puts what a local is in its place, where it is a name or text
  /// alone and the only local of its name, and nothing else is assigned to it.
  void Resolve();

 private:
  void Read(const std::string& code, int line);
  bool IsDeclaration(std::size_t index) const;
  bool IsConstant(std::size_t index) const;

  std::vector<LuaWord> words_;
  const LuaWord none_;
};

}  // namespace seam
