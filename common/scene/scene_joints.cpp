#include <algorithm>
#include <cctype>
#include <cmath>

#include "common/base/geometry.h"
#include "common/base/nearest.h"
#include "common/scene/joint_kinds.h"
#include "common/scene/joints/read_couplings.h"
#include "common/scene/scene_draft.h"
#include "common/scene/scene_limits.h"

namespace seam {
namespace {

/// Name of a kind of joint, and the keys that it takes besides the common ones.
struct JointName {
  const char* name;
  JointKind kind;
  std::vector<std::string> keys;
};

const std::vector<JointName>& JointNames() {
  static const std::vector<JointName> kinds = {
      {"weld", JointKind::kWeld, {"a", "anchor", "frequency", "damping_ratio", "collide"}},
      {"glue", JointKind::kGlue, {"a", "anchor", "strength"}},
      {"hinge", JointKind::kRevolute, {"a", "anchor", "limits", "motor", "collide"}},
      {"revolute", JointKind::kRevolute, {"a", "anchor", "limits", "motor", "collide"}},
      {"prismatic",
       JointKind::kPrismatic,
       {"a", "anchor", "axis", "frequency", "damping_ratio", "limits", "motor", "collide"}},
      {"wheel",
       JointKind::kWheel,
       {"a", "anchor", "axis", "frequency", "damping_ratio", "limits", "motor", "collide"}},
      {"distance",
       JointKind::kDistance,
       {"a", "anchor_a", "anchor_b", "length", "frequency", "damping_ratio", "limits", "collide"}},
      {"rope", JointKind::kRope, {"a", "anchor_a", "anchor_b", "length", "collide"}},
      {"motor", JointKind::kMotor, {"a", "force", "torque", "follow", "collide"}},
      {"kinematic",
       JointKind::kKinematic,
       {"anchor", "path", "period", "phase", "ease", "turning"}},
      {"gear", JointKind::kGear, {"joints", "ratio", "collide"}},
      {"pulley",
       JointKind::kPulley,
       {"a", "anchor_a", "anchor_b", "ground_a", "ground_b", "ratio", "length", "collide"}}};
  return kinds;
}

/// Returns the joint's kind; complains about keys that this kind would ignore.
const JointName& ReadJointName(const SceneReader& r) {
  static const char* const kSome[] = {
      "a",         "anchor",        "anchor_a",        "anchor_b", "axis",
      "frequency", "damping_ratio", "length",          "limits",   "collide",
      "motor",     "strength",      "force",           "torque",   "follow",
      "path",      "period",        "phase",           "ease",     "turning",
      "local_a",   "local_b",       "reference_angle", "joints",   "ratio",
      "ground_a",  "ground_b"};
  const std::string name = r.Text("kind");
  std::string all;
  std::vector<std::string> names;
  for (const JointName& kind : JointNames()) {
    all += std::string(all.empty() ? "" : ", ") + kind.name;
    names.push_back(kind.name);
    if (name != kind.name) continue;
    for (const char* key : kSome) {
      const bool local =
          std::string(key).rfind("local_", 0) == 0 || std::string(key) == "reference_angle";
      const bool placed =
          kind.kind != JointKind::kKinematic && HoldOf(kind.kind) != JointHold::kCoupled;
      const bool known = local ? placed : std::count(kind.keys.begin(), kind.keys.end(), key) > 0;
      if (!known && r.Has(key)) r.FailAt(key, "a " + name + " joint has no " + key);
    }
    return kind;
  }
  r.FailAt("kind", "kind must be one of " + all + DidYouMean(name, names));
}

/// Reads limits. Hinge: rad; distance: m, of its length; else m from the start.
void ReadLimits(const SceneReader& r, Joint* joint) {
  if (!r.Has("limits")) return;
  const Range angles{-100, 100, true}, lengths{kEdgeMin, 10000}, shifts{-1000, 1000};
  const JointLimits of = LimitsOf(joint->kind);
  const Vec2 limits = r.Vector("limits", of == JointLimits::kAngle    ? angles
                                         : of == JointLimits::kLength ? lengths
                                                                      : shifts);
  joint->limited = true;
  joint->lower = limits.x();
  joint->upper = limits.y();
  if (joint->lower > joint->upper) r.FailAt("limits", "the lower limit is above the upper");
}

void ReadAxis(const SceneReader& r, const Vec2& fallback, Joint* joint) {
  const Eigen::Vector2d axis = r.Vector("axis", {-1000, 1000}, fallback).cast<double>();
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
  const char* most = HoldOf(joint->kind) == JointHold::kAxis ? "force" : "torque";
  const SceneReader m(*table, draft.file, r.what() + ": motor", {"player", "axis", "speed", most});
  joint->motor_speed = m.Number("speed", {-1000, 1000});
  joint->motor_torque = m.Number(most, {1e-6, 1e7});
  joint->motor_player = ReadAxisDriver(m, draft, &joint->motor_axis);
}

void ReadPoseMotor(const SceneReader& r, const SceneDraft& draft, Joint* joint) {
  joint->force_max = r.Number("force", {0, 1e7});
  joint->torque_max = r.Number("torque", {0, 1e7});
  const TomlNode* table = r.Table("follow");
  if (table == nullptr) return;
  const SceneReader f(*table, draft.file, r.what() + ": follow",
                      {"player", "axis", "reach", "swing"});
  joint->reach = f.Vector("reach", {-1000, 1000}, Vec2(0, 0));
  joint->swing = f.Number("swing", {-100, 100, true}, 0.0f);
  joint->motor_player = ReadAxisDriver(f, draft, &joint->motor_axis);
  if (joint->motor_player < 0) f.Fail("player is missing");
}

/// Longest period of a path, s: sessions count ticks for days.
constexpr double kPeriodMax = 86400;

void ReadKinematic(const SceneReader& r, const SceneDraft& draft, Joint* joint) {
  joint->turning = r.Number("turning", {-kSpinMax, kSpinMax}, 0.0f);
  joint->ease = r.Flag("ease", false);
  joint->phase = r.Seconds("phase", {0, 1}, 0.0);
  joint->path = r.Points("path", kCoordinate, kPathPointsMax);
  if (joint->path.empty()) {
    if (joint->turning == 0) r.Fail("needs a path or a turning");
    if (r.Has("period")) r.FailAt("period", "a period needs a path");
    return;
  }
  joint->period_s = r.Seconds("period", {0.1, kPeriodMax});
  double length = 0;
  for (std::size_t i = 0; i < joint->path.size(); ++i) {
    length += double{(joint->path[(i + 1) % joint->path.size()] - joint->path[i]).norm()};
  }
  if (length < double{kEdgeMin}) r.FailAt("path", "the path leads nowhere");
  const double speed = length / joint->period_s * (joint->ease ? 1.5707963 : 1);
  if (speed > double{draft.scene.speed_limit}) {
    r.FailAt("period", "it would move at " + Decimal(speed) + " m/s, beyond the speed_limit");
  }
}

/// Reads the joint's ends; default: the parts' positions.
void ReadEnds(const SceneReader& r, const SceneDraft& draft, Joint* joint) {
  const auto position = [&](PartId part) {
    return draft.scene.parts[static_cast<std::size_t>(part)].position;
  };
  joint->anchor_a = r.Vector("anchor_a", kCoordinate, position(joint->a));
  joint->anchor_b = r.Vector("anchor_b", kCoordinate, position(joint->b));
}

void ReadDistance(const SceneReader& r, const SceneDraft& draft, Joint* joint) {
  ReadEnds(r, draft, joint);
  ReadSpring(r, joint);
  ReadLimits(r, joint);
  if (r.Has("length")) {
    joint->length = r.Number("length", {kEdgeMin, 10000});
  } else if ((joint->anchor_b - joint->anchor_a).norm() < kEdgeMin) {
    r.Fail("the ends are closer than " + Decimal(kEdgeMin) + " m: give it a length");
  }
}

/// Reads ends given in the parts' own frames, and the angle between the parts at which the joint is
/// at rest: for parts joined in motion, whose poses in the scene are not meaningful.
void ReadLocal(const SceneReader& r, const SceneDraft& draft, Joint* joint) {
  const auto place = [&](PartId id, const char* key, Vec2* anchor) {
    if (!r.Has(key)) return;
    if (r.Has("anchor")) r.FailAt(key, std::string("has both anchor and ") + key);
    const Part& part = draft.scene.parts[static_cast<std::size_t>(id)];
    const Eigen::Vector2d local = r.Vector(key, {-1000, 1000}).cast<double>();
    const Transform2 placed{part.position.cast<double>(), static_cast<double>(part.angle)};
    *anchor = placed(local).cast<float>();
  };
  if (r.Has("local_a") != r.Has("local_b")) r.Fail("needs local_a and local_b, or neither");
  place(joint->a, "local_a", &joint->anchor_a);
  place(joint->b, "local_b", &joint->anchor_b);
  if (!r.Has("reference_angle")) return;
  const Part& a = draft.scene.parts[static_cast<std::size_t>(joint->a)];
  const Part& b = draft.scene.parts[static_cast<std::size_t>(joint->b)];
  joint->turn = b.angle - a.angle - r.Number("reference_angle", {-1000, 1000, true});
}

void Add(const SceneReader& r, const Joint& joint, SceneDraft* draft) {
  if (!draft->joint_names.insert(joint.name).second) {
    r.FailAt("name", "there is another joint of this name");
  }
  if (Full(draft->scene.joints, kJointsMax)) {
    r.Fail("a scene may have at most " + std::to_string(kJointsMax) + " joints");
  }
  draft->scene.joints.push_back(joint);
}

/// Adds a joint, and a prismatic one's spring: along the axis to a point that b does not reach.
void AddSprung(const SceneReader& r, const Joint& joint, SceneDraft* draft) {
  if (HoldOf(joint.kind) != JointHold::kAxis || joint.frequency_hz <= 0)
    return Add(r, joint, draft);
  Joint slide = joint, spring = joint;
  slide.frequency_hz = 0;
  Add(r, slide, draft);
  spring.name += ".spring";
  spring.kind = JointKind::kDistance;
  spring.length = joint.limited ? 1 + std::max(joint.upper, -joint.lower) : kSpringTravel;
  spring.anchor_a -= spring.length * joint.axis;
  spring.limited = false;
  spring.motor_torque = 0;
  spring.coupled[0] = static_cast<int>(draft->scene.joints.size()) - 1;
  Add(r, spring, draft);
}

void Copy(const SceneReader& r, const Joint& first, SceneDraft* draft) {
  const Repeat repeat = ReadRepeat(r, draft->file);
  if (repeat.joined) r.FailAt("repeat", "repeat: only parts are welded or glued");
  for (int column = 0; column < repeat.columns; ++column) {
    for (int row = 0; row < repeat.rows; ++row) {
      Joint joint = first;
      joint.name += repeat.Suffix(column, row);
      joint.a = PartAfter(r, first.a, column, row, repeat.grid, *draft);
      joint.b = PartAfter(r, first.b, column, row, repeat.grid, *draft);
      joint.motor_player = PlayerAfter(r, first.motor_player, column, row, repeat.grid, *draft);
      joint.anchor_a += repeat.Offset(column, row);
      joint.anchor_b += repeat.Offset(column, row);
      joint.ground_a += repeat.Offset(column, row);
      joint.ground_b += repeat.Offset(column, row);
      AddSprung(r, joint, draft);
    }
  }
}

/// Reads the keys of the joint's kind. Requires a, b and the anchors.
void ReadDetails(const SceneReader& r, const SceneDraft& draft, Joint* joint) {
  switch (joint->kind) {
    case JointKind::kWeld:
      ReadSpring(r, joint);
      if (joint->frequency_hz > 0) break;
      for (const char* key : {"damping_ratio", "collide"}) {
        if (r.Has(key)) r.FailAt(key, std::string("a rigid weld joint has no ") + key);
      }
      break;
    case JointKind::kGlue: joint->strength = r.Number("strength", {0, 1e9}); break;
    case JointKind::kRevolute:
      ReadLimits(r, joint);
      ReadMotor(r, draft, joint);
      break;
    case JointKind::kPrismatic:
      ReadAxis(r, Vec2(1, 0), joint);
      ReadSpring(r, joint);
      ReadLimits(r, joint);
      ReadMotor(r, draft, joint);
      break;
    case JointKind::kWheel:
      ReadAxis(r, Vec2(0, 1), joint);
      ReadSpring(r, joint);
      ReadLimits(r, joint);
      ReadMotor(r, draft, joint);
      break;
    case JointKind::kDistance:
    case JointKind::kRope: ReadDistance(r, draft, joint); break;
    case JointKind::kMotor: ReadPoseMotor(r, draft, joint); break;
    case JointKind::kKinematic: ReadKinematic(r, draft, joint); break;
    case JointKind::kGear: break;  // read together with its parts
    case JointKind::kPulley: ReadEnds(r, draft, joint); break;
  }
}

void ReadJoint(const TomlNode& node, SceneDraft* draft) {
  Joint joint;
  joint.line = node.line;
  SceneReader r(node, draft->file, "joint",
                {"name",
                 "kind",
                 "a",
                 "b",
                 "anchor",
                 "anchor_a",
                 "anchor_b",
                 "axis",
                 "frequency",
                 "damping_ratio",
                 "length",
                 "limits",
                 "collide",
                 "motor",
                 "strength",
                 "force",
                 "torque",
                 "follow",
                 "path",
                 "period",
                 "phase",
                 "ease",
                 "turning",
                 "repeat",
                 "local_a",
                 "local_b",
                 "reference_angle",
                 "joints",
                 "ratio",
                 "ground_a",
                 "ground_b"});
  joint.name = r.Name("name");
  r.Rename("joint '" + joint.name + "'");
  joint.kind = ReadJointName(r).kind;
  const JointHold hold = HoldOf(joint.kind);
  if (hold == JointHold::kCoupled) {
    ReadGear(r, *draft, &joint);
  } else {
    joint.b = FindPart(r, "b", *draft);
    joint.a = hold == JointHold::kImposed ? joint.b : FindPart(r, "a", *draft);
  }
  if (hold != JointHold::kImposed && joint.a == joint.b) r.Fail("joins a part with itself");
  joint.collide = r.Flag("collide", false);
  const Vec2 centre = draft->scene.parts[static_cast<std::size_t>(joint.b)].position;
  joint.anchor_a = joint.anchor_b = r.Vector("anchor", kCoordinate, centre);
  ReadDetails(r, *draft, &joint);
  ReadLocal(r, *draft, &joint);
  if (hold == JointHold::kPulley) ReadPulley(r, &joint);
  if (r.Has("repeat")) {
    Copy(r, joint, draft);
  } else {
    AddSprung(r, joint, draft);
  }
}

}  // namespace

int ReadAxisDriver(const SceneReader& r, const SceneDraft& draft, InputAxis* axis) {
  if (!r.Has("player")) {
    if (r.Has("axis")) r.FailAt("axis", "an axis needs a player");
    return -1;
  }
  const std::string name = r.Text("axis", "drive");
  if (name != "drive" && name != "lift") r.FailAt("axis", "axis must be 'drive' or 'lift'");
  *axis = name == "lift" ? InputAxis::kLift : InputAxis::kDrive;
  return FindDriver(r, "player", r.Text("player"), draft);
}

void ReadJoints(const SceneReader& root, SceneDraft* draft) {
  for (const TomlNode* node : root.Tables("joint")) ReadJoint(*node, draft);
}

}  // namespace seam
