#include "common/topology/topology.h"

#include <algorithm>
#include <cmath>

#include "common/base/check.h"
#include "common/scene/bricks.h"
#include "common/scene/mass.h"
#include "common/scene/scene_limits.h"
#include "common/topology/feather_blast.h"

namespace seam {
namespace {

/// A rigid motion of the plane, in double precision: x -> turn(angle) x + shift.
struct Place {
  Eigen::Vector2d shift{0, 0};
  double angle = 0;

  Eigen::Vector2d Turned(const Eigen::Vector2d& v) const {
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
  }
  Eigen::Vector2d operator()(const Eigen::Vector2d& v) const { return shift + Turned(v); }
  Place Then(const Place& inner) const { return {(*this)(inner.shift), angle + inner.angle}; }
  Place Inverse() const {
    const Place back{{0, 0}, -angle};
    return {-back.Turned(shift), -angle};
  }
};

Blast BlastOf(const Edit& edit) { return {Vec2(edit.x, edit.y), edit.amount, edit.angle}; }

Place PlaceOf(const Part& part) {
  return {part.position.cast<double>(), static_cast<double>(part.angle)};
}

}  // namespace

Topology::Topology(const Scene& scene) : scene_(scene), composition_(Compose(scene_)) {}

bool Topology::Has(PartId part) const {
  return part >= 0 && part < static_cast<PartId>(scene_.parts.size()) &&
         !scene_.parts[static_cast<std::size_t>(part)].gone;
}

void Topology::UpdateComposition() {
  if (!stale_) return;
  stale_ = false;
  composition_ = Compose(scene_);
}

std::string Topology::Complaint(const Edit& edit) const {
  switch (edit.kind) {
    case EditKind::kBreak: {
      const bool known =
          edit.joint >= 0 && edit.joint < static_cast<std::int32_t>(scene_.joints.size());
      if (!known || scene_.joints[static_cast<std::size_t>(edit.joint)].gone) {
        return "there is no such joint";
      }
      return "";
    }
    case EditKind::kBond: {
      if (!Has(edit.a) || !Has(edit.b)) return "there is no such part";
      if (!std::isfinite(edit.x) || !std::isfinite(edit.y) || !std::isfinite(edit.angle) ||
          std::fabs(edit.x) > 1000 || std::fabs(edit.y) > 1000 || edit.amount < 0 ||
          !std::isfinite(edit.amount)) {
        return "a bond over such a distance is not possible";
      }
      const int a = composition_.assembly_of_part[static_cast<std::size_t>(edit.a)];
      const int b = composition_.assembly_of_part[static_cast<std::size_t>(edit.b)];
      if (a == b) return "they are one body already";
      const auto& all = composition_.assemblies;
      if (all[static_cast<std::size_t>(a)].anchored && all[static_cast<std::size_t>(b)].anchored) {
        return "both are anchored";
      }
      return "";
    }
    case EditKind::kInsert: {
      if (edit.text.size() > kEditTextMax) return "the text is too long";
      Scene scene = scene_;
      try {
        AddToScene(edit.text, &scene);
      } catch (const OperatorError& e) {
        return e.what();
      }
      return "";
    }
    case EditKind::kRemove:
    case EditKind::kFree:
    case EditKind::kPush:
      if (!Has(edit.a)) return "there is no such part";
      if (!std::isfinite(edit.x) || !std::isfinite(edit.y) || !std::isfinite(edit.angle)) {
        return "the impulse is not finite";
      }
      return "";
    case EditKind::kSeat: {
      if (edit.a < 0 || edit.a >= static_cast<PartId>(scene_.seats.size())) {
        return "there is no such seat";
      }
      if (edit.player < -1 || edit.player >= static_cast<int>(scene_.players.size())) {
        return "there is no such player";
      }
      return "";
    }
    case EditKind::kBlast: {
      if (!Possible(BlastOf(edit))) return "the blast is too large or too fast";
      if (scene_.bricks.empty()) return "there are no bricks";
      if (scene_.parts.size() + kBlastPiecesMax > kPartsMax) return "there are too many parts";
      return "";
    }
    case EditKind::kNothing: break;
  }
  return "it is no edit";
}

std::vector<PartId> Topology::PartsOf(const Edit& edit) const {
  std::vector<PartId> parts;
  const auto add = [&](PartId part) {
    if (Has(part)) parts.push_back(part);
  };
  if (edit.kind == EditKind::kBreak) {
    if (edit.joint < 0 || edit.joint >= static_cast<std::int32_t>(scene_.joints.size())) return {};
    const Joint& joint = scene_.joints[static_cast<std::size_t>(edit.joint)];
    add(joint.a);
    add(joint.b);
  } else if (edit.kind != EditKind::kSeat && edit.kind != EditKind::kBlast) {
    add(edit.a);
    add(edit.b);
  }
  if (edit.kind == EditKind::kInsert) {
    Scene scene = scene_;
    try {
      AddToScene(edit.text, &scene);
    } catch (const OperatorError&) {
      return parts;
    }
    for (std::size_t j = scene_.joints.size(); j < scene.joints.size(); ++j) {
      add(scene.joints[j].a);
      add(scene.joints[j].b);
    }
  }
  return parts;
}

std::vector<std::string> Topology::Apply(const std::vector<Edit>& edits) {
  std::vector<std::string> complaints;
  for (const Edit& edit : edits) {
    ++revision_;
    std::string complaint = ApplyOne(edit);
    complaints.push_back(std::move(complaint));
  }
  UpdateComposition();
  return complaints;
}

std::string Topology::ApplyOne(const Edit& edit) {
  // Only bonds look at who is one body with whom.
  if (edit.kind == EditKind::kBond) UpdateComposition();
  if (edit.kind != EditKind::kInsert) {
    std::string complaint = Complaint(edit);
    if (!complaint.empty()) return complaint;
  }
  switch (edit.kind) {
    case EditKind::kBreak:
      scene_.joints[static_cast<std::size_t>(edit.joint)].gone = true;
      stale_ = true;
      break;
    case EditKind::kBond: return Bond(edit);
    case EditKind::kInsert: return Insert(edit);
    case EditKind::kRemove:
      Remove(edit.a);
      stale_ = true;
      break;
    case EditKind::kFree:
      scene_.parts[static_cast<std::size_t>(edit.a)].anchored = false;
      stale_ = true;
      break;
    case EditKind::kSeat:
      scene_.seats[static_cast<std::size_t>(edit.a)].player = edit.player;
      break;
    case EditKind::kBlast: {
      const std::vector<Brick> gone = FreedBricks(scene_.bricks, scene_.parts);
      for (Part& part : BlastBricks(scene_.bricks, gone, BlastOf(edit)).parts) {
        part.id = static_cast<PartId>(scene_.parts.size());
        scene_.parts.push_back(std::move(part));
        stale_ = true;
      }
      break;
    }
    case EditKind::kPush:
    case EditKind::kNothing: break;
  }
  return "";
}

std::string Topology::Bond(const Edit& edit) {
  const Part& a = scene_.parts[static_cast<std::size_t>(edit.a)];
  const Part& b = scene_.parts[static_cast<std::size_t>(edit.b)];
  const int assembly_a = composition_.assembly_of_part[static_cast<std::size_t>(edit.a)];
  const int assembly_b = composition_.assembly_of_part[static_cast<std::size_t>(edit.b)];
  // The places of the side that is not anchored move; b's if neither is.
  const bool move_a = composition_.assemblies[static_cast<std::size_t>(assembly_b)].anchored;
  const Place apart{{static_cast<double>(edit.x), static_cast<double>(edit.y)},
                    static_cast<double>(edit.angle)};
  const Place wanted_b = PlaceOf(a).Then(apart);
  const Place b_moves = wanted_b.Then(PlaceOf(b).Inverse());
  const Place moves = move_a ? b_moves.Inverse() : b_moves;
  const int moved = move_a ? assembly_a : assembly_b;
  const auto of_moved = [&](PartId part) {
    return composition_.assembly_of_part[static_cast<std::size_t>(part)] == moved;
  };
  for (const PartId id : composition_.assemblies[static_cast<std::size_t>(moved)].parts) {
    Part& part = scene_.parts[static_cast<std::size_t>(id)];
    const Place place = moves.Then(PlaceOf(part));
    part.position = place.shift.cast<float>();
    part.angle = static_cast<float>(place.angle);
  }
  const auto move = [&](Vec2* point) { *point = moves(point->cast<double>()).cast<float>(); };
  const float turn = static_cast<float>(moves.angle);
  for (Joint& joint : scene_.joints) {
    if (joint.gone) continue;
    // "As placed" was before this.
    if (joint.length <= 0) joint.length = (joint.anchor_b - joint.anchor_a).norm();
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
  Joint glue;
  glue.name = "bond." + std::to_string(scene_.joints.size());
  glue.kind = JointKind::kGlue;
  glue.a = edit.a;
  glue.b = edit.b;
  glue.anchor_a = glue.anchor_b = b.position;
  glue.strength = edit.amount;
  glue.grouped = edit.joint == kBondGroup;
  scene_.joints.push_back(glue);
  stale_ = true;
  return "";
}

std::string Topology::Insert(const Edit& edit) {
  if (edit.text.size() > kEditTextMax) return "the text is too long";
  try {
    AddToScene(edit.text, &scene_);
  } catch (const OperatorError& e) {
    return e.what();
  }
  stale_ = true;
  return "";
}

void Topology::Remove(PartId part) {
  scene_.parts[static_cast<std::size_t>(part)].gone = true;
  for (Joint& joint : scene_.joints) {
    if (joint.a == part || joint.b == part) joint.gone = true;
  }
}

}  // namespace seam
