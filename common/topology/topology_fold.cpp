#include "common/topology/topology_fold.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "common/topology/grip.h"

namespace seam {
namespace {

using Kind = TopologyEntry::Kind;

/// Pruning takes place when there are twice as many steps as after the last, plus this many.
constexpr std::size_t kPruneSlack = 256;

/// Compares bitwise: 0 on one peer and -0 on another would be two different worlds.
bool SameBits(const float* a, const float* b, std::size_t count) {
  return std::memcmp(a, b, count * sizeof *a) == 0;
}

TopologyEntry PlaceEntry(const Part& part) {
  TopologyEntry entry;
  entry.kind = Kind::kPlace;
  entry.a = part.id;
  entry.value = {part.position.x(), part.position.y(), part.angle};
  return entry;
}

TopologyEntry EndsEntry(const Joint& joint, std::int32_t index) {
  TopologyEntry entry;
  entry.kind = Kind::kEnds;
  entry.joint = index;
  entry.value = {joint.anchor_a.x(), joint.anchor_a.y(), joint.anchor_b.x(), joint.anchor_b.y(),
                 joint.axis.x(),     joint.axis.y(),     joint.turn,         joint.length};
  return entry;
}

TopologyEntry Count(Kind kind, std::size_t count) {
  TopologyEntry entry;
  entry.kind = kind;
  (kind == Kind::kParts ? entry.a : entry.joint) = static_cast<std::int32_t>(count);
  return entry;
}

/// Returns true if the topology's last edit made a bond.
bool LastEditMadeBond(const Topology& now) {
  for (std::size_t j = 0; j < now.scene().joints.size(); ++j) {
    const auto index = static_cast<std::int32_t>(j);
    if (now.IsBond(index) && now.JointMadeAt(index) == now.revision()) return true;
  }
  return false;
}

/// Appends a count; replaces a preceding count of the same kind.
void AddCount(Kind kind, std::size_t count, std::vector<TopologyEntry>* entries) {
  if (!entries->empty() && entries->back().kind == kind) entries->pop_back();
  entries->push_back(Count(kind, count));
}

}  // namespace

TopologyFold::TopologyFold(const Topology& begin) : first_joints_(begin.scene().joints.size()) {
  RecordGrowth(begin);
  for (const Seat& seat : begin.scene().seats) first_players_.push_back(seat.player);
}

void TopologyFold::RecordGrowth(const Topology& now) {
  const Scene& scene = now.scene();
  for (std::size_t p = first_poses_.size(); p < scene.parts.size(); ++p) {
    first_poses_.push_back({scene.parts[p].position, scene.parts[p].angle});
  }
  for (std::size_t j = first_joint_data_.size(); j < scene.joints.size(); ++j) {
    first_joint_data_.push_back(now.IsBond(static_cast<std::int32_t>(j)) ? Joint()
                                                                         : scene.joints[j]);
  }
  left_.resize(scene.parts.size(), false);
  freed_.resize(scene.parts.size(), false);
  broken_.resize(scene.joints.size(), false);
}

void TopologyFold::RecordInsert(const InsertEdit& insert, const Topology& now) {
  const Scene& scene = now.scene();
  Step step{insert,
            first_poses_.size(),
            scene.parts.size(),
            first_joint_data_.size(),
            scene.joints.size(),
            {}};
  for (std::size_t j = step.joints_before; j < step.joints_after; ++j) {
    for (const PartId part : {scene.joints[j].a, scene.joints[j].b}) {
      if (static_cast<std::size_t>(part) >= step.parts_before) continue;
      step.named.push_back(PlaceEntry(scene.parts[static_cast<std::size_t>(part)]));
    }
  }
  steps_.push_back(std::move(step));
}

void TopologyFold::RecordGearsOf(std::int32_t joint, const Scene& scene) {
  for (std::size_t j = 0; j < broken_.size(); ++j) {
    const auto& coupled = scene.joints[j].coupled;
    if (coupled[0] == joint || coupled[1] == joint) broken_[j] = true;
  }
}

void TopologyFold::Note(const Edit& edit, const Topology& now) {
  const Scene& scene = now.scene();
  const auto once = [&](AnyEdit what, std::vector<bool>* noted, std::int32_t index) {
    if ((*noted)[static_cast<std::size_t>(index)]) return;
    (*noted)[static_cast<std::size_t>(index)] = true;
    steps_.push_back({std::move(what),
                      first_poses_.size(),
                      first_poses_.size(),
                      first_joint_data_.size(),
                      first_joint_data_.size(),
                      {}});
  };
  // An edit that failed left no trace in `now`.
  const auto is_part = [&](PartId part) {
    return part >= 0 && static_cast<std::size_t>(part) < scene.parts.size();
  };
  const bool grown =
      scene.parts.size() > first_poses_.size() || scene.joints.size() > first_joint_data_.size();
  std::visit(
      Overloaded{[](const std::monostate&) {}, [](const PushEdit&) {}, [](const SeatEdit&) {},
                 [&](const BondEdit&) {
                   if (LastEditMadeBond(now)) measured_ = scene.joints.size();
                 },
                 [&](const BreakEdit& broken) {
                   if (!now.HasJoint(broken.joint) || now.IsBond(broken.joint)) return;
                   once(broken, &broken_, broken.joint);
                   RecordGearsOf(broken.joint, scene);
                 },
                 [&](const RemoveEdit& removed) {
                   if (!is_part(removed.part)) return;
                   once(removed, &left_, removed.part);
                   for (std::size_t j = 0; j < broken_.size(); ++j) {
                     const Joint& joint = scene.joints[j];
                     const bool held = joint.a == removed.part || joint.b == removed.part;
                     if (!held) continue;
                     broken_[j] = true;  // the removal implies it
                     RecordGearsOf(static_cast<std::int32_t>(j), scene);
                   }
                 },
                 [&](const FreeEdit& freed) {
                   const bool there = is_part(freed.part) &&
                                      !scene.parts[static_cast<std::size_t>(freed.part)].gone;
                   if (there) once(freed, &freed_, freed.part);
                 },
                 [&](const InsertEdit& insert) {
                   if (grown) RecordInsert(insert, now);
                 },
                 [&](const BlastEdit& blast) {
                   if (!grown) return;
                   steps_.push_back({blast,
                                     first_poses_.size(),
                                     scene.parts.size(),
                                     first_joint_data_.size(),
                                     first_joint_data_.size(),
                                     {}});
                 }},
      edit.what);
  RecordGrowth(now);
  if (steps_.size() > 2 * pruned_ + kPruneSlack) Prune(now);
}

std::vector<bool> TopologyFold::Dropped(const Topology& now) const {
  const Scene& scene = now.scene();
  std::vector<bool> dropped(steps_.size(), false);
  std::vector<bool> needed(scene.parts.size(), false), coupled(scene.joints.size(), false);
  std::vector<bool> lost(scene.parts.size(), false), unmade(scene.joints.size(), false);
  for (std::size_t i = steps_.size(); i-- > 0;) {
    const Step& step = steps_[i];
    bool goes = std::get_if<std::monostate>(&step.what) != nullptr;
    if (std::get_if<InsertEdit>(&step.what) != nullptr) {
      goes = true;
      for (std::size_t p = step.parts_before; p < step.parts_after; ++p) {
        goes = goes && scene.parts[p].gone && !needed[p];
      }
      for (std::size_t j = step.joints_before; j < step.joints_after; ++j) {
        goes = goes && scene.joints[j].gone && !coupled[j];
      }
      for (std::size_t j = step.joints_before; !goes && j < step.joints_after; ++j) {
        for (const int named : scene.joints[j].coupled) {  // by a gear
          if (named >= 0) coupled[static_cast<std::size_t>(named)] = true;
        }
      }
      for (const TopologyEntry& place : step.named) {
        if (!goes) needed[static_cast<std::size_t>(place.a)] = true;
      }
    }
    if (!goes) continue;
    dropped[i] = true;
    for (std::size_t p = step.parts_before; p < step.parts_after; ++p) lost[p] = true;
    for (std::size_t j = step.joints_before; j < step.joints_after; ++j) unmade[j] = true;
  }
  // Parts and joints that are never made need not be removed.
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const AnyEdit& what = steps_[i].what;
    if (const auto* e = std::get_if<RemoveEdit>(&what)) {
      dropped[i] = lost[static_cast<std::size_t>(e->part)];
    } else if (const auto* f = std::get_if<FreeEdit>(&what)) {
      dropped[i] = lost[static_cast<std::size_t>(f->part)];
    } else if (const auto* b = std::get_if<BreakEdit>(&what)) {
      dropped[i] = unmade[static_cast<std::size_t>(b->joint)];
    }
  }
  return dropped;
}

void TopologyFold::Prune(const Topology& now) {
  const std::vector<bool> dropped = Dropped(now);
  std::vector<Step> kept;
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    Step& step = steps_[i];
    const bool made =
        step.parts_after > step.parts_before || step.joints_after > step.joints_before;
    if (dropped[i] && !made) continue;
    if (dropped[i]) {
      step.what = std::monostate{};
      step.named.clear();
      Step* last = kept.empty() ? nullptr : &kept.back();
      const bool follows = last != nullptr && last->what.index() == 0 &&
                           last->parts_after == step.parts_before &&
                           last->joints_after == step.joints_before;
      if (follows) {
        last->parts_after = step.parts_after;
        last->joints_after = step.joints_after;
        continue;
      }
    }
    kept.push_back(std::move(step));
  }
  steps_ = std::move(kept);
  pruned_ = steps_.size();
}

void TopologyFold::AddSteps(const Topology& now, std::vector<TopologyEntry>* entries) const {
  const std::vector<bool> dropped = Dropped(now);
  const std::size_t all_joints = now.scene().joints.size();
  std::size_t joints = first_joints_;
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const Step& step = steps_[i];
    const bool made =
        step.parts_after > step.parts_before || step.joints_after > step.joints_before;
    if (dropped[i] && !made) continue;
    if (made && step.joints_before > joints) AddCount(Kind::kBonds, step.joints_before, entries);
    if (made) joints = step.joints_after;
    TopologyEntry entry;
    if (dropped[i]) {
      if (step.joints_after > step.joints_before) {
        AddCount(Kind::kJoints, step.joints_after, entries);
      }
      if (step.parts_after > step.parts_before) AddCount(Kind::kParts, step.parts_after, entries);
      continue;
    }
    if (const auto* insert = std::get_if<InsertEdit>(&step.what)) {
      entries->insert(entries->end(), step.named.begin(), step.named.end());
      entry.kind = Kind::kInsert;
      entry.text = insert->text;
    } else if (const auto* blast = std::get_if<BlastEdit>(&step.what)) {
      entry.kind = Kind::kBlast;
      entry.value = {blast->centre.x(), blast->centre.y(), blast->radius, blast->speed};
    } else if (const auto* removed = std::get_if<RemoveEdit>(&step.what)) {
      entry.kind = Kind::kRemove;
      entry.a = removed->part;
    } else if (const auto* freed = std::get_if<FreeEdit>(&step.what)) {
      entry.kind = Kind::kFree;
      entry.a = freed->part;
    } else if (const auto* broken = std::get_if<BreakEdit>(&step.what)) {
      entry.kind = Kind::kBreak;
      entry.joint = broken->joint;
    }
    entries->push_back(std::move(entry));
  }
  if (all_joints > joints) AddCount(Kind::kBonds, all_joints, entries);
}

void TopologyFold::AddPlaces(const Topology& now, std::vector<TopologyEntry>* entries) const {
  std::vector<Place> placed = first_poses_;
  for (const TopologyEntry& entry : *entries) {
    if (entry.kind != Kind::kPlace) continue;
    placed[static_cast<std::size_t>(entry.a)] = {{entry.value[0], entry.value[1]}, entry.value[2]};
  }
  for (const Part& part : now.scene().parts) {
    if (part.gone) continue;
    const Place& place = placed[static_cast<std::size_t>(part.id)];
    const bool same = SameBits(part.position.data(), place.position.data(), 2) &&
                      SameBits(&part.angle, &place.angle, 1);
    if (!same) entries->push_back(PlaceEntry(part));
  }
}

void TopologyFold::AddJoints(const Topology& now, std::vector<TopologyEntry>* entries) const {
  const Scene& scene = now.scene();
  if (measured_ > 0) entries->push_back(Count(Kind::kMeasured, measured_));
  for (std::size_t j = 0; j < scene.joints.size(); ++j) {
    const Joint& joint = scene.joints[j];
    if (joint.gone) continue;
    const auto index = static_cast<std::int32_t>(j);
    Joint given = first_joint_data_[j];
    if (now.IsBond(index)) {
      TopologyEntry bond;
      bond.kind = Kind::kBond;
      bond.joint = index;
      bond.a = joint.a;
      bond.b = joint.b;
      bond.value = {joint.strength, IsGrip(joint) ? 2.0f : joint.grouped ? 1.0f : 0.0f};
      entries->push_back(bond);
      given.anchor_a = given.anchor_b = scene.parts[static_cast<std::size_t>(joint.b)].position;
      given.length = 0;
    } else if (j < measured_ && given.length <= 0) {
      given.length = (given.anchor_b - given.anchor_a).norm();
    }
    const TopologyEntry ends = EndsEntry(joint, index);
    const bool same =
        SameBits(ends.value.data(), EndsEntry(given, index).value.data(), ValuesOf(Kind::kEnds));
    if (!same) entries->push_back(ends);
  }
}

std::vector<TopologyEntry> TopologyFold::Entries(const Topology& now) const {
  std::vector<TopologyEntry> entries;
  AddSteps(now, &entries);
  AddPlaces(now, &entries);
  AddJoints(now, &entries);
  for (std::size_t s = 0; s < first_players_.size(); ++s) {
    const int player = now.scene().seats[s].player;
    if (player == first_players_[s]) continue;
    TopologyEntry seat;
    seat.kind = Kind::kSeat;
    seat.a = static_cast<std::int32_t>(s);
    seat.b = player;
    entries.push_back(seat);
  }
  return entries;
}

}  // namespace seam
