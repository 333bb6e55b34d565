#include "client/scene_cache.h"

#include <algorithm>

namespace seam {

std::shared_ptr<const Scene> SceneCache::Of(const std::string& text, const std::string& file_name) {
  for (const Entry& entry : entries_) {
    if (entry.text != text || entry.file_name != file_name) continue;
    if (std::shared_ptr<const Scene> scene = entry.scene.lock()) return scene;
  }
  const auto gone = [](const Entry& entry) { return entry.scene.expired(); };
  entries_.erase(std::remove_if(entries_.begin(), entries_.end(), gone), entries_.end());
  const auto scene = std::make_shared<const Scene>(ParseScene(text, file_name));
  entries_.push_back({text, file_name, scene});
  return scene;
}

}  // namespace seam
