#include "server/rules/tearing.h"

#include <algorithm>
#include <limits>

#include "common/base/geometry.h"
#include "common/physics/part_places.h"

namespace seam {
namespace {

const Part& PartWith(const World& world, PartId id) {
  return world.scene().parts[static_cast<std::size_t>(id)];
}

const Joint& JointAt(const World& world, int joint) {
  return world.scene().joints[static_cast<std::size_t>(joint)];
}

/// Returns -1 for a part that is gone or anchored.
int BodyWith(const World& world, PartId id) {
  const Composition& c = world.composition();
  const int assembly = c.assembly_of_part[static_cast<std::size_t>(id)];
  return assembly < 0 ? -1 : world.BodyOfId(c.assemblies[static_cast<std::size_t>(assembly)].id);
}

/// Returns the width of the part in a pose, seen along a unit vector, m.
float WidthAcross(const Part& part, const BodyState& pose, const Vec2& along) {
  const Vec2 across(-along.y(), along.x());
  float least = 0, most = 0;
  for (const Vec2& point : part.points) {
    const float at = Turned(point, pose.angle).dot(across);
    least = std::min(least, at);
    most = std::max(most, at);
  }
  return most - least + (part.points.empty() ? 2 * part.radius : 0);
}

/// Finds the overloaded joints of one character.
class Overload {
 public:
  Overload(const World& world, const Character& character,
           const std::function<BodyState(int body)>& read)
      : world_(world), character_(character), read_(read) {}

  /// Returns the joint of the struck body that is nearest to the point; -1 if it has none.
  int Nearest(const Blow& blow) const {
    int nearest = -1;
    float least = std::numeric_limits<float>::max();
    for (const int index : character_.joints) {
      const Joint& joint = JointAt(world_, index);
      if (joint.gone) continue;
      const bool on_b = BodyWith(world_, joint.b) == blow.body;
      if (!on_b && BodyWith(world_, joint.a) != blow.body) continue;
      const PartId id = on_b ? joint.b : joint.a;
      BodyState pose;
      if (!ReadPart(world_, id, read_, &pose)) continue;
      const Part& part = PartWith(world_, id);
      const Vec2 arm = (on_b ? joint.anchor_b : joint.anchor_a) - part.position;
      const Vec2 place = pose.position + Turned(arm, pose.angle - part.angle);
      const float distance = (place - blow.point).norm();
      if (distance >= least) continue;
      least = distance;
      nearest = index;
    }
    return nearest;
  }

  /// Returns the change of the part's velocity by a blast, m/s.
  Vec2 Change(const BlastEdit& blast, PartId id) const {
    const int body = BodyWith(world_, id);
    BodyState pose;
    if (body < 0 || !ReadPart(world_, id, read_, &pose)) return {0, 0};
    const Vec2 ray = pose.position - blast.centre;
    const float distance = ray.norm();
    if (distance <= 0 || distance >= blast.radius) return {0, 0};
    if (world_.FreeWay(body, blast.centre, pose.position) < 1) return {0, 0};
    const Vec2 along = ray / distance;
    const float impulse = blast.impulse * (1 - distance / blast.radius);
    return impulse * WidthAcross(PartWith(world_, id), pose, along) / world_.mass(body) * along;
  }

 private:
  const World& world_;
  const Character& character_;
  const std::function<BodyState(int body)>& read_;
};

}  // namespace

std::vector<int> OverloadedJoints(const World& world, const Character& character,
                                  const Violence& violence,
                                  const std::function<BodyState(int body)>& read) {
  const Overload overload(world, character, read);
  std::vector<int> torn;
  for (const Blow& blow : violence.blows) {
    if (blow.dv <= character.tears_above) continue;
    const int nearest = overload.Nearest(blow);
    if (nearest >= 0) torn.push_back(nearest);
  }
  for (const int index : character.joints) {
    const Joint& joint = JointAt(world, index);
    Vec2 apart(0, 0);
    for (const BlastEdit& blast : violence.blasts) {
      apart += overload.Change(blast, joint.a) - overload.Change(blast, joint.b);
    }
    if (!joint.gone && apart.norm() > character.tears_above) torn.push_back(index);
  }
  std::sort(torn.begin(), torn.end());
  torn.erase(std::unique(torn.begin(), torn.end()), torn.end());
  return torn;
}

}  // namespace seam
