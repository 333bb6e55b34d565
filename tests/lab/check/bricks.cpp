#include "common/scene/bricks.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "common/scene/assembly.h"
#include "tests/lab/check/scene_check.h"

namespace seam {
namespace {

/// The moving parts by the x of their middle, m.
std::vector<std::pair<float, const Part*>> MovingParts(const Scene& scene) {
  std::vector<std::pair<float, const Part*>> parts;
  for (const Assembly& assembly : Compose(scene).assemblies) {
    if (assembly.anchored) continue;
    for (const PartId id : assembly.parts) {
      const Part& part = scene.parts[static_cast<std::size_t>(id)];
      parts.emplace_back(part.position.x(), &part);
    }
  }
  std::sort(parts.begin(), parts.end());
  return parts;
}

}  // namespace

void FindInBricks(const Scene& scene, std::vector<Finding>* findings) {
  if (scene.bricks.empty()) return;
  const auto parts = MovingParts(scene);
  std::set<int> said;  // lines: one that stands for many parts is named once
  for (const BrickField& field : scene.bricks) {
    EachBrick(field, [&](int x, int y) {
      const float left = kBrickUnit * static_cast<float>(x);
      const float right = kBrickUnit * static_cast<float>(x + field.width);
      const float low = kBrickUnit * static_cast<float>(y);
      const float high = kBrickUnit * static_cast<float>(y + field.height);
      auto at = std::lower_bound(
          parts.begin(), parts.end(), left,
          [](const std::pair<float, const Part*>& part, float edge) { return part.first < edge; });
      for (; at != parts.end() && at->first <= right; ++at) {
        const Part& part = *at->second;
        if (part.position.y() < low || part.position.y() > high) continue;
        if (!said.insert(part.line).second) continue;
        findings->push_back({part.line, fmt::format("part '{}' begins with its middle in a brick "
                                                    "of '{}'",
                                                    part.name, field.name)});
      }
      return true;
    });
  }
}

}  // namespace seam
