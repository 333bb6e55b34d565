#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>

#include "common/base/check.h"
#include "render/import/imported.h"

namespace seam {
namespace {

using Json = nlohmann::json;
using Eigen::Vector2d;

/// Reads values with the format's defaults: what is absent is 0 or false.
class Fields {
 public:
  Fields(const Json& object, const std::string& file, std::string what)
      : object_(object), file_(file), what_(std::move(what)) {
    if (!object.is_object()) Fail("is no object");
  }

  [[noreturn]] void Fail(const std::string& why) const {
    throw OperatorError(file_ + ": " + what_ + ": " + why);
  }
  bool Has(const char* key) const { return object_.contains(key); }
  const Json& At(const char* key) const { return object_.at(key); }

  double Number(const char* key, double fallback = 0) const {
    return Has(key) ? NumberOf(At(key), key) : fallback;
  }
  bool Flag(const char* key, bool fallback = false) const {
    if (!Has(key)) return fallback;
    if (!At(key).is_boolean()) Fail(std::string(key) + " is neither true nor false");
    return At(key).get<bool>();
  }
  int Integer(const char* key, int fallback) const {
    const double value = Number(key, fallback);
    if (!(std::fabs(value) <= 1e6)) Fail(std::string(key) + " is out of range");
    return static_cast<int>(value);
  }
  std::string Text(const char* key) const {
    return Has(key) && At(key).is_string() ? At(key).get<std::string>() : "";
  }
  /// A vector is an object of x and y, or the number 0 for none.
  Vector2d Vector(const char* key) const {
    if (!Has(key) || !At(key).is_object()) return {0, 0};
    const Fields v(At(key), file_, what_ + ": " + key);
    return {v.Number("x"), v.Number("y")};
  }
  /// Points are an object of two equally long lists, x and y.
  std::vector<Vector2d> Points(const char* key) const {
    if (!Has(key)) Fail(std::string("has no ") + key);
    const Fields v(At(key), file_, what_ + ": " + key);
    if (!v.Has("x") || !v.Has("y") || !v.At("x").is_array() || !v.At("y").is_array() ||
        v.At("x").size() != v.At("y").size()) {
      v.Fail("needs the lists x and y of equal length");
    }
    std::vector<Vector2d> points;
    for (std::size_t i = 0; i < v.At("x").size(); ++i) {
      points.emplace_back(NumberOf(v.At("x")[i], "x"), NumberOf(v.At("y")[i], "y"));
    }
    return points;
  }
  const Json& List(const char* key) const {
    static const Json none = Json::array();
    if (!Has(key)) return none;
    if (!At(key).is_array()) Fail(std::string(key) + " is no list");
    return At(key);
  }

 private:
  /// Numbers may be text: the eight hexadecimal digits of a float.
  double NumberOf(const Json& value, const char* key) const {
    double number = std::nan("");
    if (value.is_number()) {
      number = value.get<double>();
    } else if (value.is_string() && value.get<std::string>().size() == 8) {
      const std::string digits = value.get<std::string>();
      if (digits.find_first_not_of("0123456789abcdefABCDEF") == std::string::npos) {
        const auto bits = static_cast<std::uint32_t>(std::stoul(digits, nullptr, 16));
        float exact = 0;
        std::memcpy(&exact, &bits, sizeof exact);
        number = static_cast<double>(exact);
      }
    }
    if (!std::isfinite(number)) Fail(std::string(key) + " is no number");
    return number;
  }

  const Json& object_;
  const std::string& file_;
  const std::string what_;
};

ImportedShape ShapeOf(const Fields& r, const std::string& file) {
  ImportedShape shape;
  shape.name = r.Text("name");
  shape.density = r.Number("density");
  shape.friction = r.Number("friction");
  shape.restitution = r.Number("restitution");
  shape.sensor = r.Flag("sensor");
  shape.category = r.Integer("filter-categoryBits", 1);
  shape.mask = r.Integer("filter-maskBits", 0xffff);
  shape.group = r.Integer("filter-groupIndex", 0);
  if (r.Has("circle")) {
    const Fields circle(r.At("circle"), file, "circle");
    shape.kind = ImportedShape::Kind::kCircle;
    shape.centre = circle.Vector("center");
    shape.radius = circle.Number("radius");
  } else if (r.Has("polygon")) {
    shape.points = Fields(r.At("polygon"), file, "polygon").Points("vertices");
    // b2dJson reads two points as an edge.
    if (shape.points.size() == 2) shape.kind = ImportedShape::Kind::kTwoSidedChain;
  } else if (r.Has("chain")) {
    shape.kind = ImportedShape::Kind::kTwoSidedChain;
    shape.points = Fields(r.At("chain"), file, "chain").Points("vertices");
  } else if (r.Has("edge")) {
    const Fields edge(r.At("edge"), file, "edge");
    shape.kind = ImportedShape::Kind::kTwoSidedChain;
    shape.points = {edge.Vector("vertex1"), edge.Vector("vertex2")};
  } else {
    r.Fail("has no circle, polygon, chain or edge");
  }
  return shape;
}

ImportedBody BodyOf(const Fields& r, const std::string& file) {
  ImportedBody body;
  const int type = r.Integer("type", 0);
  if (type < 0 || type > 2) r.Fail("type must be 0, 1 or 2");
  body.kind = static_cast<ImportedBody::Kind>(type);
  body.name = r.Text("name");
  body.position = r.Vector("position");
  body.angle = r.Number("angle");
  body.velocity = r.Vector("linearVelocity");
  body.spin = r.Number("angularVelocity");
  body.linear_damping = r.Number("linearDamping");
  body.angular_damping = r.Number("angularDamping");
  body.gravity_scale = r.Number("gravityScale", 1);
  body.fixed_rotation = r.Flag("fixedRotation");
  body.bullet = r.Flag("bullet");
  body.active = r.Flag("active", true);
  body.awake = r.Flag("awake", true);
  body.mass = r.Number("massData-mass");
  if (r.Has("massData-center")) body.centre = r.Vector("massData-center");
  for (const Json& fixture : r.List("fixture")) {
    body.shapes.push_back(ShapeOf(Fields(fixture, file, "a fixture of '" + body.name + "'"), file));
  }
  return body;
}

/// The format's name of a kind of joint, and ours.
std::string KindOf(const std::string& type) { return type == "revolute" ? "hinge" : type; }

ImportedJoint JointOf(const Fields& r) {
  ImportedJoint joint;
  joint.kind = KindOf(r.Text("type"));
  joint.name = r.Text("name");
  joint.a = r.Integer("bodyA", -1);
  joint.b = r.Integer("bodyB", -1);
  joint.local_a = r.Vector("anchorA");
  // A motor joint's anchorA is its linear offset.
  if (joint.kind != "motor") joint.local_b = r.Vector("anchorB");
  if (r.Has("localAxisA")) joint.axis = r.Vector("localAxisA");
  joint.reference = r.Number("refAngle");
  joint.collide = r.Flag("collideConnected");
  joint.limited = r.Flag("enableLimit");
  joint.lower = r.Number("lowerLimit");
  joint.upper = r.Number("upperLimit");
  joint.motor = r.Flag("enableMotor");
  joint.speed = r.Number("motorSpeed");
  joint.most = r.Has("maxMotorForce") ? r.Number("maxMotorForce") : r.Number("maxMotorTorque");
  joint.frequency = r.Has("springFrequency") ? r.Number("springFrequency") : r.Number("frequency");
  joint.damping_ratio =
      r.Has("springDampingRatio") ? r.Number("springDampingRatio") : r.Number("dampingRatio");
  joint.length = joint.kind == "rope" ? r.Number("maxLength") : r.Number("length");
  joint.force = r.Number("maxForce");
  joint.torque = r.Number("maxTorque");
  joint.joints = {r.Integer("joint1", -1), r.Integer("joint2", -1)};
  joint.ratio = r.Number("ratio", 1);
  return joint;
}

}  // namespace

Imported ReadRube(const std::string& text, const std::string& file) {
  Json root;
  try {
    root = Json::parse(text);
  } catch (const Json::exception& e) {
    std::string why = e.what();
    why = why.substr(0, why.find('\n'));
    throw OperatorError(file + ": is no JSON: " + why.substr(why.find("] ") + 2));
  }
  const Fields r(root, file, "the world");
  if (!r.Has("body")) r.Fail("has no body: is this R.U.B.E. JSON?");
  Imported world;
  world.gravity = r.Vector("gravity");
  for (const Json& body : r.List("body")) {
    const std::string what = "body " + std::to_string(world.bodies.size());
    world.bodies.push_back(BodyOf(Fields(body, file, what), file));
  }
  for (const Json& joint : r.List("joint")) {
    const std::string what = "joint " + std::to_string(world.joints.size());
    world.joints.push_back(JointOf(Fields(joint, file, what)));
  }
  for (const Json& image : r.List("image")) {
    const std::string name =
        image.is_object() && image.contains("name") && image["name"].is_string()
            ? image["name"].get<std::string>()
            : "";
    world.dropped.push_back("image '" + name + "': a scene has no pictures");
  }
  return world;
}

}  // namespace seam
