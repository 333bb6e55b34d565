#include "common/topology/topology.h"

#include <algorithm>
#include <cmath>

#include "common/base/check.h"
#include "common/base/geometry.h"
#include "common/scene/bricks.h"
#include "common/scene/mass.h"
#include "common/scene/scene_limits.h"
#include "common/topology/bond_move.h"
#include "common/topology/feather_blast.h"
#include "common/topology/feather_fall.h"
#include "common/topology/grip.h"

namespace seam {
namespace {

/// Largest offset of a bond, m: no assembly is larger.
constexpr float kBondDistanceMax = 1000;
/// Largest angle of a bond: one turn. Sines of huge angles are noise, and Box2D asserts.
constexpr float kBondAngleMax = 2 * kPiFloat;

}  // namespace

Topology::Topology(const Scene& scene)
    : scene_(scene), composition_(Compose(scene_)), slots_(scene.joints.size()) {
  KeepGround();
}

bool Topology::Has(PartId part) const {
  return part >= 0 && part < static_cast<PartId>(scene_.parts.size()) &&
         !scene_.parts[static_cast<std::size_t>(part)].gone;
}

void Topology::UpdateComposition() {
  if (!stale_) return;
  stale_ = false;
  composition_ = Compose(scene_);
}

bool Topology::RoomFor(std::size_t more) const {
  return CountLiving(scene_.parts) + more <= kPartsMax && scene_.parts.size() + more <= kPartsEver;
}

bool Topology::HasJoint(std::int32_t joint) const {
  return joint >= 0 && static_cast<std::size_t>(joint) < scene_.joints.size();
}

Status Topology::ValidateBond(const BondEdit& bond) const {
  if (!Has(bond.a) || !Has(bond.b)) return Status::Error("there is no such part");
  const bool finite = bond.position.allFinite() && std::isfinite(bond.strength);
  if (!finite || bond.position.cwiseAbs().maxCoeff() > kBondDistanceMax || bond.strength < 0) {
    return Status::Error("a bond over such a distance is not possible");
  }
  if (!(std::fabs(bond.angle) <= kBondAngleMax)) {
    return Status::Error("a bond's angle is at most a turn");
  }
  const int a = composition_.assembly_of_part[static_cast<std::size_t>(bond.a)];
  const int b = composition_.assembly_of_part[static_cast<std::size_t>(bond.b)];
  if (a == b) return Status::Error("they are one body already");
  const auto& all = composition_.assemblies;
  if (all[static_cast<std::size_t>(a)].anchored && all[static_cast<std::size_t>(b)].anchored) {
    return Status::Error("both are anchored");
  }
  if (bond.cause == BondCause::kGrip) {
    return MayGrip(scene_, bond) ? Status::Ok() : Status::Error("no hand that may hold it so");
  }
  if (!FitsTogether(scene_, composition_, bond)) {
    return Status::Error("a bond over such a distance is not possible");
  }
  return Status::Ok();
}

Status Topology::ValidateInsert(const InsertEdit& insert) const {
  if (insert.text.size() > kEditTextMax) return Status::Error("the text is too long");
  Scene scene = scene_;
  try {
    AddToScene(insert.text, &scene);
  } catch (const OperatorError& e) {
    return Status::Error(e.what());
  }
  return Status::Ok();
}

Status Topology::Validate(const Edit& edit) const {
  const auto has = [this](PartId part) {
    return Has(part) ? Status::Ok() : Status::Error("there is no such part");
  };
  return std::visit(
      Overloaded{[&](const std::monostate&) { return Status::Error("it is no edit"); },
                 [&](const BreakEdit& broken) {
                   const bool there = HasJoint(broken.joint) &&
                                      !scene_.joints[static_cast<std::size_t>(broken.joint)].gone;
                   return there ? Status::Ok() : Status::Error("there is no such joint");
                 },
                 [&](const BondEdit& bond) { return ValidateBond(bond); },
                 [&](const InsertEdit& insert) { return ValidateInsert(insert); },
                 [&](const RemoveEdit& remove) { return has(remove.part); },
                 [&](const FreeEdit& free) { return has(free.part); },
                 [&](const PushEdit& push) {
                   const bool possible = push.impulse.norm() <= kImpulseMax &&
                                         std::abs(push.turn) <= kImpulseMax &&
                                         std::isfinite(push.limp);
                   return possible ? has(push.part)
                                   : Status::Error("the impulse is not finite, or above 1e9 N s");
                 },
                 [&](const SeatEdit& seat) {
                   if (seat.seat < 0 ||
                       static_cast<std::size_t>(seat.seat) >= scene_.seats.size()) {
                     return Status::Error("there is no such seat");
                   }
                   const auto players = static_cast<std::int32_t>(scene_.players.size());
                   const bool known = seat.player >= -1 && seat.player < players;
                   return known ? Status::Ok() : Status::Error("there is no such player");
                 },
                 [&](const BlastEdit& blast) {
                   if (!Possible(BlastOf(blast))) {
                     return Status::Error("the blast is too large, too fast or too far away");
                   }
                   if (blast.impulse > 0) return Status::Ok();  // pushes even without bricks
                   if (scene_.bricks.empty()) return Status::Error("there are no bricks");
                   return RoomFor(kBlastPiecesMax + kFallPiecesMax)
                              ? Status::Ok()
                              : Status::Error("there are too many parts");
                 }},
      edit.what);
}

std::vector<PartId> Topology::PartsOf(const Edit& edit) const {
  std::vector<PartId> parts;
  const auto add = [&](PartId part) {
    if (Has(part)) parts.push_back(part);
  };
  const auto add_both = [&](const Joint& joint) {
    add(joint.a);
    add(joint.b);
  };
  std::visit(
      Overloaded{[](const std::monostate&) {}, [](const SeatEdit&) {}, [](const BlastEdit&) {},
                 [&](const BreakEdit& broken) {
                   if (!HasJoint(broken.joint)) return;
                   add_both(scene_.joints[static_cast<std::size_t>(broken.joint)]);
                 },
                 [&](const BondEdit& bond) {
                   add(bond.a);
                   add(bond.b);
                 },
                 [&](const RemoveEdit& remove) { add(remove.part); },
                 [&](const FreeEdit& free) { add(free.part); },
                 [&](const PushEdit& push) { add(push.part); },
                 [&](const InsertEdit& insert) {
                   Scene scene = scene_;
                   try {
                     AddToScene(insert.text, &scene);
                   } catch (const OperatorError&) {
                     return;
                   }
                   for (std::size_t j = scene_.joints.size(); j < scene.joints.size(); ++j) {
                     add_both(scene.joints[j]);
                   }
                 }},
      edit.what);
  return parts;
}

std::vector<Status> Topology::Apply(const std::vector<Edit>& edits) {
  std::vector<Status> results;
  for (const Edit& edit : edits) {
    ++revision_;
    results.push_back(ApplyOne(edit));
  }
  UpdateComposition();
  return results;
}

Status Topology::ApplyOne(const Edit& edit) {
  // Only bonds depend on the composition.
  if (edit.As<BondEdit>() != nullptr) UpdateComposition();
  if (const InsertEdit* insert = edit.As<InsertEdit>()) return Insert(*insert);
  Status status = Validate(edit);
  if (!status.ok()) return status;
  std::visit(
      Overloaded{[](const std::monostate&) {}, [](const InsertEdit&) {}, [](const PushEdit&) {},
                 [&](const BreakEdit& broken) {
                   Break(broken.joint);
                   stale_ = true;
                 },
                 [&](const BondEdit& bond) { Bond(bond); },
                 [&](const RemoveEdit& remove) { Remove(remove.part); },
                 [&](const FreeEdit& free) { Free(free.part); },
                 [&](const SeatEdit& seat) { Sit(seat); },
                 [&](const BlastEdit& blast) { FreeBricks(blast); }},
      edit.what);
  return status;
}

void Topology::Sit(const SeatEdit& seat) {
  if (!Validate(Edit(seat)).ok()) return;
  scene_.seats[static_cast<std::size_t>(seat.seat)].player = seat.player;
}

void Topology::MoveSide(const BondEdit& edit) {
  const auto [moved, moves] = MoveOf(scene_, composition_, edit);
  const auto of_moved = [&, moved = moved](PartId part) {
    return composition_.assembly_of_part[static_cast<std::size_t>(part)] == moved;
  };
  for (const PartId id : composition_.assemblies[static_cast<std::size_t>(moved)].parts) {
    Part& part = scene_.parts[static_cast<std::size_t>(id)];
    const Transform2 place = moves.Then(PlaceOf(part));
    part.position = place.shift.cast<float>();
    part.angle = static_cast<float>(place.angle);
  }
  const auto move = [&, moves = moves](Vec2* point) {
    *point = moves(point->cast<double>()).cast<float>();
  };
  const float turn = static_cast<float>(moves.angle);
  for (Joint& joint : scene_.joints) {
    if (joint.gone) continue;
    if (of_moved(joint.a)) {
      move(&joint.anchor_a);
      joint.axis = moves.Turned(joint.axis.cast<double>()).cast<float>();
      joint.turn -= turn;
    }
    if (of_moved(joint.b)) {
      move(&joint.anchor_b);
      joint.turn += turn;
    }
  }
}

void Topology::Bond(const BondEdit& edit) {
  for (Joint& joint : scene_.joints) {  // "as placed" means before this bond
    if (joint.gone || joint.length > 0) continue;
    joint.length = (joint.anchor_b - joint.anchor_a).norm();
  }
  if (edit.cause != BondCause::kGrip) MoveSide(edit);
  auto slot = static_cast<std::int32_t>(scene_.joints.size());
  if (!free_bonds_.empty()) {
    slot = *free_bonds_.begin();
    free_bonds_.erase(free_bonds_.begin());
  } else {
    scene_.joints.emplace_back();
    slots_.emplace_back();
  }
  PutBond(slot, edit);
  stale_ = true;
}

void Topology::PutBond(std::int32_t slot, const BondEdit& edit) {
  const Part& a = scene_.parts[static_cast<std::size_t>(edit.a)];
  const Part& b = scene_.parts[static_cast<std::size_t>(edit.b)];
  Joint bond;
  bond.name = "bond." + std::to_string(slot);
  bond.kind = JointKind::kGlue;
  bond.a = edit.a;
  bond.b = edit.b;
  bond.anchor_a = bond.anchor_b = b.position;
  bond.strength = edit.strength;
  bond.grouped = edit.cause == BondCause::kGroup;
  if (edit.cause == BondCause::kGrip) {
    // The parts' places in the scene need not fit together: each end is given on its own part.
    bond.kind = JointKind::kRevolute;
    bond.anchor_a = a.position + Turned(edit.position, a.angle);
    bond.anchor_b = b.position + Turned(FingertipOf(scene_, edit.b).value_or(Vec2(0, 0)), b.angle);
    bond.collide = true;
  }
  scene_.joints[static_cast<std::size_t>(slot)] = bond;
  slots_[static_cast<std::size_t>(slot)] = {revision_, true};
}

Status Topology::Insert(const InsertEdit& edit) {
  if (edit.text.size() > kEditTextMax) return Status::Error("the text is too long");
  try {
    AddToScene(edit.text, &scene_);
  } catch (const OperatorError& e) {
    return Status::Error(e.what());
  }
  slots_.resize(scene_.joints.size(), Slot{revision_, false});
  stale_ = true;
  return Status::Ok();
}

void Topology::Break(std::int32_t joint) {
  scene_.joints[static_cast<std::size_t>(joint)].gone = true;
  if (IsBond(joint)) free_bonds_.insert(joint);
  for (std::size_t j = 0; j < scene_.joints.size();
       ++j) {  // a gear ends with either of its joints, a spring with its slide
    const Joint& gear = scene_.joints[j];
    const bool on_it = gear.coupled[0] == joint || gear.coupled[1] == joint;
    if (on_it && !gear.gone) Break(static_cast<std::int32_t>(j));
  }
}

void Topology::Free(PartId part) {
  bool& anchored = scene_.parts[static_cast<std::size_t>(part)].anchored;
  if (!anchored) return;
  anchored = false;
  stale_ = true;
  RecordHanging(part);
}

void Topology::Remove(PartId part) {
  scene_.parts[static_cast<std::size_t>(part)].gone = true;
  for (std::size_t j = 0; j < scene_.joints.size(); ++j) {
    const Joint& joint = scene_.joints[j];
    const bool held = joint.a == part || joint.b == part;
    if (held && !joint.gone) Break(static_cast<std::int32_t>(j));
  }
  stale_ = true;
  RecordHanging(part);
}

}  // namespace seam
