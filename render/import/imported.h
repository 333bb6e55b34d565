#pragma once
/// A world read from another program's file, before it is written as a scene. SI units; frames and
/// names as in Box2D.

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace seam {

struct ImportedShape {
  enum class Kind { kCircle, kPolygon, kChain, kTwoSidedChain };
  Kind kind = Kind::kPolygon;
  std::string name;
  Eigen::Vector2d centre{0, 0};         ///< kCircle: m, in the body's frame
  double radius = 0;                    ///< kCircle: m
  std::vector<Eigen::Vector2d> points;  ///< m, in the body's frame. kPolygon: a simple outline;
                                        ///< kChain: open on its right, as in Box2D
  double density = 0, friction = 0.2, restitution = 0;
  int category = 1, mask = 0xffff, group = 0;
  bool sensor = false;
};

struct ImportedBody {
  enum class Kind { kStatic, kKinematic, kDynamic };
  Kind kind = Kind::kStatic;
  std::string name;
  Eigen::Vector2d position{0, 0};  ///< m, of the origin
  double angle = 0;                ///< rad
  Eigen::Vector2d velocity{0, 0};  ///< m/s, of the centre of mass
  double spin = 0;                 ///< rad/s
  double linear_damping = 0, angular_damping = 0, gravity_scale = 1;
  bool fixed_rotation = false, bullet = false, active = true, awake = true;
  double mass = 0;  ///< kg, set by hand; 0: that of its shapes
  std::optional<Eigen::Vector2d> centre;  ///< m, of mass, in its frame; nullopt: not said
  std::vector<ImportedShape> shapes;
};

struct ImportedJoint {
  std::string kind;  ///< a kind of [[joint]]; others are dropped under this name
  std::string name;
  int a = -1, b = -1;                            ///< bodies
  Eigen::Vector2d local_a{0, 0}, local_b{0, 0};  ///< m, in the bodies' frames
  Eigen::Vector2d axis{1, 0};                    ///< in a's frame
  Eigen::Vector2d ground_a{0, 0}, ground_b{0, 0};
  double reference = 0;  ///< rad
  bool limited = false, motor = false, collide = false;
  double lower = 0, upper = 0, speed = 0, most = 0;  ///< motor: rad/s or m/s, N m or N
  double frequency = 0, damping_ratio = 0;           ///< Hz, 1
  double stiffness = 0, damping = 0;                 ///< N/m, N s/m: instead of the two above
  double length = 0, ratio = 1;                      ///< m (rope: the most), 1
  double force = 0, torque = 0;                      ///< N, N m: a motor joint's largest. Its
                                                     ///< local_a is the place of b's origin
  std::array<int, 2> joints{-1, -1};                 ///< gear: the coupled joints
};

struct Imported {
  Eigen::Vector2d gravity{0, -10};
  std::vector<ImportedBody> bodies;
  std::vector<ImportedJoint> joints;
  std::vector<std::string> dropped;  ///< a line for each thing that could not be kept
};

/// Reads R.U.B.E. JSON (https://www.iforce2d.net/rube/json-structure). Throws OperatorError.
Imported ReadRube(const std::string& text, const std::string& file);

/// Reads the C++ text that b2World::Dump writes (Box2D 2.3 and 2.4). Throws OperatorError
/// "file:line: ...".
Imported ReadDump(const std::string& text, const std::string& file);

/// Reads the objects of a Tiled map (https://doc.mapeditor.org/en/stable/reference/tmx-map-format),
/// with `pixels` for a metre and the y axis turned up. Throws OperatorError.
Imported ReadTiled(const std::string& text, const std::string& file, double pixels);

/// Returns the text of a scene, with `title`. Adds to `world->dropped` what a scene cannot have.
std::string SceneText(Imported* world, const std::string& title);

}  // namespace seam
