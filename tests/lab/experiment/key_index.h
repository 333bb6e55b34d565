#pragma once
/// Rows of a table by their keys. The folder of a scene does not count where the key has the hash
/// of its content: the same sweep may be run on machines that keep their scenes at other places.

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace seam {

class KeyIndex {
 public:
  using Key = std::vector<std::string>;

  /// `columns`: the names of the key's columns.
  explicit KeyIndex(std::vector<std::string> columns);

  /// Adds the row of a key. False: there is a row of exactly this key.
  bool Add(const Key& key, std::size_t row);
  /// Returns the row of exactly this key; else the only one that differs in the scene's folder.
  std::optional<std::size_t> Find(const Key& key) const;

 private:
  Key WithoutFolder(Key key) const;

  const std::vector<std::string> columns_;
  bool hashed_ = false;
  std::map<Key, std::size_t> exact_;
  std::map<Key, std::vector<std::size_t>> without_folder_;
};

}  // namespace seam
