#include <cctype>
#include <cmath>

#include "common/physics/scene_draft.h"
#include "common/physics/scene_limits.h"

namespace seam {
namespace {

JointKind ReadKind(const SceneReader& r) {
  const std::string kind = r.Text("kind");
  if (kind == "weld") return JointKind::kWeld;
  if (kind == "glue") return JointKind::kGlue;
  if (kind == "revolute") return JointKind::kRevolute;
  if (kind == "wheel") return JointKind::kWheel;
  if (kind == "distance") return JointKind::kDistance;
  r.FailAt("kind", "kind must be weld, glue, revolute, wheel or distance");
}

/// Complains about a key that this kind of joint would ignore.
void Refuse(const SceneReader& r, std::initializer_list<const char*> keys, const char* kind) {
  for (const char* key : keys) {
    if (r.Has(key)) r.FailAt(key, std::string("a ") + kind + " joint has no " + key);
  }
}

void ReadLimits(const SceneReader& r, Joint* joint) {
  if (!r.Has("limits")) return;
  const Vec2 limits = r.Vector("limits", {-100, 100});
  joint->limited = true;
  joint->lower = limits.x();
  joint->upper = limits.y();
  if (joint->lower > joint->upper) r.FailAt("limits", "the lower limit is above the upper");
}

void ReadAxis(const SceneReader& r, Joint* joint) {
  const Eigen::Vector2d axis = r.Vector("axis", {-1000, 1000}, Vec2(0, 1)).cast<double>();
  const double length = std::sqrt(axis.x() * axis.x() + axis.y() * axis.y());
  if (length < 1e-3) r.FailAt("axis", "axis is too short to have a direction");
  joint->axis = (axis / length).cast<float>();
}

void ReadSpring(const SceneReader& r, Joint* joint) {
  joint->frequency_hz = r.Number("frequency", {0, 60}, 0.0f);
  joint->damping_ratio = r.Number("damping_ratio", {0, 10}, joint->damping_ratio);
}

void ReadMotor(const SceneReader& r, const SceneDraft& draft, Joint* joint) {
  const TomlNode* table = r.Table("motor");
  if (table == nullptr) return;
  const SceneReader m(*table, draft.file, r.what() + ": motor", {"player", "speed", "torque"});
  joint->motor_speed = m.Number("speed", {-1000, 1000});
  joint->motor_torque = m.Number("torque", {1e-6, 1e7});
  if (m.Has("player")) joint->motor_player = FindPlayer(m, "player", m.Text("player"), draft);
}

/// Where the ends are: at the parts' positions unless said otherwise.
void ReadDistance(const SceneReader& r, const SceneDraft& draft, Joint* joint) {
  const auto position = [&](PartId part) {
    return draft.scene.parts[static_cast<std::size_t>(part)].position;
  };
  joint->anchor_a = r.Vector("anchor_a", kCoordinate, position(joint->a));
  joint->anchor_b = r.Vector("anchor_b", kCoordinate, position(joint->b));
  ReadSpring(r, joint);
  if (r.Has("length")) {
    joint->length = r.Number("length", {kEdgeMin, 10000});
  } else if ((joint->anchor_b - joint->anchor_a).norm() < kEdgeMin) {
    r.Fail("the ends are closer than " + Decimal(kEdgeMin) + " m: give it a length");
  }
}

/// Ends given in the parts' own frames, and the angle between the parts at which the joint is at
/// rest: for what is joined while it moves, where the places in the scene say nothing.
void ReadLocal(const SceneReader& r, const SceneDraft& draft, Joint* joint) {
  const auto place = [&](PartId id, const char* key, Vec2* anchor) {
    if (!r.Has(key)) return;
    if (r.Has("anchor")) r.FailAt(key, std::string("has both anchor and ") + key);
    const Part& part = draft.scene.parts[static_cast<std::size_t>(id)];
    const Eigen::Vector2d local = r.Vector(key, {-1000, 1000}).cast<double>();
    const double c = std::cos(static_cast<double>(part.angle));
    const double s = std::sin(static_cast<double>(part.angle));
    const Eigen::Vector2d turned(c * local.x() - s * local.y(), s * local.x() + c * local.y());
    *anchor = (part.position.cast<double>() + turned).cast<float>();
  };
  if (r.Has("local_a") != r.Has("local_b")) r.Fail("needs local_a and local_b, or neither");
  place(joint->a, "local_a", &joint->anchor_a);
  place(joint->b, "local_b", &joint->anchor_b);
  if (!r.Has("reference_angle")) return;
  const Part& a = draft.scene.parts[static_cast<std::size_t>(joint->a)];
  const Part& b = draft.scene.parts[static_cast<std::size_t>(joint->b)];
  joint->turn = b.angle - a.angle - r.Number("reference_angle", {-1000, 1000});
}

void Add(const SceneReader& r, const Joint& joint, SceneDraft* draft) {
  for (const Joint& other : draft->scene.joints) {
    if (other.name == joint.name) {
      r.FailAt("name", "there is another joint of this name");
    }
  }
  if (draft->scene.joints.size() == kJointsMax) {
    r.Fail("a scene may have at most " + std::to_string(kJointsMax) + " joints");
  }
  draft->scene.joints.push_back(joint);
}

/// The part whose copy number is `by` after that of `part`: "link.0" and {2} is "link.2". A part
/// that is no copy stays.
PartId CopyAfter(const SceneReader& r, PartId part, int column, int row, bool grid,
                 const SceneDraft& draft) {
  const std::string& name = draft.scene.parts[static_cast<std::size_t>(part)].name;
  const std::size_t first = name.find('.');
  if (first == std::string::npos) return part;
  if (std::isdigit(static_cast<unsigned char>(name[first + 1])) == 0) return part;  // a character's
  const std::size_t second = name.find('.', first + 1);
  const bool two = second != std::string::npos;
  if (two != grid) r.FailAt("repeat", "repeat: '" + name + "' is not repeated the same way");
  std::string copy = name.substr(0, first + 1) +
                     std::to_string(std::stoi(name.substr(first + 1)) + column);
  if (two) copy += "." + std::to_string(std::stoi(name.substr(second + 1)) + row);
  const auto found = draft.part_of_name.find(copy);
  if (found == draft.part_of_name.end()) {
    r.FailAt("repeat", "repeat: there is no part '" + copy + "'");
  }
  return found->second;
}

void Copy(const SceneReader& r, const Joint& first, SceneDraft* draft) {
  const Repeat repeat = ReadRepeat(r, draft->file);
  for (int column = 0; column < repeat.columns; ++column) {
    for (int row = 0; row < repeat.rows; ++row) {
      Joint joint = first;
      joint.name += repeat.Suffix(column, row);
      joint.a = CopyAfter(r, first.a, column, row, repeat.grid, *draft);
      joint.b = CopyAfter(r, first.b, column, row, repeat.grid, *draft);
      joint.anchor_a += repeat.Offset(column, row);
      joint.anchor_b += repeat.Offset(column, row);
      Add(r, joint, draft);
    }
  }
}

void ReadJoint(const TomlNode& node, SceneDraft* draft) {
  Joint joint;
  joint.line = node.line;
  SceneReader r(node, draft->file, "joint",
                {"name", "kind", "a", "b", "anchor", "anchor_a", "anchor_b", "axis", "frequency",
                 "damping_ratio", "length", "limits", "collide", "motor", "repeat", "strength",
                 "local_a", "local_b", "reference_angle"});
  joint.name = r.Name("name");
  r.Rename("joint '" + joint.name + "'");
  joint.kind = ReadKind(r);
  joint.a = FindPart(r, "a", *draft);
  joint.b = FindPart(r, "b", *draft);
  if (joint.a == joint.b) r.Fail("joins a part with itself");
  joint.collide = r.Flag("collide", false);

  const Vec2 centre = draft->scene.parts[static_cast<std::size_t>(joint.b)].position;
  if (joint.kind != JointKind::kDistance) {
    joint.anchor_a = joint.anchor_b = r.Vector("anchor", kCoordinate, centre);
    Refuse(r, {"anchor_a", "anchor_b", "length"},
           joint.kind == JointKind::kWeld       ? "weld"
           : joint.kind == JointKind::kGlue     ? "glue"
           : joint.kind == JointKind::kRevolute ? "revolute"
                                                : "wheel");
  }
  switch (joint.kind) {
    case JointKind::kWeld:
      Refuse(r, {"axis", "frequency", "damping_ratio", "limits", "motor", "collide"}, "weld");
      break;
    case JointKind::kGlue:
      Refuse(r, {"axis", "frequency", "damping_ratio", "limits", "motor", "collide"}, "glue");
      joint.strength = r.Number("strength", {0, 1e9});
      break;
    case JointKind::kRevolute:
      Refuse(r, {"axis", "frequency", "damping_ratio"}, "revolute");
      ReadLimits(r, &joint);
      ReadMotor(r, *draft, &joint);
      break;
    case JointKind::kWheel:
      Refuse(r, {"limits"}, "wheel");
      ReadAxis(r, &joint);
      ReadSpring(r, &joint);
      ReadMotor(r, *draft, &joint);
      break;
    case JointKind::kDistance:
      Refuse(r, {"anchor", "axis", "limits", "motor"}, "distance");
      ReadDistance(r, *draft, &joint);
      break;
  }
  if (joint.kind != JointKind::kGlue && r.Has("strength")) {
    r.FailAt("strength", "only glue has a strength");
  }
  ReadLocal(r, *draft, &joint);
  if (r.Has("repeat")) {
    Copy(r, joint, draft);
  } else {
    Add(r, joint, draft);
  }
}

}  // namespace

void ReadJoints(const SceneReader& root, SceneDraft* draft) {
  for (const TomlNode* node : root.Tables("joint")) ReadJoint(*node, draft);
}

}  // namespace seam
