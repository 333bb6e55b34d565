#include "common/topology/topology_builder.h"

#include <algorithm>
#include <cmath>

#include "common/base/check.h"
#include "common/scene/scene_limits.h"
#include "common/topology/grip.h"

namespace seam {
namespace {

/// Most joint indices: all joints ever inserted, and one bond less than there are parts.
constexpr std::size_t kJointPlacesMax = kJointsEver + kPartsMax;
/// Largest deviation of an axis from unit length, for rounding.
constexpr float kAxisOff = 0.1f;

bool Within(float value, float most) { return std::fabs(value) <= most; }  // false for NaN

bool IsPlace(float x, float y) { return Within(x, kPlaceMax) && Within(y, kPlaceMax); }

}  // namespace

bool TopologyBuilder::HasLivingJoint(std::int32_t joint) const {
  return topology_.HasJoint(joint) &&
         !topology_.scene_.joints[static_cast<std::size_t>(joint)].gone;
}

Status TopologyBuilder::Add(const TopologyEntry& entry) {
  const std::array<float, TopologyEntry::kValuesMax>& v = entry.value;
  switch (entry.kind) {
    case TopologyEntry::Kind::kParts: return AddParts(entry);
    case TopologyEntry::Kind::kJoints:
    case TopologyEntry::Kind::kBonds: return AddJoints(entry);
    case TopologyEntry::Kind::kInsert: return Insert(entry);
    case TopologyEntry::Kind::kBlast:
      return topology_.ApplyOne(Edit(BlastEdit{{v[0], v[1]}, v[2], v[3]}));
    case TopologyEntry::Kind::kRemove: return topology_.ApplyOne(Edit(RemoveEdit{entry.a}));
    case TopologyEntry::Kind::kFree: return topology_.ApplyOne(Edit(FreeEdit{entry.a}));
    case TopologyEntry::Kind::kBreak: return topology_.ApplyOne(Edit(BreakEdit{entry.joint}));
    case TopologyEntry::Kind::kPlace: return Place(entry);
    case TopologyEntry::Kind::kMeasured: return Measure(entry);
    case TopologyEntry::Kind::kBond: return Bond(entry);
    case TopologyEntry::Kind::kEnds: return SetEnds(entry);
    case TopologyEntry::Kind::kSeat: return topology_.ApplyOne(Edit(SeatEdit{entry.a, entry.b}));
  }
  return Status::Error("there is no such entry");
}

Status TopologyBuilder::AddParts(const TopologyEntry& entry) {
  std::vector<Part>& parts = topology_.scene_.parts;
  const auto count = static_cast<std::size_t>(std::max(entry.a, 0));
  if (count < parts.size() || count > kPartsEver) return Status::Error("a wrong number of parts");
  while (parts.size() < count) {
    Part left;
    left.id = static_cast<PartId>(parts.size());
    left.gone = true;
    parts.push_back(std::move(left));
  }
  return Status::Ok();
}

Status TopologyBuilder::AddJoints(const TopologyEntry& entry) {
  std::vector<Joint>& joints = topology_.scene_.joints;
  const auto count = static_cast<std::size_t>(std::max(entry.joint, 0));
  if (count < joints.size() || count > kJointPlacesMax) {
    return Status::Error("a wrong number of joints");
  }
  const bool bonds = entry.kind == TopologyEntry::Kind::kBonds;
  Joint gone;
  gone.gone = true;
  while (joints.size() < count) {
    if (bonds) topology_.free_bonds_.insert(static_cast<std::int32_t>(joints.size()));
    joints.push_back(gone);
    topology_.slots_.push_back({0, bonds});
  }
  return Status::Ok();
}

Status TopologyBuilder::Insert(const TopologyEntry& entry) {
  if (entry.text.size() > kEditTextMax) return Status::Error("the text is too long");
  Scene& scene = topology_.scene_;
  try {
    AddToScene(entry.text, &scene, false);  // the composition is not yet known
  } catch (const OperatorError& e) {
    return Status::Error(e.what());
  }
  topology_.slots_.resize(scene.joints.size());
  return Status::Ok();
}

Status TopologyBuilder::Place(const TopologyEntry& entry) {
  const std::array<float, TopologyEntry::kValuesMax>& v = entry.value;
  if (!topology_.Has(entry.a)) return Status::Error("there is no such part");
  if (!IsPlace(v[0], v[1]) || !Within(v[2], kTurnMax)) return Status::Error("no place for a part");
  Part& part = topology_.scene_.parts[static_cast<std::size_t>(entry.a)];
  part.position = {v[0], v[1]};
  part.angle = v[2];
  return Status::Ok();
}

Status TopologyBuilder::Measure(const TopologyEntry& entry) {
  std::vector<Joint>& joints = topology_.scene_.joints;
  if (entry.joint < 0 || static_cast<std::size_t>(entry.joint) > joints.size()) {
    return Status::Error("there are fewer joints");
  }
  for (std::size_t j = 0; j < static_cast<std::size_t>(entry.joint); ++j) {
    Joint& joint = joints[j];
    if (!joint.gone && joint.length <= 0) joint.length = (joint.anchor_b - joint.anchor_a).norm();
  }
  return Status::Ok();
}

Status TopologyBuilder::Bond(const TopologyEntry& entry) {
  const auto free = topology_.free_bonds_.find(entry.joint);
  if (free == topology_.free_bonds_.end()) return Status::Error("there is no place for that bond");
  const bool apart = topology_.Has(entry.a) && topology_.Has(entry.b) && entry.a != entry.b;
  if (!apart) return Status::Error("a bond of what is not there");
  const float strength = entry.value[0];
  if (!(strength >= 0) || !std::isfinite(strength)) return Status::Error("no strength of a bond");
  topology_.free_bonds_.erase(free);
  const BondCause cause = entry.value[1] == 1   ? BondCause::kGroup
                          : entry.value[1] == 2 ? BondCause::kGrip
                                                : BondCause::kGiven;
  if (cause == BondCause::kGrip && CharacterOfHand(topology_.scene_, entry.b) < 0) {
    return Status::Error("a grip without a hand");
  }
  BondEdit bond{entry.a, entry.b, {0, 0}, 0, strength, cause};
  topology_.PutBond(entry.joint, bond);
  topology_.scene_.joints[static_cast<std::size_t>(entry.joint)].length = 0;  // see Measure
  return Status::Ok();
}

Status TopologyBuilder::SetEnds(const TopologyEntry& entry) {
  const std::array<float, TopologyEntry::kValuesMax>& v = entry.value;
  if (!HasLivingJoint(entry.joint)) return Status::Error("there is no such joint");
  const bool axis = Within(Vec2(v[4], v[5]).norm() - 1, kAxisOff);
  const bool possible = IsPlace(v[0], v[1]) && IsPlace(v[2], v[3]) && axis &&
                        Within(v[6], kTurnMax) && Within(v[7], kPlaceMax);
  if (!possible) return Status::Error("no ends of a joint");
  Joint& joint = topology_.scene_.joints[static_cast<std::size_t>(entry.joint)];
  joint.anchor_a = {v[0], v[1]};
  joint.anchor_b = {v[2], v[3]};
  joint.axis = {v[4], v[5]};
  joint.turn = v[6];
  joint.length = v[7];
  return Status::Ok();
}

Status TopologyBuilder::Finish(int revision) {
  const Scene& scene = topology_.scene_;
  topology_.stale_ = true;
  topology_.UpdateComposition();
  for (const Assembly& assembly : topology_.composition_.assemblies) {
    const Vec2 root = scene.parts[static_cast<std::size_t>(assembly.id)].position;
    for (const PartId id : assembly.parts) {
      const Vec2 place = scene.parts[static_cast<std::size_t>(id)].position;
      if (!((place - root).norm() <= kReachEver)) {
        return Status::Error("parts of one body are too far apart");
      }
    }
  }
  topology_.revision_ = revision;
  for (Topology::Slot& slot : topology_.slots_) slot.made_at = revision;
  return Status::Ok();
}

}  // namespace seam
