#pragma once
/// Boxes around parts, along the world's axes.

#include "common/base/trig.h"
#include "common/scene/scene.h"

namespace seam {

/// The corners, m.
struct PartLimits {
  Vec2 min{1e30f, 1e30f}, max{-1e30f, -1e30f};
  void Add(const Vec2& point, float radius) {
    min = min.cwiseMin((point.array() - radius).matrix());
    max = max.cwiseMax((point.array() + radius).matrix());
  }
};

/// Returns the place of a point of the part, m.
inline Vec2 InWorld(const Part& part, const Vec2& local) {
  const float c = Cos(part.angle), s = Sin(part.angle);
  return part.position + Vec2(c * local.x() - s * local.y(), s * local.x() + c * local.y());
}

/// Returns the box around the part's shape as the scene has it.
inline PartLimits LimitsOf(const Part& part) {
  PartLimits limits;
  switch (part.kind) {
    case ShapeKind::kBox:
      for (const float x : {-0.5f, 0.5f}) {
        for (const float y : {-0.5f, 0.5f}) {
          limits.Add(InWorld(part, Vec2(x * part.size.x(), y * part.size.y())), 0);
        }
      }
      break;
    case ShapeKind::kCircle: limits.Add(part.position, part.radius); break;
    case ShapeKind::kCapsule:
      for (const Vec2& p : part.points) limits.Add(InWorld(part, p), part.radius);
      break;
    case ShapeKind::kPolygon:
    case ShapeKind::kChain:
    case ShapeKind::kSegment:
      for (const Vec2& p : part.points) limits.Add(InWorld(part, p), 0);
      break;
  }
  return limits;
}

}  // namespace seam
