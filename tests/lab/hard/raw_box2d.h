#pragma once
/// A scene in a plain b2World, stepped without our core: the baseline for World::Step's cost.

#include <memory>

#include "common/scene/scene.h"

namespace seam {

/// The same bodies, fixtures and joints in the same order as a World's, stepped by b2World::Step
/// alone: no listener, no impacts, no touches.
class RawBox2d {
 public:
  explicit RawBox2d(const Scene& scene);
  ~RawBox2d();
  RawBox2d(const RawBox2d&) = delete;
  RawBox2d& operator=(const RawBox2d&) = delete;

  void SetInput(int player, const Input& input);
  void Act(int player, int action);
  /// Does as many engine steps as the scene has substeps.
  void Step();
  std::int64_t tick() const;
  /// Over the same bytes as World::Hash: equal hashes, equal worlds.
  std::uint64_t Hash() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace seam
