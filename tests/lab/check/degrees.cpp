#include <fmt/format.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "common/scene/toml/read_watch.h"
#include "tests/lab/check/scene_check.h"

namespace seam {
namespace {

constexpr double kTurn = 6.283186;  ///< rad

/// Looks at each angle that the loader reads.
class AngleWatch : public ReadWatch {
 public:
  explicit AngleWatch(std::vector<Finding>* findings) : findings_(findings) { WatchReads(this); }
  ~AngleWatch() override { WatchReads(nullptr); }
  AngleWatch(const AngleWatch&) = delete;
  AngleWatch& operator=(const AngleWatch&) = delete;

  void OnTable(const TomlNode&, const std::string&, const std::vector<std::string>&) override {}
  void OnKey(const TomlNode& table, const std::string& key, ReadAs, Range range) override {
    const TomlNode* const node = range.radians ? table.Find(key) : nullptr;
    if (node == nullptr || !told_.insert(node).second) return;
    if (Look(key, *node)) return;
    for (const TomlNode& item : node->items) {
      if (Look(key, item)) return;
    }
  }

 private:
  bool Look(const std::string& key, const TomlNode& node) {
    if (std::fabs(node.number) <= kTurn) return false;
    findings_->push_back(
        {node.line, fmt::format("{} = {:g} is more than a turn: angles are in "
                                "radians, {:g} degrees are {:.4g}",
                                key, node.number, node.number, node.number * kTurn / 360)});
    return true;
  }

  std::vector<Finding>* findings_;
  std::set<const TomlNode*> told_;
};

}  // namespace

void FindDegrees(const Scene& scene, std::vector<Finding>* findings) {
  const AngleWatch watch(findings);
  ParseScene(scene.text, scene.name + ".toml");
}

}  // namespace seam
