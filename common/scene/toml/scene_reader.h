#pragma once
/// Typed, range-checked reader of one TOML table. Every mistake throws OperatorError "file:line:
/// TABLE: ..." with the expected value.

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "common/scene/toml/toml_tree.h"
#include "common/scene/types.h"

namespace seam {

/// Closed range of values.
struct Range {
  double min = 0, max = 0;
  bool radians = false;  ///< the values are angles
};

class SceneReader {
 public:
  /// `what` names the table in messages ("part 'wheel'"). Throws on keys that are not in `keys` and
  /// suggests the nearest. All arguments but `keys` must outlive the reader.
  SceneReader(const TomlNode& table, const std::string& file, std::string what,
              std::initializer_list<const char*> keys);

  bool Has(const char* key) const { return table_.Find(key) != nullptr; }
  int line() const { return table_.line; }
  int LineOf(const char* key) const;  ///< the table's line if the key is absent
  void Rename(std::string what) { what_ = std::move(what); }
  const std::string& what() const { return what_; }

  /// Throws "file:line: TABLE: complaint", at the line of the key or of the table.
  [[noreturn]] void Fail(const std::string& complaint) const;
  [[noreturn]] void FailAt(const char* key, const std::string& complaint) const;

  // Each returns `fallback` if the key is absent, or throws if there is no fallback.
  float Number(const char* key, Range range, std::optional<float> fallback = {}) const;
  double Seconds(const char* key, Range range, std::optional<double> fallback = {}) const;
  int Integer(const char* key, Range range, std::optional<int> fallback = {}) const;
  bool Flag(const char* key, bool fallback) const;
  /// Up to 200 bytes, without control characters.
  std::string Text(const char* key, std::optional<std::string> fallback = {}) const;
  /// Returns a program: as long as the scene allows, with line ends and tabs.
  std::string Code(const char* key) const;
  bool IsText(const char* key) const;
  /// A letter or digit, then up to 31 letters, digits, '_' or '-'.
  std::string Name(const char* key) const;
  /// [x, y], both in the range.
  Vec2 Vector(const char* key, Range range, std::optional<Vec2> fallback = {}) const;
  /// [[x, y], ...], all in the range; empty if absent.
  std::vector<Vec2> Points(const char* key, Range range, std::size_t count_max) const;
  /// ["a", "b"] or "a"; empty if absent.
  std::vector<std::string> Texts(const char* key) const;
  /// Members of an array of tables; empty if absent.
  std::vector<const TomlNode*> Tables(const char* key) const;
  /// Items of any array; empty if absent.
  const std::vector<TomlNode>& Items(const char* key) const;
  /// True if the key is present and a table.
  bool IsTable(const char* key) const;
  /// nullptr if absent.
  const TomlNode* Table(const char* key) const;

 private:
  const TomlNode* Get(const char* key, bool required) const;
  double NumberIn(const TomlNode& node, const char* key, Range range) const;
  Vec2 VectorIn(const TomlNode& node, const char* key, Range range) const;
  [[noreturn]] void Expected(const TomlNode& node, const char* key, const std::string& what) const;
  [[noreturn]] void FailLine(int line, const std::string& complaint) const;

  const TomlNode& table_;
  const std::string& file_;
  std::string what_;
};

/// Returns the shortest readable decimal: "0.05", "10".
std::string Decimal(double value);

}  // namespace seam
