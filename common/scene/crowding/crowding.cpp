#include "common/scene/crowding/crowding.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <utility>
#include <vector>

#include "common/base/check.h"
#include "common/base/spatial/box_sweep.h"
#include "common/scene/crowding/part_limits.h"
#include "common/scene/scene_limits.h"

namespace seam {
namespace {

/// Overlap that does not count, m: touching shapes with rounded coordinates. The engine tolerates
/// as much.
constexpr float kSlop = 0.005f;

/// A part's box along the world's axes, m.
struct Box {
  Vec2 min{0, 0}, max{0, 0};
  PartId part = 0;
  int assembly = 0;
  int pieces = 1;
  bool moves = false;
  bool bullet = false;
};

/// Returns the largest number of shapes that the engine receives for a part other than a chain.
int PiecesOf(const Part& part) {
  if (part.kind == ShapeKind::kCapsule) return 3;
  const auto points = static_cast<int>(part.points.size());
  return part.kind == ShapeKind::kPolygon && points > 8 ? (points + 3) / 4 : 1;
}

bool Overlap(const PartLimits& a, const Box& b) {
  return ((a.max - b.min).array() > kSlop).all() && ((b.max - a.min).array() > kSlop).all();
}

/// Returns the number of segments of a chain that overlap a box.
int SegmentsIn(const Part& chain, const Box& box) {
  int count = 0;
  for (std::size_t i = 0; i + 1 < chain.points.size(); ++i) {
    PartLimits limits;
    limits.Add(InWorld(chain, chain.points[i]), kSlop);
    limits.Add(InWorld(chain, chain.points[i + 1]), kSlop);
    count += Overlap(limits, box) ? 1 : 0;
  }
  return count;
}

class Count {
 public:
  Count(const Scene& scene, const Composition& composition, PartId first)
      : scene_(scene), composition_(composition), first_(first) {
    for (const Joint& joint : scene.joints) {
      if (joint.gone || joint.collide || joint.kind == JointKind::kKinematic) continue;
      const int a = AssemblyOf(joint.a), b = AssemblyOf(joint.b);
      joined_.insert({std::min(a, b), std::max(a, b)});
    }
    of_part_.assign(scene.parts.size(), 0);
    bullets_of_part_.assign(scene.parts.size(), 0);
  }

  Crowding Run() {
    const std::vector<Box> boxes = Boxes();
    const BoxSweep sweep(boxes, [](std::size_t) { return 0.0f; });
    // Two boxes that never move do not collide.
    const auto label = [&](std::size_t i) { return boxes[i].moves ? -1 : 0; };
    sweep.EachPairApart(0, label, [&](std::size_t i, std::size_t j) {
      const Box &a = boxes[i], &b = boxes[j];
      if (Overlap({a.min, a.max}, b) && MayCollide(a, b)) Add(a, b);
    });
    out_.part = Most(of_part_);
    out_.bullet_part = Most(bullets_of_part_);
    return out_;
  }

 private:
  int AssemblyOf(PartId part) const {
    return composition_.assembly_of_part[static_cast<std::size_t>(part)];
  }

  std::vector<Box> Boxes() const {
    std::vector<bool> bullet(composition_.assemblies.size(), false);
    for (const Part& part : scene_.parts) {
      if (part.bullet && !part.gone) bullet[static_cast<std::size_t>(AssemblyOf(part.id))] = true;
    }
    std::vector<Box> boxes;
    for (const Part& part : scene_.parts) {
      if (part.gone) continue;
      const auto index = static_cast<std::size_t>(AssemblyOf(part.id));
      const Assembly& assembly = composition_.assemblies[index];
      const bool stays = assembly.anchored && assembly.kinematic < 0;
      if (part.id < first_ && !stays) continue;
      const PartLimits limits = LimitsOf(part);
      boxes.push_back({limits.min, limits.max, part.id, static_cast<int>(index), PiecesOf(part),
                       !assembly.anchored, bullet[index]});
    }
    return boxes;
  }

  bool MayCollide(const Box& a, const Box& b) const {
    if (a.assembly == b.assembly || std::max(a.part, b.part) < first_) return false;
    if (!seam::MayCollide(scene_.parts[static_cast<std::size_t>(a.part)].filter,
                          scene_.parts[static_cast<std::size_t>(b.part)].filter)) {
      return false;
    }
    if (joined_.empty()) return true;
    return joined_.count({std::min(a.assembly, b.assembly), std::max(a.assembly, b.assembly)}) == 0;
  }

  int PiecesIn(const Box& box, const Box& other) const {
    const Part& part = scene_.parts[static_cast<std::size_t>(box.part)];
    return part.kind == ShapeKind::kChain ? SegmentsIn(part, other) : box.pieces;
  }

  void Add(const Box& a, const Box& b) {
    const std::int64_t pairs = std::int64_t{PiecesIn(a, b)} * PiecesIn(b, a);
    const bool bullet = (a.bullet || b.bullet) && a.moves && b.moves;
    (bullet ? out_.bullet_pairs : out_.pairs) += pairs;
    for (const Box* box : {&a, &b}) {
      (bullet ? bullets_of_part_ : of_part_)[static_cast<std::size_t>(box->part)] += pairs;
    }
  }

  /// Returns the part from `first_` on with the largest number; -1 if all are 0.
  PartId Most(const std::vector<std::int64_t>& numbers) const {
    const auto begin =
        numbers.begin() + std::min<std::ptrdiff_t>(first_, std::ptrdiff_t(numbers.size()));
    const auto most = std::max_element(begin, numbers.end());
    if (most == numbers.end() || *most == 0) return -1;
    return static_cast<PartId>(most - numbers.begin());
  }

  const Scene& scene_;
  const Composition& composition_;
  const PartId first_;
  std::set<std::pair<int, int>> joined_;  // pairs of assemblies that a joint keeps from colliding
  std::vector<std::int64_t> of_part_, bullets_of_part_;
  Crowding out_;
};

[[noreturn]] void Refuse(const Scene& scene, const std::string& file, PartId id, std::int64_t pairs,
                         std::int64_t limit, const char* what) {
  const Part& part = scene.parts[static_cast<std::size_t>(id)];
  char where[64];
  std::snprintf(where, sizeof where, "[%g, %g]", static_cast<double>(part.position.x()),
                static_cast<double>(part.position.y()));
  throw OperatorError(file + ":" + std::to_string(part.line) + ": part '" + part.name +
                      "': too much begins in one place, most of it around " + where + ": " +
                      std::to_string(pairs) + " pairs of " + what + " overlap, of at most " +
                      std::to_string(limit));
}

}  // namespace

Crowding CrowdingOf(const Scene& scene, const Composition& composition, PartId first) {
  return Count(scene, composition, first).Run();
}

void CheckCrowding(const Scene& scene, const Composition& composition, const std::string& file,
                   PartId first) {
  const Crowding crowding = CrowdingOf(scene, composition, first);
  if (crowding.bullet_pairs > kBulletCrowdMax) {
    Refuse(scene, file, crowding.bullet_part, crowding.bullet_pairs, kBulletCrowdMax,
           "shapes with a bullet");
  }
  if (crowding.pairs > kCrowdMax) {
    Refuse(scene, file, crowding.part, crowding.pairs, kCrowdMax, "shapes");
  }
}

}  // namespace seam
