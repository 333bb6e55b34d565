/// Writes an imported world as a scene: a part for each shape, a weld for each further shape of a
/// moving body.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "common/base/geometry.h"
#include "common/base/spatial/disjoint_sets.h"
#include "common/scene/scene_limits.h"
#include "render/import/imported.h"
#include "render/import/outlines.h"
#include "render/import/placed.h"
#include "render/import/plain_names.h"

namespace seam {
namespace {

using Eigen::Vector2d;
using Kind = ImportedBody::Kind;

/// A centre of mass set by hand that differs by less is the shapes', m.
constexpr double kCentreOff = 0.01;

class SceneWriter {
 public:
  explicit SceneWriter(Imported* world) : world_(*world), placed_(world->bodies.size()) {}

  std::string Write(const std::string& title) {
    for (std::size_t b = 0; b < world_.bodies.size(); ++b) PlaceShapes(b);
    ShareVelocities();
    for (std::size_t b = 0; b < world_.bodies.size(); ++b) WriteBody(b);
    for (const bool gears : {false, true}) {  // after the joints that they couple
      for (std::size_t j = 0; j < world_.joints.size(); ++j) {
        if ((world_.joints[j].kind == "gear") == gears) WriteJoint(j);
      }
    }
    std::string head = fmt::format("title = \"{}\"\ngravity = {}\n", PlainText(title),
                                   Pair(Clamped(world_.gravity, 100, "gravity")));
    if (size_ > double{kSizeMaxDefault}) {
      head += fmt::format("size_max = {:.9g}\n", std::min(std::ceil(size_), double{kSizeMaxMax}));
    }
    if (reach_ > 1000) {
      const double most = std::min(2 * reach_, kCoordinate.max);
      head += fmt::format("bounds = [[{0:.9g}, {0:.9g}], [{1:.9g}, {1:.9g}]]\n", -most, most);
    }
    return head + text_;
  }

 private:
  void Drop(const std::string& what) { world_.dropped.push_back(what); }

  double Clamp(double value, double low, double high, const std::string& what) {
    const double held = std::clamp(value, low, high);
    if (held != value) Drop(fmt::format("{} of {:.4g}: {:.4g} instead", what, value, held));
    return held;
  }
  Vector2d Clamped(const Vector2d& v, double most, const std::string& what) {
    return {Clamp(v.x(), -most, most, what), Clamp(v.y(), -most, most, what)};
  }

  void PlaceShapes(std::size_t b) {
    ImportedBody& body = world_.bodies[b];
    body.name = names_.Take(body.name, "body-" + std::to_string(b));
    const bool moves = body.kind == Kind::kDynamic;
    if (!body.active) return Drop("body '" + body.name + "': is not active");
    if (moves && !body.awake) Drop("body '" + body.name + "': sleeps; here it begins awake");
    for (const ImportedShape& shape : body.shapes) {
      const std::string what =
          fmt::format("body '{}': {}", body.name, shape.name.empty() ? "a fixture" : shape.name);
      if (shape.sensor) {
        Drop(what + ": a sensor");
        continue;
      }
      const std::vector<PieceOutline> pieces = PiecesOf(shape, moves);
      if (pieces.empty()) Drop(what + ": smaller than " + fmt::format("{:g} m", kSizeMin));
      if (!moves && !pieces.empty() && pieces[0].walled) {
        Drop(fmt::format("{}: wider than {:g} m; here a chain around it", what, kSizeMaxMax));
      }
      for (const PieceOutline& piece : pieces) {
        Placed placed;
        placed.name = placed_[b].empty() ? body.name : names_.Take(body.name, body.name);
        placed.piece = piece;
        placed.shape = &shape;
        placed.density =
            moves ? Clamp(shape.density, kDensity.min, kDensity.max, what + ": density") : 1;
        if (moves) size_ = std::max(size_, piece.extent);
        placed_[b].push_back(placed);
      }
    }
    if (moves && body.mass > 0) SetMass(b);
    if (moves) reach_ = std::max(reach_, body.position.lpNorm<Eigen::Infinity>());
    if (placed_[b].empty()) Drop("body '" + body.name + "': has no shape that collides");
  }

  /// Gives the shapes the densities with which the body has the mass that was set by hand.
  void SetMass(std::size_t b) {
    const ImportedBody& body = world_.bodies[b];
    const MassProperties shapes = MassOf(b);
    const double mass = shapes.mass;
    const std::string what = "body '" + body.name + "': ";
    if (body.centre && (*body.centre - shapes.centre).norm() > kCentreOff) {
      Drop(fmt::format("{}a centre of mass at {} set by hand; here that of the shapes, {}", what,
                       Pair(*body.centre), Pair(shapes.centre)));
    }
    if (mass <= 0 || std::fabs(body.mass - mass) <= 0.001 * mass) return;
    Drop(fmt::format("{}a mass of {:.4g} kg set by hand; here by density, about the shapes' centre",
                     what, body.mass));
    for (Placed& placed : placed_[b]) {
      placed.density =
          Clamp(placed.density * body.mass / mass, kDensity.min, kDensity.max, what + "density");
    }
  }

  /// Both infinite for a body that does not move by forces.
  MassProperties MassOf(std::size_t b) const {
    MassProperties all = seam::MassOf(placed_[b]);
    if (world_.bodies[b].kind != Kind::kDynamic) all.mass = all.inertia = HUGE_VAL;
    return all;
  }

  bool IsRigidWeld(const ImportedJoint& j) const {
    return j.kind == "weld" && j.frequency <= 0 && j.stiffness <= 0 && HasEnds(j);
  }
  bool HasEnds(const ImportedJoint& j) const {
    const auto count = static_cast<int>(world_.bodies.size());
    return j.a >= 0 && j.b >= 0 && j.a < count && j.b < count && j.a != j.b &&
           !placed_[static_cast<std::size_t>(j.a)].empty() &&
           !placed_[static_cast<std::size_t>(j.b)].empty();
  }

  /// Welded bodies move as one: all take the first's velocity, and none if one of them stands
  /// still.
  void ShareVelocities() {
    DisjointSets whole(world_.bodies.size());
    for (const ImportedJoint& j : world_.joints) {
      if (IsRigidWeld(j)) whole.Unite(j.a, j.b);
    }
    for (std::size_t b = 0; b < world_.bodies.size(); ++b) {
      ImportedBody& body = world_.bodies[b];
      if (body.fixed_rotation) body.spin = 0;
    }
    for (std::size_t b = 0; b < world_.bodies.size(); ++b) {
      const auto first = static_cast<std::size_t>(whole.Find(static_cast<int>(b)));
      ImportedBody& body = world_.bodies[b];
      ImportedBody& lead = world_.bodies[first];
      if (body.kind != Kind::kDynamic) lead.kind = body.kind;
      if (body.velocity == lead.velocity && body.spin == lead.spin) continue;
      Drop("body '" + body.name + "': the velocity of '" + lead.name + "', to which it is welded");
      body.velocity = lead.velocity;
      body.spin = lead.spin;
    }
  }

  void WriteBody(std::size_t b) {
    const ImportedBody& body = world_.bodies[b];
    const Transform2 pose{body.position, body.angle};
    for (const Placed& placed : placed_[b]) {
      const Transform2 at = pose.Then(placed.piece.pose);
      text_ += fmt::format("\n[[part]]\nname = \"{}\"\n{}", placed.name, ShapeText(placed.piece));
      text_ += fmt::format("position = {}\n", Pair(Clamped(at.shift, kCoordinate.max, "position")));
      if (at.angle != 0) text_ += fmt::format("angle = {:.9g}\n", WrapAngle(at.angle));
      WriteMaterial(body, placed);
      if (body.kind == Kind::kDynamic) WriteMotion(body);
    }
    const bool turns = body.kind == Kind::kKinematic && body.spin != 0;
    if (body.kind == Kind::kKinematic && body.velocity.norm() > 0 && !placed_[b].empty()) {
      Drop("body '" + body.name + "': moves on without end" +
           (turns ? ", here it turns alone" : "") + "; a scene has paths (kind = \"kinematic\")");
    }
    if (body.kind == Kind::kStatic || placed_[b].empty()) return;
    for (std::size_t i = 1; i < placed_[b].size(); ++i) {
      text_ += fmt::format("\n[[joint]]\nname = \"{}\"\nkind = \"weld\"\na = \"{}\"\nb = \"{}\"\n",
                           names_.Take(body.name + "-weld", "weld"), body.name, placed_[b][i].name);
    }
    if (!turns) return;
    text_ += fmt::format(
        "\n[[joint]]\nname = \"{}\"\nkind = \"kinematic\"\nb = \"{}\"\nanchor = {}\nturning = "
        "{:.9g}\n",
        names_.Take(body.name + "-turns", "turns"), body.name, Pair(body.position),
        Clamp(body.spin, -double{kSpinMax}, double{kSpinMax}, "body '" + body.name + "': spin"));
  }

  void WriteMaterial(const ImportedBody& body, const Placed& placed) {
    const ImportedShape& shape = *placed.shape;
    const std::string what = "body '" + body.name + "': ";
    const bool line = IsLine(placed.piece.kind);
    if (body.kind == Kind::kDynamic) {
      if (line) text_ += "anchored = false\n";
      text_ += fmt::format("density = {:.9g}\n", placed.density);
    } else if (!line) {
      text_ += "anchored = true\n";
    }
    text_ += fmt::format("friction = {:.9g}\n", Clamp(shape.friction, 0, 1, what + "friction"));
    if (shape.restitution != 0) {
      text_ += fmt::format("restitution = {:.9g}\n",
                           Clamp(shape.restitution, 0, 1, what + "restitution"));
    }
    // Negative numbers are 16 bits with all of the higher ones set.
    const int category = shape.category & 0xffff, mask = shape.mask & 0xffff;
    if (category != 1) text_ += fmt::format("category = {}\n", category);
    if (mask != 0xffff) text_ += fmt::format("mask = {}\n", mask);
    if (shape.group != 0) {
      text_ += fmt::format("group = {:.0f}\n", Clamp(shape.group, -1000, 1000, what + "group"));
    }
  }

  void WriteMotion(const ImportedBody& body) {
    const std::string what = "body '" + body.name + "': ";
    const Vector2d v = body.velocity;
    if (v.norm() > double{kSpeedMax}) Drop(what + "speed above 120 m/s");
    const Vector2d velocity = v.norm() > double{kSpeedMax} ? v * (0.999 * kSpeedMax / v.norm()) : v;
    if (velocity.norm() > 0) text_ += fmt::format("velocity = {}\n", Pair(velocity));
    const double spin = Clamp(body.spin, -double{kSpinMax}, double{kSpinMax}, what + "spin");
    if (spin != 0) text_ += fmt::format("spin = {:.9g}\n", spin);
    const auto value = [&](const char* key, double number, double usual, const Range& range) {
      if (number == usual) return;
      text_ += fmt::format("{} = {:.9g}\n", key, Clamp(number, range.min, range.max, what + key));
    };
    value("linear_damping", body.linear_damping, 0, kPartDamping);
    value("angular_damping", body.angular_damping, 0, kPartDamping);
    value("gravity_scale", body.gravity_scale, 1, kGravityScale);
    if (body.fixed_rotation) text_ += "fixed_rotation = true\n";
    if (body.bullet) text_ += "bullet = true\n";
  }

  void WriteJoint(std::size_t index) {
    ImportedJoint& j = world_.joints[index];
    if (j.kind.empty()) {
      return Drop("joint " + std::to_string(index) + ": has no values, as a dumped mouse joint");
    }
    static const std::set<std::string> known = {"hinge", "prismatic", "wheel",  "distance", "rope",
                                                "weld",  "motor",     "pulley", "gear"};
    const std::string label = j.name.empty() ? j.kind + "-" + std::to_string(index) : j.name;
    const std::string what = "joint '" + label + "': ";
    if (known.count(j.kind) == 0) return Drop(what + "a scene has no " + j.kind + " joints");
    if (!HasEnds(j)) return Drop(what + "a body that it joins is not there");
    const auto a = static_cast<std::size_t>(j.a), b = static_cast<std::size_t>(j.b);
    if (world_.bodies[a].kind != Kind::kDynamic && world_.bodies[b].kind != Kind::kDynamic) {
      return Drop(what + "neither of its bodies moves");
    }
    const bool line = j.kind == "distance" || j.kind == "rope";
    if (line && j.length < double{kEdgeMin}) return Drop(what + "shorter than 2 cm");
    std::string text = fmt::format("kind = \"{}\"\n", j.kind);
    if (j.kind == "gear") {
      std::string names;
      for (const int of : j.joints) {
        if (written_.count(of) == 0) return Drop(what + "a joint that it couples is not there");
        names += (names.empty() ? "\"" : ", \"") + written_[of] + "\"";
      }
      text += fmt::format("joints = [{}]\nratio = {:.9g}\n", names, j.ratio == 0 ? 1 : j.ratio);
    } else {
      text += EndsText(j, a, b) + DetailsText(j, a, b, what);
    }
    const bool rigid = IsRigidWeld(j);
    if (j.collide && !rigid) text += "collide = true\n";
    written_[static_cast<int>(index)] = names_.Take(label, j.kind);
    text_ += fmt::format("\n[[joint]]\nname = \"{}\"\n{}", written_[static_cast<int>(index)], text);
  }

  std::string EndsText(const ImportedJoint& j, std::size_t a, std::size_t b) const {
    const Transform2 &of_a = placed_[a][0].piece.pose, &of_b = placed_[b][0].piece.pose;
    std::string text =
        fmt::format("a = \"{}\"\nb = \"{}\"\n", placed_[a][0].name, placed_[b][0].name);
    text += fmt::format("local_a = {}\nlocal_b = {}\n", Pair(of_a.Inverse()(j.local_a)),
                        Pair(of_b.Inverse()(j.local_b)));
    if (j.kind == "weld" || j.kind == "hinge" || j.kind == "prismatic" || j.kind == "motor") {
      text += fmt::format("reference_angle = {:.9g}\n", j.reference + of_b.angle - of_a.angle);
    }
    if (j.kind == "wheel" || j.kind == "prismatic") {
      const Vector2d axis =
          Turned(j.axis.norm() > 1e-3 ? j.axis : Vector2d(1, 0), world_.bodies[a].angle);
      text += fmt::format("axis = {}\n", Pair(axis));
    }
    return text;
  }

  std::string DetailsText(const ImportedJoint& j, std::size_t a, std::size_t b,
                          const std::string& what) {
    std::string text;
    if (j.kind == "motor") {
      return fmt::format("force = {:.9g}\ntorque = {:.9g}\n",
                         Clamp(j.force, 0, 1e7, what + "force"),
                         Clamp(j.torque, 0, 1e7, what + "torque"));
    }
    if (j.kind == "pulley") {
      return fmt::format("ground_a = {}\nground_b = {}\nratio = {:.9g}\nlength = {:.9g}\n",
                         Pair(j.ground_a), Pair(j.ground_b), j.ratio, j.length);
    }
    const bool line = j.kind == "distance" || j.kind == "rope";
    if (line) text += fmt::format("length = {:.9g}\n", j.length);
    if (j.kind != "hinge" && j.kind != "rope") text += SpringText(j, a, b, what);
    if (j.kind == "rope" || j.kind == "weld") return text;
    const bool sprung = j.frequency > 0 || j.stiffness > 0;  // else a wheel would be rigid here
    if (j.kind == "wheel" && !sprung && !j.limited) text += "limits = [-1000, 1000]\n";
    if (j.limited && j.lower <= j.upper) {
      const double low = j.kind == "distance" ? std::max(j.lower, double{kEdgeMin}) : j.lower;
      const double most = j.kind == "distance" ? 10000 : HUGE_VAL;
      text +=
          fmt::format("limits = [{:.9g}, {:.9g}]\n", low, std::max(low, std::min(j.upper, most)));
    }
    if (j.motor && j.most > 0 && j.kind != "distance") {
      text += fmt::format("motor = {{speed = {:.9g}, {} = {:.9g}}}\n",
                          Clamp(j.speed, -1000, 1000, what + "motor speed"),
                          j.kind == "prismatic" ? "force" : "torque",
                          Clamp(j.most, 1e-6, 1e7, what + "motor"));
    }
    return text;
  }

  /// Box2D 2.4 gives stiffness and damping; the frequency follows from the reduced mass:
  /// omega^2 = k / m, ratio = c / (2 m omega) (b2LinearStiffness, b2AngularStiffness).
  std::string SpringText(const ImportedJoint& j, std::size_t a, std::size_t b,
                         const std::string& what) {
    double frequency = j.frequency, ratio = j.damping_ratio;
    if (j.stiffness > 0) {
      const MassProperties of_a = MassOf(a), of_b = MassOf(b);
      const bool turns = j.kind == "weld";
      const double mass =
          1 / (1 / (turns ? of_a.inertia : of_a.mass) + 1 / (turns ? of_b.inertia : of_b.mass));
      const double omega = std::sqrt(j.stiffness / mass);
      frequency = omega / (2 * kPi);
      ratio = j.damping / (2 * mass * omega);
    }
    if (frequency <= 0) return "";
    return fmt::format("frequency = {:.9g}\ndamping_ratio = {:.9g}\n",
                       Clamp(frequency, 0, 60, what + "frequency"),
                       Clamp(ratio, 0, 10, what + "damping ratio"));
  }

  Imported& world_;
  std::vector<std::vector<Placed>> placed_;  // by body
  UniqueNames names_;
  std::map<int, std::string> written_;  // joints by their index in the file
  double size_ = 0, reach_ = 0;         // m: largest moving shape; farthest moving body
  std::string text_;
};

}  // namespace

std::string SceneText(Imported* world, const std::string& title) {
  return SceneWriter(world).Write(title);
}

}  // namespace seam
