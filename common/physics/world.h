#pragma once
/// A simulated world: a scene's assemblies in Box2D, stepped by ticks. Deterministic: the same
/// calls give the same bits, at any optimisation level, in any process.

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "common/base/status.h"
#include "common/physics/activity.h"
#include "common/physics/paged.h"
#include "common/physics/pin.h"
#include "common/scene/assembly.h"
#include "common/scene/scene.h"
#include "common/topology/body_remap.h"
#include "common/topology/topology.h"

namespace seam {

class StateArchive;

/// A contact's change of velocity in the last tick, large enough for a visible spark.
struct Impact {
  int body_a = -1, body_b = -1;  ///< body indices; -1: anchored
  Vec2 point{0, 0};              ///< m
  float dv = 0;                  ///< m/s, impulse over mass, the larger of the two bodies'
};

/// Two moving bodies in contact (with contact points) at the end of the last tick.
struct Touch {
  int body_a = -1, body_b = -1;  ///< body indices
};

/// Two parts of different bodies in contact, anchored ones included, a < b.
struct PartTouch {
  PartId a = -1, b = -1;
  bool operator<(const PartTouch& o) const { return a != o.a ? a < o.a : b < o.b; }
  bool operator==(const PartTouch& o) const { return a == o.a && b == o.b; }
};

/// A direction in which a body is held back: the normal of any contact, or the line of a distance
/// joint to an anchor.
struct BlockedDirection {
  int body = -1;
  Vec2 normal{0, 1};  ///< unit
};
/// Cosine above which two blocked directions count as one.
constexpr float kSameDirection = 0.9f;

/// The state from which a world continues, except the order of its contacts and its inputs. Only a
/// world that did a Barrier at that tick continues with the same bits.
struct WorldSnapshot {
  struct Body {
    BodyState state;
    bool awake = true;
    float quiet_s = 0;  ///< how long it has been slow enough to sleep
    float going_s = 0;  ///< how long it has been slow, and would not stay (rest/slow_watch.h)
  };
  /// A contact point's impulse: the warm start of the next step.
  struct Point {
    std::uint64_t pair = 0;         ///< the two shapes
    std::uint64_t feature = 0;      ///< feature ids of the two shapes
    float normal = 0, tangent = 0;  ///< N s
  };
  struct Left {
    int body = -1;  ///< lowest body of the island's first mechanism
    int steps = 0;  ///< number of steps left
    bool operator==(const Left& o) const { return body == o.body && steps == o.steps; }
  };
  std::int64_t tick = 0;
  std::uint64_t composition = 0;   ///< hash of the parts of each body
  std::uint64_t joints_there = 0;  ///< hash of the existing joints
  Paged<Body> bodies;              ///< pages without present or changed bodies are shared
  std::vector<Point> points;       ///< ascending by pair, feature
  /// Impulses, N s and N m s, by the scene's joints; empty: broken, or its bodies not present.
  std::vector<std::vector<float>> joints;
  std::vector<Left> left;     ///< islands with joints not solved as one system, ascending
  std::vector<float> speeds;  ///< of motors, rad/s or m/s, by the scene's joints
  std::vector<float> stages;  ///< memory of each stage
  /// Parts in touch when the tick was last stepped, ascending; empty without WatchTouches.
  std::vector<PartTouch> touching;
};

/// Writes or reads a snapshot. World::Load checks it.
void Persist(StateArchive& a, WorldSnapshot* snapshot);

/// `body` is below an index 0..body_count()-1 into the moving assemblies, ascending by id. Apply
/// may renumber all of them.
class World {
 public:
  explicit World(const Scene& scene);
  /// Builds the edited scene, each assembly at the pose of its root part.
  explicit World(const Topology& topology);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  const Scene& scene() const;  ///< with all edits so far
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
  /// Like Read, for any assembly by its index in composition(), anchored and kinematic ones
  /// included.
  BodyState ReadAssembly(int assembly) const;
  /// Returns the geometric constraints of the joints, in the scene's order. They stay the same
  /// until Apply returns a change.
  std::vector<Pin> Pins() const;
  /// Sets pose and velocity. Requires finite values (asserted). Wakes the body if `wake`; else a
  /// sleeping body takes the pose and sleeps on, without velocity. Contact caches survive a small
  /// move; bit-equal values change nothing.
  void Write(int body, const BodyState& state, bool wake = true);
  bool awake(int body) const;
  /// Returns a stamp of a sleeping body that is not present, 0 for any other body. It changes
  /// whenever the body may have been moved or woken. Does not read the body itself.
  std::uint64_t still(int body) const;
  /// Appends the bodies, possibly repeated, with a still() that may have changed since
  /// last_change() was `change`. False, with nothing appended, if that is longer ago than the log
  /// reaches.
  bool ChangedSince(std::uint64_t change, std::vector<int>* bodies) const;
  std::uint64_t last_change() const;
  /// Wakes the body or puts it to sleep. If the scene's solver has no sleep, dynamic bodies stay
  /// awake.
  void SetAwake(int body, bool awake);

  /// Changes a body's activity, initially kSimulated. The velocity of a body that is not simulated
  /// is that of its origin, not of its centre of mass; a change converts it. A change to or from
  /// kKinematic drops the body's contacts. A body comes or goes (IsPresent) at the next step,
  /// barrier or restore, which rebuilds the world. All bodies of a mechanism should go together: no
  /// joint holds a body that is not present. A dormant body that comes back sleeps on, and its
  /// contacts keep their impulses if it is where it was; those of other bodies start at zero.
  void SetActivity(int body, Activity activity);
  Activity activity(int body) const;
  /// Lets bodies come and go now: call before an edit that queries surroundings.
  void Settle();
  /// Returns the bodies that are present, ascending: a tick's work should be proportional to
  /// them.
  const std::vector<int>& present() const;
  /// Returns the number of accesses to a body by its index, as a measure of the callers' work.
  std::int64_t looks() const;

  /// Applies a player's input from now on: motors follow its axes, stages receive all of it; a
  /// seated player drives the seat instead. Buttons start no action here (see Act).
  void SetInput(int player, const Input& input);
  /// Applies the push of the player's action (an index in the scene), now.
  void Act(int player, int action);

  /// Applies edits in their order. Bodies that split or merge are made anew: momentum, angular
  /// momentum and contacts carry over. Returns nullopt if all bodies and joints are unchanged.
  std::optional<BodyRemap> Apply(const std::vector<Edit>& edits);
  /// Repeats, after Restore, the effect on motions and seats of an edit for which Apply has
  /// returned nullopt since the snapshot. Does not count as another edit.
  void Repeat(const Edit& edit);
  /// Returns the edits that the last tick causes; see Stage::ProposeEdits. Nothing has changed yet.
  std::vector<Edit> ProposeEdits() const;

  /// Advances by one tick.
  void Step();

  const std::vector<Impact>& impacts() const;  ///< of the last tick, dv above kImpactRecordMin
  /// Returns the touches after the last tick, each pair once. Found at the first call after a step.
  const std::vector<Touch>& touches() const;

  /// Returns the touches by part, ascending, anchored parts included. Found at every call.
  std::vector<PartTouch> PartTouches() const;
  /// Finds begun_touches from the next step on; the touches of now count as begun in it.
  void WatchTouches();
  /// Returns the pairs of parts that began to touch in the last tick, however briefly, ascending,
  /// each once; empty without WatchTouches.
  const std::vector<PartTouch>& begun_touches() const;

  /// Returns the bounding box of the body's shapes in its current pose, m: lower and upper corner.
  std::pair<Vec2, Vec2> Bounds(int body) const;

  /// Returns the unobstructed share, 0 to 1, of the straight line from one place to another: up to
  /// the first anchored obstacle that the body collides with; 1 if there is none. An obstacle that
  /// contains `from` does not count.
  float FreeWay(int body, const Vec2& from, const Vec2& to) const;

  /// Returns the overlap of two bodies at other poses than their own, m, by their shapes without
  /// rims; 0 if they do not overlap, or may not collide.
  float OverlapAt(int a, const BodyState& pose_a, int b, const BodyState& pose_b) const;

  /// True if a joint holds the body, to another or to something anchored.
  bool Joined(int body) const;
  /// Returns a state after `seconds` of free flight: gravity moves the body, and it bounces off
  /// stationary anchored shapes. Other bodies, joints and water are ignored.
  BodyState AfterFlight(int body, const BodyState& from, float seconds) const;

  /// Returns the directions after the last tick, ascending by body; at most two per body.
  const std::vector<BlockedDirection>& blocked_directions() const;

  /// Rebuilds the world, so that its future depends on its state alone and not on its history, and
  /// returns that state. Bodies, motions and motors stay; impulses of contacts and joints are
  /// carried over.
  WorldSnapshot Barrier();
  /// Returns the state without a rebuild. Stepping again from it gives nearly the same result, but
  /// not bit for bit.
  WorldSnapshot Keep();
  /// Goes back to a state that Barrier returned. Motions stay as they are now. Motor speeds are
  /// restored: otherwise the next input, though unchanged, would count as a change and wake bodies.
  /// With the same calls after it, the world repeats its course bit for bit. Requires the bodies
  /// and joints of the snapshot, that is, that Apply has returned nullopt since; else returns an
  /// error of one line and changes nothing.
  Status Restore(const WorldSnapshot& snapshot);
  /// Like Restore, for a snapshot that another process took and that may be damaged, in a world of
  /// the same topology. Sets the tick, too. Returns an error of one line if the snapshot cannot be
  /// one of such a world; the world must then not be used any more.
  Status Load(const WorldSnapshot& snapshot);
  /// Returns the bodies that may differ from the snapshot, ascending: all present ones, and
  /// others by whole pages of which any body has changed. Requires as many bodies as it has.
  std::vector<int> MayDifferFrom(const WorldSnapshot& snapshot) const;

  /// Returns FNV-1a over tick, poses, velocities and sleep flags of all bodies, bit for bit.
  std::uint64_t Hash() const;

  /// Returns the kinetic plus potential energy of the moving bodies, J.
  double Energy() const;

 private:
  void Do(const Edit& edit);
  void Push(const PushEdit& edit);
  void Follow(int player, const Input& input);
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Impacts below this change of velocity are not recorded, m/s. A body resting under g = 10
/// receives 0.17 each tick of 1/60 s, and as much more for each that lies on it: a lower value
/// makes piles expensive.
constexpr float kImpactRecordMin = 1.5f;

}  // namespace seam
