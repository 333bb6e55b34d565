#pragma once
/// Lets a program follow the scene loader: each table that it reads, the table's keys, and the type
/// and range with which each key is read.

#include <string>
#include <vector>

#include "common/scene/toml/scene_reader.h"
#include "common/scene/toml/toml_tree.h"

namespace seam {

/// The type of a key. Arrays of no known form are kItems.
enum class ReadAs {
  kNumber,
  kInteger,
  kFlag,
  kText,
  kVector,
  kPoints,
  kTexts,
  kItems,
  kTables,
  kTable
};

class ReadWatch {
 public:
  virtual ~ReadWatch() = default;
  /// A reader of this table begins; `what` names it in messages, "scene" for the whole file.
  virtual void OnTable(const TomlNode& table, const std::string& what,
                       const std::vector<std::string>& keys) = 0;
  /// A key is read, which may be absent. `range`: of its numbers, of kNumber, kInteger, kVector and
  /// kPoints.
  virtual void OnKey(const TomlNode& table, const std::string& key, ReadAs as, Range range) = 0;
};

/// Sets the watch of this thread's readers, nullptr: none. It must outlive their use.
void WatchReads(ReadWatch* watch);

}  // namespace seam
