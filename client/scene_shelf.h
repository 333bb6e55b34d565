#pragma once
/// Scenes that the clients of one thread have been sent: those of one room are sent the same text,
/// and it is read, and checked, once for all of them.

#include <memory>
#include <string>
#include <vector>

#include "common/scene/scene.h"

namespace seam {

class SceneShelf {
 public:
  /// ParseScene, for as long as somebody has it the same one. Throws OperatorError likewise.
  std::shared_ptr<const Scene> Of(const std::string& text, const std::string& file_name);

 private:
  struct Entry {
    std::string text, file_name;
    std::weak_ptr<const Scene> scene;
  };
  std::vector<Entry> entries_;
};

}  // namespace seam
