#include "tests/lab/experiment/key_index.h"

#include <algorithm>
#include <utility>

namespace seam {

KeyIndex::KeyIndex(std::vector<std::string> columns) : columns_(std::move(columns)) {
  hashed_ = std::find(columns_.begin(), columns_.end(), "scene_hash") != columns_.end();
}

KeyIndex::Key KeyIndex::WithoutFolder(Key key) const {
  for (std::size_t c = 0; c < columns_.size() && c < key.size(); ++c) {
    if (columns_[c] == "scene") key[c].erase(0, key[c].rfind('/') + 1);
  }
  return key;
}

bool KeyIndex::Add(const Key& key, std::size_t row) {
  if (!exact_.emplace(key, row).second) return false;
  if (hashed_) without_folder_[WithoutFolder(key)].push_back(row);
  return true;
}

std::optional<std::size_t> KeyIndex::Find(const Key& key) const {
  const auto same = exact_.find(key);
  if (same != exact_.end()) return same->second;
  if (!hashed_) return std::nullopt;
  const auto found = without_folder_.find(WithoutFolder(key));
  if (found == without_folder_.end() || found->second.size() > 1) return std::nullopt;
  return found->second.front();
}

}  // namespace seam
