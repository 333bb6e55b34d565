/// Reads what b2World::Dump writes: C++ statements, each of which sets one value. They are read as
/// values by name; nothing is run.

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <map>

#include "common/base/check.h"
#include "common/scene/scene_limits.h"
#include "render/import/imported.h"

namespace seam {
namespace {

using Eigen::Vector2d;

/// One statement without spaces, and the line that it begins on.
struct Statement {
  std::string text;
  int line = 1;
};

std::vector<Statement> StatementsOf(const std::string& text) {
  std::vector<Statement> all;
  Statement now;
  int line = 1;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '/' && i + 1 < text.size() && text[i + 1] == '/') {
      i = std::min(text.find('\n', i), text.size()) - 1;
      continue;
    }
    if (c == '\n') ++line;
    if (c == ';' || c == '{' || c == '}') {
      if (!now.text.empty()) all.push_back(now);
      now = {};
    } else if (std::isspace(static_cast<unsigned char>(c)) == 0) {
      if (now.text.empty()) now.line = line;
      now.text += c;
    }
  }
  if (!now.text.empty()) all.push_back(now);
  return all;
}

bool Begins(const std::string& text, const std::string& with) {
  return text.compare(0, with.size(), with) == 0;
}

class DumpReader {
 public:
  explicit DumpReader(const std::string& file) : file_(file) {}

  Imported Read(const std::string& text) {
    for (const Statement& statement : StatementsOf(text)) {
      line_ = statement.line;
      Take(statement.text);
    }
    if (world_.bodies.empty()) throw OperatorError(file_ + ": has no bodies: is this a dump?");
    const auto gaps = std::count_if(world_.joints.begin(), world_.joints.end(),
                                    [](const ImportedJoint& j) { return j.kind.empty(); });
    for (auto i = gaps; i < mouse_joints_; ++i) {
      world_.dropped.push_back("a mouse joint, which has no values in a dump");
    }
    return std::move(world_);
  }

 private:
  [[noreturn]] void Fail(const std::string& why) const {
    throw OperatorError(file_ + ":" + std::to_string(line_) + ": " + why);
  }

  void Take(const std::string& s) {
    if (Begins(s, "b2Vec2g(")) {
      world_.gravity = Pair(s, s.find('('));
    } else if (s == "b2BodyDefbd" || s == "b2FixtureDeffd") {
      values_.clear();
      points_.clear();
    } else if (Begins(s, "b2") && s.find("JointDefjd") != std::string::npos) {
      values_.clear();
      joint_kind_ = s.substr(2, s.find("JointDef") - 2);
    } else if (Begins(s, "b2") && s.find("Shapeshape") != std::string::npos) {
      shape_kind_ = s.substr(2, s.find("Shape") - 2);
    } else if (Begins(s, "vs[")) {
      AddPoint(s);
    } else if (Begins(s, "bodies[") && s.find("CreateBody") != std::string::npos) {
      AddBody(Index(s, "bodies["));
    } else if (Begins(s, "bodies[") && s.find("CreateFixture") != std::string::npos) {
      AddShape(Index(s, "bodies["));
    } else if (Begins(s, "joints[") && s.find("CreateJoint") != std::string::npos) {
      AddJoint(Index(s, "joints["));
    } else if (Begins(s, "b2Joint**joints")) {
      SetJoints(s);
    } else if (s.find("dumpingisnotsupported.") != std::string::npos) {
      ++mouse_joints_;  // 2.3 says so in the file
    } else if (IsFrame(s)) {
      return;
    } else if (s.find('.') < std::min(s.find('='), s.find('('))) {
      SetValue(s);
    } else {
      Fail("not understood: " + s.substr(0, 60));
    }
  }

  /// True for the statements around the values.
  static bool IsFrame(const std::string& s) {
    for (const char* known :
         {"m_world->SetGravity(", "b2Body**bodies", "b2Free(", "joints=", "bodies=", "b2Vec2vs["}) {
      if (Begins(s, known)) return true;
    }
    return false;
  }

  /// "b2Joint**joints=(b2Joint**)b2Alloc(3*sizeof(b2Joint*))"; a mouse joint has a number alone.
  void SetJoints(const std::string& s) {
    const std::size_t open = s.find("b2Alloc(");
    const long count =
        open == std::string::npos ? 0 : std::strtol(s.c_str() + open + 8, nullptr, 10);
    if (count < 0 || count > 1000000) Fail("too many joints");
    world_.joints.resize(static_cast<std::size_t>(count));
  }

  /// "bd.angle=1.5f" or "bd.position.Set(1.0f,2.0f)".
  void SetValue(const std::string& s) {
    const std::size_t set = s.find(".Set("), equals = s.find('=');
    const std::size_t dot = s.find('.');
    const std::string owner = s.substr(0, dot);
    if (owner != "bd" && owner != "fd" && owner != "jd" && owner != "shape") {
      Fail("not understood: " + s.substr(0, 60));
    }
    if (set != std::string::npos && set > dot && set < equals) {
      vectors_[s.substr(0, set)] = Pair(s, set + 4);
      values_[s.substr(0, set)] = "set";
      return;
    }
    if (equals == std::string::npos) return;  // shape.Set(vs, 4), shape.CreateChain(vs, 9)
    values_[s.substr(0, equals)] = s.substr(equals + 1);
  }

  Vector2d Pair(const std::string& s, std::size_t open) const {
    const char* at = s.c_str() + open + 1;
    char* end = nullptr;
    const double x = std::strtod(at, &end);
    if (*end == 'f') ++end;
    if (*end != ',') Fail("two numbers are needed: " + s.substr(0, 60));
    const double y = std::strtod(end + 1, &end);
    if (*end == 'f') ++end;
    if (*end != ')' || !std::isfinite(x) || !std::isfinite(y)) {
      Fail("two numbers are needed: " + s.substr(0, 60));
    }
    return {x, y};
  }

  int Index(const std::string& s, const std::string& of) const {
    const std::size_t at = s.find(of);
    char* end = nullptr;
    const long index =
        at == std::string::npos ? -1 : std::strtol(s.c_str() + at + of.size(), &end, 10);
    if (index < 0 || index > 1000000 || *end != ']') Fail("no index: " + s.substr(0, 60));
    return static_cast<int>(index);
  }

  bool Has(const std::string& key) const { return values_.count(key) != 0; }

  /// A plain number, or one within a cast such as bool(1).
  double Number(const std::string& key, double fallback = 0) const {
    const auto found = values_.find(key);
    if (found == values_.end()) return fallback;
    std::string text = found->second;
    const std::size_t open = text.find('(');
    if (open != std::string::npos) text = text.substr(open + 1, text.find(')') - open - 1);
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (end == text.c_str() || (*end != 0 && std::string(end) != "f") || !std::isfinite(value)) {
      Fail("no number: " + key + " = " + found->second.substr(0, 40));
    }
    return value;
  }
  int Integer(const std::string& key, int fallback) const {
    const double value = Number(key, fallback);
    if (std::fabs(value) > 1e6) Fail(key + " is out of range");
    return static_cast<int>(value);
  }
  bool Flag(const std::string& key) const { return Number(key) != 0; }
  Vector2d Vector(const std::string& key, const Vector2d& fallback = {0, 0}) const {
    return Has(key) && vectors_.count(key) != 0 ? vectors_.at(key) : fallback;
  }

  void AddPoint(const std::string& s) {
    const std::size_t set = s.find(".Set(");
    if (set == std::string::npos) Fail("not understood: " + s.substr(0, 60));
    if (Index(s, "vs[") != static_cast<int>(points_.size())) Fail("points out of order");
    points_.push_back(Pair(s, set + 4));
  }

  void AddBody(int index) {
    if (index != static_cast<int>(world_.bodies.size())) Fail("bodies out of order");
    ImportedBody body;
    const int type = Integer("bd.type", 0);
    if (type < 0 || type > 2) Fail("the type of a body is 0, 1 or 2");
    body.kind = static_cast<ImportedBody::Kind>(type);
    body.position = Vector("bd.position");
    body.angle = Number("bd.angle");
    body.velocity = Vector("bd.linearVelocity");
    body.spin = Number("bd.angularVelocity");
    body.linear_damping = Number("bd.linearDamping");
    body.angular_damping = Number("bd.angularDamping");
    body.gravity_scale = Number("bd.gravityScale", 1);
    body.fixed_rotation = Flag("bd.fixedRotation");
    body.bullet = Flag("bd.bullet");
    body.active = Number("bd.active", Number("bd.enabled", 1)) != 0;  // 2.3, 2.4
    body.awake = Number("bd.awake", 1) != 0;
    world_.bodies.push_back(body);
  }

  void AddShape(int index) {
    if (index >= static_cast<int>(world_.bodies.size())) Fail("a fixture of no body");
    using Kind = ImportedShape::Kind;
    ImportedShape shape;
    shape.density = Number("fd.density");
    shape.friction = Number("fd.friction");
    shape.restitution = Number("fd.restitution");
    shape.sensor = Flag("fd.isSensor");
    shape.category = Integer("fd.filter.categoryBits", 1);
    shape.mask = Integer("fd.filter.maskBits", 0xffff);
    shape.group = Integer("fd.filter.groupIndex", 0);
    shape.points = points_;
    if (shape_kind_ == "Circle") {
      shape.kind = Kind::kCircle;
      shape.centre = Vector("shape.m_p");
      shape.radius = Number("shape.m_radius");
    } else if (shape_kind_ == "Edge") {
      shape.kind = Flag("shape.m_oneSided") ? Kind::kChain : Kind::kTwoSidedChain;
      shape.points = {Vector("shape.m_vertex1"), Vector("shape.m_vertex2")};
    } else if (shape_kind_ == "Chain") {
      shape.kind = Has("shape.m_hasPrevVertex") ? Kind::kTwoSidedChain : Kind::kChain;  // 2.3: both
    } else if (shape_kind_ != "Polygon") {
      Fail("a fixture without a shape");
    }
    world_.bodies[static_cast<std::size_t>(index)].shapes.push_back(shape);
  }

  void AddJoint(int index) {
    if (index >= 1000000) Fail("too many joints");
    ImportedJoint joint;
    joint.kind = joint_kind_;
    std::transform(joint.kind.begin(), joint.kind.end(), joint.kind.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (joint.kind == "revolute") joint.kind = "hinge";
    joint.a = Index(values_["jd.bodyA"], "bodies[");
    joint.b = Index(values_["jd.bodyB"], "bodies[");
    joint.collide = Flag("jd.collideConnected");
    joint.local_a = Vector("jd.localAnchorA");
    joint.local_b = Vector("jd.localAnchorB");
    joint.axis = Vector("jd.localAxisA", {1, 0});
    joint.reference = Number("jd.referenceAngle");
    if (joint.kind == "motor") {
      joint.local_a = Vector("jd.linearOffset");
      joint.reference = Number("jd.angularOffset");
    }
    joint.limited = Flag("jd.enableLimit");
    joint.lower = Number("jd.lowerTranslation", Number("jd.lowerAngle"));
    joint.upper = Number("jd.upperTranslation", Number("jd.upperAngle"));
    joint.motor = Flag("jd.enableMotor");
    joint.speed = Number("jd.motorSpeed");
    joint.most = Number("jd.maxMotorForce", Number("jd.maxMotorTorque"));
    joint.frequency = Number("jd.frequencyHz");
    joint.damping_ratio = Number("jd.dampingRatio");
    joint.stiffness = Number("jd.stiffness");
    joint.damping = Number("jd.damping");
    joint.length = Number("jd.maxLength", Number("jd.length"));
    if (joint.kind == "distance") ReadLengths(&joint);
    joint.ground_a = Vector("jd.groundAnchorA");
    joint.ground_b = Vector("jd.groundAnchorB");
    joint.ratio = Number("jd.ratio", 1);
    if (joint.kind == "pulley")
      joint.length = Number("jd.lengthA") + joint.ratio * Number("jd.lengthB");
    joint.force = Number("jd.maxForce");
    joint.torque = Number("jd.maxTorque");
    if (Has("jd.joint1")) {
      joint.joints = {Index(values_["jd.joint1"], "joints["),
                      Index(values_["jd.joint2"], "joints[")};
    }
    if (index >= static_cast<int>(world_.joints.size())) {
      world_.joints.resize(static_cast<std::size_t>(index) + 1);
    }
    world_.joints[static_cast<std::size_t>(index)] = joint;
  }

  /// A distance joint of 2.4 has limits besides its length, and is rigid, also with a spring, when
  /// these are equal. Without a spring it is slack between them.
  void ReadLengths(ImportedJoint* joint) const {
    joint->length = Number("jd.length");
    joint->lower = Number("jd.minLength", joint->length);
    joint->upper = Number("jd.maxLength", joint->length);
    joint->limited = joint->lower < joint->upper;
    if (Has("jd.minLength") && !joint->limited) joint->stiffness = 0;
    const bool unlimited = joint->upper >= 1e6 && joint->lower <= double{kEdgeMin};  // by default
    if (joint->limited && unlimited) {
      joint->limited = false;
      if (joint->stiffness <= 0) joint->kind = "slack distance";
    }
  }

  const std::string& file_;
  int line_ = 1;
  Imported world_;
  std::map<std::string, std::string> values_;
  std::map<std::string, Vector2d> vectors_;
  std::vector<Vector2d> points_;
  std::string shape_kind_, joint_kind_;
  std::ptrdiff_t mouse_joints_ = 0;  // named as such
};

}  // namespace

Imported ReadDump(const std::string& text, const std::string& file) {
  return DumpReader(file).Read(text);
}

}  // namespace seam
