#pragma once
/// Cache of scenes for the clients of one thread: clients of one room receive the same text, which
/// is parsed and checked once for all of them.

#include <memory>
#include <string>
#include <vector>

#include "common/scene/scene.h"

namespace seam {

class SceneCache {
 public:
  /// Parses like ParseScene; returns the same scene as long as it is in use. Throws OperatorError
  /// likewise.
  std::shared_ptr<const Scene> Of(const std::string& text, const std::string& file_name);

 private:
  struct Entry {
    std::string text, file_name;
    std::weak_ptr<const Scene> scene;
  };
  std::vector<Entry> entries_;
};

}  // namespace seam
