#pragma once
/// One simulated world: a scene's assemblies in Box2D, stepped a tick at a time. Deterministic:
/// the same calls give the same bits, at any optimisation level, in any process.

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "common/base/status.h"
#include "common/physics/paged.h"
#include "common/physics/pin.h"
#include "common/scene/assembly.h"
#include "common/scene/scene.h"
#include "common/topology/body_remap.h"
#include "common/topology/topology.h"

namespace seam {

/// A change of velocity by contact that may be worth a spark, felt in the last tick.
struct Impact {
  int body_a = -1, body_b = -1;  ///< body indices; -1: anchored
  Vec2 point{0, 0};              ///< m
  float dv = 0;                  ///< m/s, impulse over mass, the larger of the two bodies'
};

/// Two moving bodies that touched (with contact points) at the end of the last tick.
struct Touch {
  int body_a = -1, body_b = -1;  ///< body indices
};

/// Two parts of different bodies that touch, anchored ones included, a < b.
struct PartTouch {
  PartId a = -1, b = -1;
  bool operator<(const PartTouch& o) const { return a != o.a ? a < o.a : b < o.b; }
};

/// A direction in which something holds a body back: the normal of a contact, whatever it is with,
/// or the line of a distance joint to an anchor.
struct BlockedDirection {
  int body = -1;
  Vec2 normal{0, 1};  ///< unit
};

/// How a body takes part in a step.
enum class Motion {
  kDynamic,    ///< contacts and joints move it
  kKinematic,  ///< as if it had infinite mass: it moves by its velocity and feels nothing
  kLed,        ///< others feel its real mass; after the step it is where its velocity takes it
  kAbsent,     ///< it touches nothing and moves by its velocity; steps do not look at it
};

/// All that decides how a world goes on from a tick, except the order of its contacts and its
/// actions. Only a world that did a Barrier at that tick continues with the same bits.
struct WorldSnapshot {
  struct Body {
    BodyState state;
    bool awake = true;
    float quiet_s = 0;  ///< how long it has been slow enough to sleep
  };
  /// Of one point of a contact, where the next step begins to look for its impulse.
  struct Point {
    std::uint64_t pair = 0;         ///< the two shapes
    std::uint64_t feature = 0;      ///< which pieces of them
    float normal = 0, tangent = 0;  ///< N s
  };
  struct Left {
    int body = -1;  ///< the lowest of its first mechanism
    int steps = 0;  ///< for so many more
    bool operator==(const Left& o) const { return body == o.body && steps == o.steps; }
  };
  std::int64_t tick = 0;
  std::uint64_t composition = 0;   ///< hash of who was one body with whom
  std::uint64_t joints_there = 0;  ///< hash of which joints there were
  Paged<Body> bodies;              ///< pages of what is absent and has not changed are shared
  std::vector<Point> points;       ///< ascending by pair, feature
  /// Impulses, N s and N m s, by the scene's joints; empty: broken, or its bodies were absent.
  std::vector<std::vector<float>> joints;
  std::vector<Left> left;     ///< islands of joints that are not solved as a whole, ascending
  std::vector<float> speeds;  ///< of motors, rad/s or m/s, by the scene's joints
  std::vector<float> stages;  ///< what each stage remembers
};

/// A `body` below is an index 0..body_count()-1 of the moving assemblies, ascending by id. Apply
/// may change all of them.
class World {
 public:
  explicit World(const Scene& scene);
  /// A scene as it has become by edits, everything where its assembly's root part is placed.
  explicit World(const Topology& topology);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  const Scene& scene() const;  ///< as it has become
  const Composition& composition() const;
  const Topology& topology() const;
  int body_count() const;
  PartId id(int body) const;            ///< assembly id
  int BodyOfId(PartId assembly) const;  ///< -1 if there is no such moving assembly
  int mechanism(int body) const;        ///< index into composition().mechanisms
  float mass(int body) const;           ///< kg
  MassPoint mass_point(int body) const;

  std::int64_t tick() const;        ///< ticks stepped so far
  void SetTick(std::int64_t tick);  ///< for a peer that joins later
  float dt() const;                 ///< s per tick

  BodyState Read(int body) const;
  /// The same of any assembly, by its index in composition(): also of what is anchored or
  /// kinematic.
  BodyState ReadAssembly(int assembly) const;
  /// What its joints hold now, in the scene's order. They stay the same until Apply returns a
  /// change.
  std::vector<Pin> Pins() const;
  /// Sets pose and velocity. Requires finite values (asserted). Wakes the body if `wake`; else a
  /// sleeping body takes the pose and sleeps on, without velocity. Contact caches survive when the
  /// move is small; bit-equal values change nothing.
  void Write(int body, const BodyState& state, bool wake = true);
  bool awake(int body) const;
  /// Of what is absent and sleeps, a number that is another one once it may have been moved or
  /// woken; 0 of all else. Asks for no look at the body itself.
  std::uint64_t still(int body) const;
  /// Appends the bodies, some several times, for which still() may have another answer than when
  /// last_change() was `change`. False, and nothing appended, when that is too long ago to know.
  bool ChangedSince(std::uint64_t change, std::vector<int>* bodies) const;
  std::uint64_t last_change() const;
  /// Where a scene's solver has no sleep, nothing that is simulated sleeps.
  void SetAwake(int body, bool awake);

  /// The velocity of bodies that are not dynamic is that of `position`, not of the centre of mass.
  /// A change carries the motion over; to or from kKinematic it drops the body's contacts. To or
  /// from kAbsent it holds from the next step, barrier or restore on, for which the world is built
  /// anew; all bodies of a mechanism should be absent together, because no joint holds one that is.
  void SetMotion(int body, Motion motion);
  Motion motion(int body) const;
  /// Before a body that sleeps becomes absent: what its contacts pressed with, they begin with when
  /// it is there again and lies as it does now. Else they begin with nothing, as of all that comes.
  void RememberContacts(int body);
  /// Lets it hold now, if there is a change to or from kAbsent: before an edit that looks around.
  void Settle();
  /// Those that are not absent, ascending: what the work of a tick is to be proportional to.
  const std::vector<int>& present() const;
  /// How often a body was looked at, or written to, by its index: the work that callers made of it.
  std::int64_t looks() const;

  /// The motors that follow this player's axes from now on. Buttons are not looked at.
  void SetInput(int player, const Input& input);
  /// The push of the scene's player's action (index), now.
  void Act(int player, int action);

  /// Applies edits in their order. Where they change who is one body with whom, the bodies
  /// concerned are made anew: momentum, angular momentum and contacts carry over.
  /// nullopt: all bodies and joints are what they were.
  std::optional<BodyRemap> Apply(const std::vector<Edit>& edits);
  /// Does again, after Restore, an edit for which Apply has returned nullopt since the snapshot:
  /// what it does to motions and seats. It does not count as another edit.
  void Repeat(const Edit& edit);
  /// What the last tick gives reason to change; see Stage::ProposeEdits. Nothing has changed yet.
  std::vector<Edit> ProposeEdits() const;

  /// Advances by one tick.
  void Step();

  const std::vector<Impact>& impacts() const;  ///< of the last tick, dv above kImpactRecordMin
  /// After the last tick, each pair once. Looked up at the first call after a step.
  const std::vector<Touch>& touches() const;

  /// The same by part, ascending; also of what is anchored. Looked up at every call.
  std::vector<PartTouch> PartTouches() const;

  /// The box around the body's shapes as it lies now, m: lower and upper corner.
  std::pair<Vec2, Vec2> Bounds(int body) const;

  /// The share of the straight way from one place to another, 0 to 1, after which something
  /// anchored that the body collides with lies across it; 1: nothing does. What `from` is in does
  /// not count.
  float FreeWay(int body, const Vec2& from, const Vec2& to) const;

  /// Whether a joint holds the body, to another or to what is anchored.
  bool Joined(int body) const;
  /// Where the body comes from a state in `seconds` of free flight: gravity moves it, and it
  /// bounces off what is anchored and stands still; other bodies, joints and water are not met.
  BodyState AfterFlight(int body, const BodyState& from, float seconds) const;

  /// After the last tick, ascending by body; at most two per body.
  const std::vector<BlockedDirection>& blocked_directions() const;

  /// Rebuilds the world, so that nothing is left in it of how it came to its state, and returns
  /// that state. Bodies, motions and motors stay; impulses of contacts and joints are carried over.
  WorldSnapshot Barrier();
  /// That state, and nothing is rebuilt: what is stepped again from it comes out almost as it did,
  /// but not bit for bit.
  WorldSnapshot Keep();
  /// Goes back to a state that Barrier returned. Motions stay as they are now; motors turn as they
  /// did then, or the next input would wake what it changes nothing of. With the same calls after
  /// it, the world does again, bit for bit, what it did then.
  /// Only while bodies and joints are those of the snapshot, that is, while Apply has returned
  /// nullopt since: else an error, one line, and nothing has changed.
  Status Restore(const WorldSnapshot& snapshot);
  /// The bodies that may not be as in the snapshot, ascending: all that are present are among them,
  /// what is absent and lies as it did is not. Requires as many bodies as it has.
  std::vector<int> ApartFrom(const WorldSnapshot& snapshot) const;

  /// FNV-1a over tick, poses, velocities and sleep flags of all bodies, bit for bit.
  std::uint64_t Hash() const;

  /// Deepest overlap of two touching shapes by true geometry is common/measure's business; this is
  /// kinetic plus potential energy of the moving bodies, J.
  double Energy() const;

 private:
  void Do(const Edit& edit);
  void Push(const PushEdit& edit);
  void Follow(int player, const Input& input);
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Impacts below this change of velocity are not recorded, m/s. A body resting under g = 10 feels
/// 0.17 each tick of 1/60 s, and as much more for each that lies on it: lower makes piles
/// expensive.
constexpr float kImpactRecordMin = 1.5f;

}  // namespace seam
