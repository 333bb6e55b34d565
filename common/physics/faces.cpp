#include "common/physics/faces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "common/base/geometry.h"
#include "common/scene/forces.h"

namespace seam {
namespace {

using Eigen::Vector2d;

/// Positions closer than this are equal, m.
constexpr double kSame = 1e-3;

/// Properties in which boxes must agree to be merged: angle, friction, restitution, filter,
/// conveyor.
using Kind = std::tuple<float, float, float, int, int, int, float, int, int>;

Kind KindOf(const Part& part) {
  return {part.angle,           part.material.friction, part.material.restitution,
          part.filter.group,    part.filter.category,   part.filter.mask,
          part.conveyor->speed, part.conveyor->player,  static_cast<int>(part.conveyor->axis)};
}

/// A rectangle in the frame of its kind's first box.
struct Rectangle {
  Vector2d min{0, 0}, max{0, 0};  // m
  std::vector<PartId> parts;
};

std::int64_t Cell(double value) { return std::llround(value / kSame); }

/// Merges rectangles that follow each other along `axis` and have the same extent across. True if
/// any were merged.
bool JoinAlong(int axis, std::vector<Rectangle>* all) {
  const int across = 1 - axis;
  const auto key = [&](const Rectangle& r) {
    return std::make_tuple(Cell(r.min[across]), Cell(r.max[across]), r.min[axis]);
  };
  std::sort(all->begin(), all->end(),
            [&](const Rectangle& x, const Rectangle& y) { return key(x) < key(y); });
  std::vector<Rectangle> joined;
  for (Rectangle& r : *all) {
    Rectangle* last = joined.empty() ? nullptr : &joined.back();
    const bool row = last != nullptr && Cell(last->min[across]) == Cell(r.min[across]) &&
                     Cell(last->max[across]) == Cell(r.max[across]);
    if (!row || std::fabs(last->max[axis] - r.min[axis]) > kSame) {
      joined.push_back(std::move(r));
      continue;
    }
    last->max[axis] = r.max[axis];
    last->parts.insert(last->parts.end(), r.parts.begin(), r.parts.end());
  }
  const bool fewer = joined.size() < all->size();
  *all = std::move(joined);
  return fewer;
}

void AddMerged(const Scene& scene, const std::vector<PartId>& boxes, std::vector<Face>* faces) {
  const Part& first = scene.parts[static_cast<std::size_t>(boxes.front())];
  const double angle = static_cast<double>(first.angle);
  std::vector<Rectangle> all;
  for (const PartId id : boxes) {
    const Part& part = scene.parts[static_cast<std::size_t>(id)];
    const Vector2d centre = Turned((part.position - first.position).cast<double>(), -angle);
    const Vector2d half = part.size.cast<double>() / 2;
    all.push_back({centre - half, centre + half, {id}});
  }
  bool fewer = true;
  while (fewer) {
    fewer = JoinAlong(0, &all);
    fewer = JoinAlong(1, &all) || fewer;
  }
  for (Rectangle& r : all) {
    std::sort(r.parts.begin(), r.parts.end());
    Face face{scene.parts[static_cast<std::size_t>(r.parts.front())], r.parts};
    if (r.parts.size() > 1) {
      const Vector2d centre = first.position.cast<double>() + Turned((r.min + r.max) / 2, angle);
      face.shape.position = centre.cast<float>();
      face.shape.size = (r.max - r.min).cast<float>();
    }
    faces->push_back(std::move(face));
  }
}

/// Adds the boxes, except those with a neighbour of the same size on all four sides.
void AddOuter(const Scene& scene, const std::vector<PartId>& boxes, std::vector<Face>* faces) {
  const Part& first = scene.parts[static_cast<std::size_t>(boxes.front())];
  const auto place = [&](const Part& part, double columns, double rows) {
    const Vector2d centre =
        Turned((part.position - first.position).cast<double>(), -static_cast<double>(first.angle));
    const Vector2d size = part.size.cast<double>();
    return std::make_tuple(Cell(size.x()), Cell(size.y()), Cell(centre.x() + columns * size.x()),
                           Cell(centre.y() + rows * size.y()));
  };
  std::set<std::tuple<std::int64_t, std::int64_t, std::int64_t, std::int64_t>> places;
  for (const PartId id : boxes) {
    places.insert(place(scene.parts[static_cast<std::size_t>(id)], 0, 0));
  }
  for (const PartId id : boxes) {
    const Part& part = scene.parts[static_cast<std::size_t>(id)];
    const bool enclosed =
        places.count(place(part, 1, 0)) != 0 && places.count(place(part, -1, 0)) != 0 &&
        places.count(place(part, 0, 1)) != 0 && places.count(place(part, 0, -1)) != 0;
    if (!enclosed) faces->push_back({part, {id}});
  }
}

}  // namespace

std::vector<Face> FacesOf(const Scene& scene, const Assembly& assembly) {
  std::vector<Face> faces;
  const bool each = assembly.parts.size() < kFacesFrom || scene.solver.faces == Faces::kAll;
  std::map<Kind, std::vector<PartId>> kinds;
  for (const PartId id : assembly.parts) {
    const Part& part = scene.parts[static_cast<std::size_t>(id)];
    if (each || part.kind != ShapeKind::kBox) {
      faces.push_back({part, {id}});
    } else {
      kinds[KindOf(part)].push_back(id);
    }
  }
  for (const auto& [kind, boxes] : kinds) {
    if (scene.solver.faces == Faces::kOuter) {
      AddOuter(scene, boxes, &faces);
    } else {
      AddMerged(scene, boxes, &faces);
    }
  }
  std::sort(faces.begin(), faces.end(),
            [](const Face& x, const Face& y) { return x.shape.id < y.shape.id; });
  return faces;
}

NearestOf::NearestOf(const Scene& scene, const std::vector<PartId>& parts) {
  for (const PartId id : parts) {
    const Part& part = scene.parts[static_cast<std::size_t>(id)];
    boxes_.push_back({part.position.cast<double>(), part.size.cast<double>() / 2,
                      static_cast<double>(part.angle), id});
  }
}

PartId NearestOf::At(const Vector2d& point) const {
  PartId nearest = boxes_.front().id;
  double least = 1e30;
  for (const Box& box : boxes_) {
    // A lower bound that holds at any angle: it excludes most of many boxes.
    const Vector2d from = point - box.position;
    const double enough = least + box.half.x() + box.half.y() + kSame;
    if (from.squaredNorm() > enough * enough) continue;
    const Vector2d local = Turned(from, -box.angle);
    const Vector2d out = (local.cwiseAbs() - box.half).cwiseMax(0.0);
    if (out.norm() < least) {
      least = out.norm();
      nearest = box.id;
    }
  }
  return nearest;
}

}  // namespace seam
