#pragma once
/// A scene as data: the checked contents of scenes/*.toml, in SI units. docs/scenes.md is its
/// reference.

#include <array>
#include <string>
#include <vector>

#include "common/base/limits.h"
#include "common/scene/feature.h"
#include "common/scene/motion/collision_filter.h"
#include "common/scene/types.h"

namespace seam {

struct BrickField;    // bricks.h
struct Character;     // character.h
struct Charge;        // charge.h
struct Connectors;    // connectors.h
struct Conveyor;      // forces.h
struct Strand;        // strand.h
struct Thrust;        // forces.h
struct Expected;      // expected.h
struct Grouping;      // grouping.h
struct LcmTables;     // lcm/lcm_tables.h
struct PartMotion;    // motion/part_motion.h
struct PartRules;     // part_rules.h
struct PlannerRules;  // planner/planner_rules.h
struct ScriptSource;  // part_rules.h
struct Trigger;       // part_rules.h
struct Water;         // water.h

enum class ShapeKind { kBox, kCircle, kCapsule, kPolygon, kChain, kSegment };

/// True for shapes without an inside: anchored unless the scene says otherwise; a moving one has
/// the mass of a strip (mass.h).
inline bool IsLine(ShapeKind kind) {
  return kind == ShapeKind::kChain || kind == ShapeKind::kSegment;
}

struct Material {
  float density = 1;      ///< kg/m^2, 0.01..100
  float friction = 0.5f;  ///< 0..1
  float restitution = 0;  ///< 0..1
};

struct Part {
  PartId id = 0;
  std::string name;  ///< unique
  ShapeKind kind = ShapeKind::kBox;
  Vec2 position{0, 0};       ///< m
  float angle = 0;           ///< rad
  Vec2 size{1, 1};           ///< box: full width and height, m
  float radius = 0.5f;       ///< circle, capsule, m
  std::vector<Vec2> points;  ///< local, m: polygon (convex, 3..64; a wedge is one), chain (>= 2;
                             ///< solid on its right-hand side along its points), segment (2) or the
                             ///< centres of a capsule's ends (2)
  Material material;
  bool anchored = false;  ///< never moves
  bool bullet = false;    ///< continuous collision against moving bodies
  CollisionFilter filter;
  Vec2 velocity{0, 0};    ///< m/s at tick 0, of the assembly's centre of mass
  float spin = 0;         ///< rad/s at tick 0
  Feature<PartMotion> motion;
  Feature<PartRules> rules;
  int owner = -1;  ///< player with the authority while connected; -1: by region
  Feature<Connectors> connectors;
  bool gone = false;           ///< removed at run time (common/topology/topology.h)
  Feature<Conveyor> conveyor;  ///< motion of its surface
  int line = 0;                ///< line in the scene file
};

enum class JointKind {
  kWeld,
  kGlue,
  kRevolute,
  kWheel,
  kDistance,
  kRope,
  kPrismatic,
  kMotor,
  kKinematic,
  kGear,
  kPulley
};

struct Joint {
  std::string name;
  JointKind kind = JointKind::kWeld;
  PartId a = 0, b = 0;     ///< kKinematic: both are the moved part
  Vec2 anchor_a{0, 0};     ///< world, at tick 0
  Vec2 anchor_b{0, 0};     ///< world; at first as anchor_a, unless kDistance, kRope, kPulley
  Vec2 axis{0, 1};         ///< world, unit; kWheel: spring's; kPrismatic: motion's
  float frequency_hz = 0;  ///< spring's (wheel, distance, weld); 0: rigid. A prismatic joint's
                           ///< spring is a distance joint of its own, coupled to it
  float damping_ratio = 0.7f;
  float length = -1;           ///< m; kRope: the most; -1: as placed; kPulley: the sum with `ratio`
  bool limited = false;        ///< kRevolute, kWheel, kPrismatic, kDistance
  float lower = 0, upper = 0;  ///< rad; wheel, prismatic: m from the start; distance: m
  float strength = 0;          ///< kGlue: N, the force at which it breaks; 0: never
  bool collide = false;        ///< the joined bodies collide with each other
  bool grouped = false;        ///< kGlue: made because its parts rest; a disturbance undoes it
  float turn = 0;              ///< rad; rotation that bonds have added to the pose of b, less a's
  bool gone = false;           ///< broken or removed at run time
  int motor_player = -1;       ///< this player's axis turns the motor; -1: a constant motor
  InputAxis motor_axis = InputAxis::kDrive;
  float motor_speed = 0;   ///< rad/s (kPrismatic: m/s) at full drive
  float motor_torque = 0;  ///< N m (kPrismatic: N), the largest; 0: no motor
  float force_max = 0;     ///< kMotor: N, largest force that holds b's position in a's frame
  float torque_max = 0;    ///< kMotor: N m, largest torque that holds b's angle against a's
  Vec2 reach{0, 0};        ///< kMotor: m, shift of that position at the player's full axis
  float swing = 0;         ///< kMotor: rad, rotation of that angle at full axis
  std::vector<Vec2> path;  ///< kKinematic: m from its position, visited in a cycle
  double period_s = 0;     ///< kKinematic: one cycle
  double phase = 0;        ///< kKinematic: share of the cycle done at tick 0
  bool ease = false;       ///< kKinematic: pauses for a moment at each point
  float turning = 0;       ///< kKinematic: rad/s about the anchor
  /// Earlier joints with which this one ends. kGear: the two coupled joints (hinge or prismatic).
  /// The gear's a and b are their second parts. With q the angle or shift of each since the start:
  /// q[0] + ratio * q[1] = 0
  std::array<int, 2> coupled{-1, -1};
  /// kGear: rad or m of the first joint for 1 rad or m of the second; not 0.
  /// kPulley: metres that a's side gives for one metre of b's; above 0:
  /// anchor_a - ground_a| + ratio * |anchor_b - ground_b| = length
  float ratio = 1;
  Vec2 ground_a{0, 0}, ground_b{0, 0};  ///< kPulley: world, m; upper ends of the ropes
  int line = 0;
};

/// A push when a button goes down: velocity change for one assembly.
struct Action {
  int button = 0;  ///< 0..14
  PartId part = 0;
  Vec2 impulse{0, 0};  ///< N s, at the centre of mass
  int line = 0;        ///< line in the scene file
};

/// Scripted input, valid from `from_tick` until the next span.
struct InputSpan {
  std::int64_t from_tick = 0;
  Input input;
};

struct Player {
  std::string name;     ///< as in seam-client --name
  PartId vehicle = -1;  ///< a part of the player's own mechanism, or -1
  bool has_region = false;
  Vec2 region_min{0, 0}, region_max{0, 0};  ///< static region, m
  std::vector<Action> actions;
  std::vector<InputSpan> script;  ///< ascending
  int line = 0;                   ///< line in the scene file
};

/// A seat: motors and thrusts that name the seat as their player follow the player in it. The
/// inputs of seat s are those of player `players.size() + s`.
struct Seat {
  std::string name;  ///< differs from all players' names
  PartId part = 0;   ///< part with the seat
  Vec2 at{0, 0};     ///< m, in the part's frame: place of the player's own part
  float angle = 0;   ///< rad, of the player's own part against the seat's
  float reach = 2;   ///< m; largest distance for getting in
  int button = 0;    ///< gets in and out
  int player = -1;   ///< player in the seat now; -1: none
  int line = 0;      ///< line in the scene file
};

/// Collision shapes of a large assembly (kFacesFrom parts or more).
enum class Faces {
  kMerged,  ///< touching aligned boxes become one shape
  kOuter,   ///< boxes with a box on all four sides are left out
  kAll,
};

/// Solver of islands that contain a joint.
enum class JointSolving {
  kAuto,       ///< kExact, unless a cost estimate says that it does not pay
  kExact,      ///< joints and contacts as one system (docs/solver.md)
  kIterative,  ///< the engine, joint by joint
};

/// Solver of islands without joints.
enum class ContactSolving {
  kEngine,  ///< the engine's own
  kSoft,    ///< soft contacts in substeps (docs/solver.md)
};

struct Solver {
  int tick_hz = 60;             ///< 10..960
  int substeps = 1;             ///< 1..32 Box2D steps per tick, at least SubstepsMin(tick_hz)
  int velocity_iterations = 8;  ///< 1..64
  int position_iterations = 3;  ///< 1..64
  bool sleep = true;
  bool continuous = true;     ///< fast bodies do not pass through anchored ones
  bool warm_starting = true;  ///< each step starts from the previous impulses
  /// m; contact skin: rounded rim at which shapes collide before they touch. 0: the engine's own (1
  /// cm for polygons and chains, none for circles, so that boxes rest 1.5 cm apart). Else moving
  /// shapes have this rim; anchored and bullet ones keep 1 cm and are moved in by the difference.
  /// Bodies then rest 2 skin - 5 mm apart: none at 2.5 mm, the least allowed. A scene with soft
  /// contacts that does not set it has 2.5 mm.
  float skin = 0;
  ContactSolving contacts = ContactSolving::kEngine;
  int contact_substeps = 4;  ///< 1..16 for each engine step, where contacts are soft
  JointSolving joints = JointSolving::kAuto;
  int joint_substeps = 2;    ///< 1..16 for each engine step, where joints are exact
  bool weld_joints = false;  ///< welds are the engine's joints; parts stay separate bodies
  Faces faces = Faces::kMerged;
};

/// A collision between players' parts to be measured (common/measure: rebound).
struct WatchCollision {
  std::vector<PartId> struck;    ///< their momentum is compared with the oracle's
  std::int64_t around_tick = 0;  ///< start of the search
  int line = 0;                  ///< line in the scene file
};

struct Camera {
  bool given = false;              ///< the scene says min or max; else pictures fit what moves
  Vec2 min{-20, -2}, max{20, 12};  ///< area that must be visible, m
  PartId follow = -1;
};

struct Scene {
  std::string name;  ///< file name without folder and .toml
  std::string title;
  Vec2 gravity{0, -10};
  Solver solver;
  double duration_s = 10;  ///< length of the demo
  float buffer_m = 10;     ///< width of the buffer zone
  /// Every peer follows a room of at most this many moving bodies whole. In a larger room, a peer
  /// uses dead reckoning for bodies outside its buffer zone that cannot soon meet its own.
  int follow_bodies = 256;
  /// The server also simulates all bodies of rooms with at most this many moving bodies, under any
  /// authority.
  int server_follow = 256;
  int input_delay_ticks = 0;                              ///< from sampling an input to its tick
  int show_age_ticks = kShowAgeTicks;                     ///< of others' displayed bodies, at most
  float speed_limit = 120;                                ///< m/s: faster states are implausible
  Vec2 bounds_min{-1000, -1000}, bounds_max{1000, 1000};  ///< states outside are implausible
  std::vector<Part> parts;
  std::vector<Joint> joints;
  FeatureList<BrickField> bricks;  ///< anchored; not parts
  FeatureList<Water> waters;
  FeatureList<Strand> strands;  ///< visual only
  FeatureList<Thrust> thrusts;
  Feature<Grouping> grouping;
  FeatureList<Character> characters;
  std::vector<Player> players;
  std::vector<Seat> seats;
  FeatureList<Trigger> triggers;      ///< for the server only
  FeatureList<Charge> charges;        ///< for the server only
  FeatureList<ScriptSource> scripts;  ///< for the server only
  std::vector<WatchCollision> watch;
  Feature<Expected> expected;
  Feature<PlannerRules> planner;
  Feature<LcmTables> lcm;
  Camera camera;
  std::string text;  ///< the file's text
};

/// Returns an anchored part like the brick of this field with its lower left corner at x, y
/// (units), without name and id.
Part BrickPart(const BrickField& field, int x, int y);

/// Parses and checks a scene. Throws OperatorError "file:line: what" at the first mistake; a scene
/// that passes never makes Box2D abort.
Scene ParseScene(const std::string& text, const std::string& file_name);
/// Reads the file and calls ParseScene.
Scene LoadScene(const std::string& path);

}  // namespace seam
