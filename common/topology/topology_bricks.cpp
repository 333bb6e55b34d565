/// Topology: edits of bricks.

#include <algorithm>
#include <utility>

#include "common/topology/feather_blast.h"
#include "common/topology/feather_fall.h"
#include "common/topology/feather_store.h"
#include "common/topology/foundation.h"
#include "common/topology/topology.h"

namespace seam {
namespace {

/// Returns the lower left corner, m.
Vec2 CornerOf(const Brick& b) {
  return Vec2(static_cast<float>(b.x), static_cast<float>(b.y)) * kBrickUnit;
}

bool IdBefore(const Part& part, PartId id) { return part.id < id; }

}  // namespace

void Topology::KeepGround() {
  if (scene_.bricks.empty()) return;
  std::vector<Part> ground;
  for (const Part& part : scene_.parts) {
    const int at = composition_.assembly_of_part[static_cast<std::size_t>(part.id)];
    const bool stands = composition_.assemblies[static_cast<std::size_t>(at)].kinematic < 0;
    if (part.anchored && !part.gone && stands) ground.push_back(part);
  }
  ground_ = std::make_shared<const std::vector<Part>>(std::move(ground));
}

const FeatherStore& Topology::BricksLeft() const {
  if (left_ == nullptr) {
    left_ = std::make_shared<FeatherStore>(scene_.bricks);
    foundations_ = std::make_shared<const Foundations>(
        *left_, scene_.bricks, ground_ != nullptr ? *ground_ : std::vector<Part>());
    left_parts_ = 0;
  }
  if (left_parts_ == scene_.parts.size()) return *left_;
  const std::vector<Part> since(scene_.parts.begin() + static_cast<std::ptrdiff_t>(left_parts_),
                                scene_.parts.end());
  const std::vector<Brick> freed = FreedBricks(scene_.bricks, since);
  left_parts_ = scene_.parts.size();
  if (freed.empty()) return *left_;
  if (left_.use_count() > 1) left_ = std::make_shared<FeatherStore>(*left_);
  left_->Remove(freed);
  return *left_;
}

void Topology::FreeBricks(const BlastEdit& edit) {
  if (scene_.bricks.empty() || !RoomFor(kBlastPiecesMax + kFallPiecesMax)) return;
  const Blast blast = BlastOf(edit);
  const auto add = [this](std::vector<Part> parts) {
    for (Part& part : parts) {
      part.id = static_cast<PartId>(scene_.parts.size());
      scene_.parts.push_back(std::move(part));
      stale_ = true;
    }
  };
  Freed freed = BlastBricks(scene_.bricks, BricksLeft(), blast);
  add(std::move(freed.parts));
  const FeatherStore& left = BricksLeft();
  Fallen fallen =
      FallingBricks(scene_.bricks, *foundations_, scene_.parts, left, freed.bricks, blast);
  add(std::move(fallen.parts));
  BricksLeft();
  SetHanging(std::move(fallen.hanging));
}

void Topology::RecordHanging(PartId part) {
  if (ground_ == nullptr) return;
  const auto found = std::lower_bound(ground_->begin(), ground_->end(), part, IdBefore);
  if (found == ground_->end() || found->id != part) return;
  const FeatherStore& left = BricksLeft();
  SetHanging(HangingWithout(part, *foundations_, scene_.parts, left));
}

void Topology::SetHanging(std::vector<Brick> hanging) {
  hanging_.reset();
  if (!hanging.empty()) hanging_ = CornerOf(hanging.front());
  if (left_.use_count() > 1) left_ = std::make_shared<FeatherStore>(*left_);
  left_->SetHanging(std::move(hanging));
}

}  // namespace seam
