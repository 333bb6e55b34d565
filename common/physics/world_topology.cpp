/// World: bodies that split and merge. Momentum and angular momentum are carried over exactly (to
/// rounding), contacts by the parts that touch.
///
///   before: bodies X (parts 1 2 3) and Y (4)      edit: 3 breaks off, 3 bonds with 4
///   after:  bodies (1 2) and (3 4)
///   a body after = pieces of bodies before; each piece moves as the body it comes from;
///   v = sum m_k v_k / sum m_k,  w = sum (I_k w_k + m_k r_k x v_k) / I

#include <algorithm>
#include <map>

#include "common/base/geometry.h"
#include "common/physics/blast_push.h"
#include "common/physics/carried_along.h"
#include "common/physics/rest/edit_wake.h"
#include "common/physics/world_impl.h"
#include "common/scene/mass.h"

namespace seam {
namespace {

using Eigen::Vector2d;

const Assembly& AssemblyOf(const Composition& c, int index) {
  return c.assemblies[static_cast<std::size_t>(index)];
}

int AssemblyIndex(const Composition& c, PartId part) {
  const auto p = static_cast<std::size_t>(part);
  return p < c.assembly_of_part.size() ? c.assembly_of_part[p] : -1;
}

/// Converts the velocity of a body's origin to that of its centre of mass, or back with `sign` -1.
/// The states of kPrescribed and kinematic bodies have the former; momentum needs the latter.
void ShiftVelocity(const Vector2d& centre, double sign, BodyState* state) {
  const Vector2d arm = Turned(centre, static_cast<double>(state->angle));
  const double spin = sign * static_cast<double>(state->spin);
  state->velocity =
      (state->velocity.cast<double>() + spin * Vector2d(-arm.y(), arm.x())).cast<float>();
}

/// Motion of an assembly: pose of its root, velocity of its centre.
struct RigidMotion {
  BodyState state;
  Vector2d centre{0, 0};  // m, in the root's frame: of mass, but a lift's root
};

/// The world before the edits.
struct WorldBeforeEdit {
  Composition composition;
  std::vector<Part> parts;            // poses within their assemblies
  std::vector<BodyState> states;      // by body, velocities of the centres of mass
  std::vector<int> body_of_assembly;  // -1: anchored
  std::vector<RigidMotion> motions;   // by assembly

  int BodyOf(PartId part) const {
    const int index = AssemblyIndex(composition, part);
    return index < 0 ? -1 : body_of_assembly[static_cast<std::size_t>(index)];
  }
  /// Returns the assembly with the part, if that moved or was moved along a path; else -1.
  int MovedWith(PartId part) const {
    const int index = AssemblyIndex(composition, part);
    if (index < 0) return -1;
    const Assembly& assembly = AssemblyOf(composition, index);
    return assembly.anchored && assembly.kinematic < 0 ? -1 : index;
  }
  const RigidMotion& MotionOf(int assembly) const {
    return motions[static_cast<std::size_t>(assembly)];
  }
  const Part& RootOf(PartId part) const {
    return parts[static_cast<std::size_t>(
        AssemblyOf(composition, AssemblyIndex(composition, part)).id)];
  }
};

/// A rigid piece: parts of one body before that are in one body now.
struct Piece {
  double mass = 0, inertia = 0;  // kg, kg m^2 about `centre_now`
  Vector2d centre_then{0, 0};    // m, in the root's frame before
  Vector2d centre_now{0, 0};     // m, in the root's frame now
  std::vector<PartId> parts;
};

Piece PieceOf(const WorldBeforeEdit& before, const Scene& scene, const Part& root_now,
              const std::vector<PartId>& parts, bool came) {
  Piece piece;
  piece.parts = parts;
  for (const PartId id : parts) {
    const auto p = static_cast<std::size_t>(id);
    const MassProperties own = PartProperties(scene.parts[p]);
    piece.mass += own.mass;
    piece.centre_now += own.mass * ToRootFrame(scene.parts[p], root_now, own.centre);
    if (came) {
      piece.centre_then += own.mass * ToRootFrame(before.parts[p], before.RootOf(id), own.centre);
    }
  }
  if (piece.mass > 0) {
    piece.centre_now /= piece.mass;
    piece.centre_then /= piece.mass;
  }
  for (const PartId id : parts) {
    const Part& part = scene.parts[static_cast<std::size_t>(id)];
    const MassProperties own = PartProperties(part);
    const Vector2d arm = ToRootFrame(part, root_now, own.centre) - piece.centre_now;
    piece.inertia += own.inertia + own.mass * arm.dot(arm);
  }
  return piece;
}

BodyOrigin OriginOf(const WorldBeforeEdit& before, const Scene& scene, const Assembly& now) {
  BodyOrigin origin;
  origin.body = before.BodyOf(now.id);
  const int moved_with = before.MovedWith(now.id);
  if (moved_with < 0) return origin;
  const Assembly& then = AssemblyOf(before.composition, moved_with);
  origin.same = origin.body >= 0 && then.id == now.id && then.parts == now.parts;
  const Part& root_then = before.parts[static_cast<std::size_t>(then.id)];
  const Part& root_part = before.parts[static_cast<std::size_t>(now.id)];
  origin.root = ToRootFrame(root_part, root_then, Vector2d(0, 0));
  origin.angle = root_part.id == root_then.id
                     ? 0.0
                     : static_cast<double>(root_part.angle) - static_cast<double>(root_then.angle);
  origin.centre_before = before.MotionOf(moved_with).centre;
  std::vector<PartId> from_there;
  for (const PartId id : now.parts) {
    if (before.MovedWith(id) == moved_with) from_there.push_back(id);
  }
  const Part& root_now = scene.parts[static_cast<std::size_t>(now.id)];
  origin.centre = PieceOf(before, scene, root_now, from_there, true).centre_then;
  return origin;
}

/// Returns the motion of a body made of pieces.
BodyState StateOf(const WorldBeforeEdit& before, const Scene& scene, const Assembly& now,
                  const BodyOrigin& origin) {
  const Part& root = scene.parts[static_cast<std::size_t>(now.id)];
  if (origin.same) return before.states[static_cast<std::size_t>(origin.body)];
  BodyState state;
  state.position = root.position;
  state.angle = root.angle;
  const int moved_with = before.MovedWith(now.id);
  if (moved_with >= 0) state = Carried(origin, before.MotionOf(moved_with).state);
  std::map<int, std::vector<PartId>> pieces;  // by the assembly that they moved with
  for (const PartId id : now.parts) pieces[before.MovedWith(id)].push_back(id);
  const MassProperties whole = AssemblyProperties(scene, now);
  const double angle = static_cast<double>(state.angle);
  Vector2d momentum{0, 0};
  double angular = 0;
  for (const auto& [assembly, parts] : pieces) {
    const Piece piece = PieceOf(before, scene, root, parts, assembly >= 0);
    Vector2d velocity{0, 0};
    double spin = 0;
    if (assembly >= 0) {
      const auto& [then, centre] = before.MotionOf(assembly);
      spin = static_cast<double>(then.spin);
      const Vector2d arm = Turned(piece.centre_then - centre, static_cast<double>(then.angle));
      velocity = then.velocity.cast<double>() + spin * Vector2d(-arm.y(), arm.x());
    } else {
      velocity = root.velocity.cast<double>();  // 0 for anchored parts
      spin = static_cast<double>(root.spin);
    }
    momentum += piece.mass * velocity;
    const Vector2d arm = Turned(piece.centre_now - whole.centre, angle);
    angular += piece.inertia * spin + piece.mass * Cross(arm, velocity);
  }
  if (whole.mass > 0) state.velocity = (momentum / whole.mass).cast<float>();
  if (whole.inertia > 0) state.spin = static_cast<float>(angular / whole.inertia);
  return state;
}

/// Moves bodies along with bonds and returns by how much. Velocities stay, and so does momentum.
std::vector<BodyState> Carry(const WorldBeforeEdit& before, const Scene& scene,
                             const Composition& now, std::vector<WorldSnapshot::Body>* bodies) {
  std::vector<BodyState> states;
  for (const WorldSnapshot::Body& body : *bodies) states.push_back(body.state);
  std::vector<BodyState> jumps =
      CarriedAlong({before.composition, before.parts, before.states}, {now, scene.parts, states});
  for (std::size_t i = 0; i < jumps.size(); ++i) {
    if (jumps[i].position == Vec2(0, 0) && jumps[i].angle == 0) continue;
    WorldSnapshot::Body& body = (*bodies)[i];
    body.state.position += jumps[i].position;
    body.state.angle += jumps[i].angle;
    body.awake = true;
    body.quiet_s = body.going_s = 0;
  }
  return jumps;
}

std::vector<std::vector<int>> MechanismsFrom(const WorldBeforeEdit& before,
                                             const Composition& now) {
  std::vector<std::vector<int>> all;
  for (const Mechanism& m : now.mechanisms) {
    std::vector<int> from;
    int first = -1;
    for (const int index : m.assemblies) {
      for (const PartId part : AssemblyOf(now, index).parts) {
        const int then = AssemblyIndex(before.composition, part);
        const int mechanism = then < 0 ? -1 : AssemblyOf(before.composition, then).mechanism;
        if (mechanism < 0) continue;
        from.push_back(mechanism);
        if (part == m.id) first = mechanism;
      }
    }
    std::sort(from.begin(), from.end());
    from.erase(std::unique(from.begin(), from.end()), from.end());
    const auto at = std::find(from.begin(), from.end(), first);
    if (at != from.end()) std::rotate(from.begin(), at, at + 1);
    all.push_back(from);
  }
  return all;
}

}  // namespace

BodyState Carried(const BodyOrigin& origin, const BodyState& before) {
  if (origin.same) return before;
  const double angle = static_cast<double>(before.angle);
  const double spin = static_cast<double>(before.spin);
  const Vector2d arm = Turned(origin.centre - origin.centre_before, angle);
  BodyState now = before;
  now.position = (before.position.cast<double>() + Turned(origin.root, angle)).cast<float>();
  now.angle = static_cast<float>(angle + origin.angle);
  now.velocity =
      (before.velocity.cast<double>() + spin * Vector2d(-arm.y(), arm.x())).cast<float>();
  return now;
}

std::optional<BodyRemap> World::Apply(const std::vector<Edit>& edits) {
  Impl& w = *impl_;
  const std::uint64_t hash = w.composition.hash;
  const std::size_t joints_before = w.scene.joints.size();
  WorldBeforeEdit before{w.composition, w.scene.parts, {}, BodyOfAssembly(w.composition), {}};
  for (std::size_t a = 0; a < w.composition.assemblies.size(); ++a) {
    const Assembly& assembly = w.composition.assemblies[a];
    RigidMotion moved{ReadAssembly(static_cast<int>(a))};
    const int body = before.body_of_assembly[a];
    if (body >= 0) {
      moved.centre = AssemblyProperties(w.scene, assembly).centre;
      if (activity(body) != Activity::kSimulated) ShiftVelocity(moved.centre, 1, &moved.state);
      before.states.push_back(moved.state);
    }
    before.motions.push_back(moved);
  }
  const std::vector<bool> held = w.AllHeld();
  const EditWake wake(*w.world, w.scene, w.built, held);
  const WorldSnapshot kept = w.Keep();
  const std::vector<Status> results = w.topology.Apply(edits);
  bool bonded = false;
  for (std::size_t i = 0; i < edits.size(); ++i) {
    bonded = bonded || (edits[i].As<BondEdit>() != nullptr && results[i].ok());
  }
  bool changed = w.composition.hash != hash || w.scene.joints.size() != joints_before;
  changed = changed || bonded;  // in place of one that is gone
  for (std::size_t a = 0; !changed && a < w.composition.assemblies.size(); ++a) {
    changed = w.composition.assemblies[a].kinematic != before.composition.assemblies[a].kinematic;
  }
  for (std::size_t j = 0; j < joints_before; ++j) {
    changed = changed || (held[j] && w.scene.joints[j].gone);
  }
  std::optional<BodyRemap> out;
  if (changed) {
    out.emplace();
    WorldSnapshot snapshot;
    snapshot.tick = w.tick;
    std::vector<Activity> activities;
    std::vector<WorldSnapshot::Body> bodies;
    for (const Assembly& now : w.composition.assemblies) {
      if (now.anchored) continue;
      const BodyOrigin origin = OriginOf(before, w.scene, now);
      WorldSnapshot::Body body;
      body.state = StateOf(before, w.scene, now, origin);
      activities.push_back(origin.body >= 0 ? activity(origin.body) : Activity::kSimulated);
      if (activities.back() != Activity::kSimulated) {
        ShiftVelocity(AssemblyProperties(w.scene, now).centre, -1, &body.state);
      }
      if (origin.same) {
        const WorldSnapshot::Body& then = kept.bodies[static_cast<std::size_t>(origin.body)];
        body.state = then.state;
        body.awake = then.awake;
        body.quiet_s = then.quiet_s;
        body.going_s = then.going_s;
      }
      bodies.push_back(body);
      out->bodies.push_back(origin);
    }
    out->mechanisms = MechanismsFrom(before, w.composition);
    if (bonded) out->jumps = Carry(before, w.scene, w.composition, &bodies);
    snapshot.bodies.Take(bodies);
    snapshot.points = kept.points;
    snapshot.joints = kept.joints;
    snapshot.speeds = kept.speeds;
    snapshot.touching = kept.touching;
    snapshot.stages = w.FindStages();
    w.memory.composition = 0;  // it belongs to other bodies or joints
    w.Rebuild(snapshot, &activities);
    const EditWake::Edited edited{*w.world,      w.scene, before.composition,
                                  w.composition, w.built, w.activities};
    for (const int body : wake.Bodies(edited, w.AllHeld())) SetAwake(body, true);
    w.impacts.clear();
  }
  for (const Edit& edit : edits) Do(edit);
  return out;
}

void World::Repeat(const Edit& edit) {
  const SeatEdit* seat = edit.As<SeatEdit>();
  if (seat != nullptr) impl_->topology.Sit(*seat);
  Do(edit);
}

void World::Do(const Edit& edit) {
  Impl& w = *impl_;
  w.as_built = false;
  const PushEdit* push = edit.As<PushEdit>();
  if (push != nullptr && w.topology.Validate(edit).ok()) Push(*push);
  const BlastEdit* blast = edit.As<BlastEdit>();
  if (blast != nullptr && blast->impulse > 0 && w.topology.Validate(edit).ok()) {
    PushAway(HitsOf(*w.world, w.scene, w.topology.BricksLeft(), *blast), w.scene.speed_limit);
  }
  const SeatEdit* seat = edit.As<SeatEdit>();
  if (seat != nullptr && seat->player < 0 && w.topology.Validate(edit).ok()) {
    Follow(static_cast<int>(w.scene.players.size()) + seat->seat, Input{});  // stops its motors
  }
  for (const auto& stage : w.stages) stage->Edited(edit);
  w.MarkAllAside();
}

void World::Push(const PushEdit& edit) {
  const int index = AssemblyIndex(composition(), edit.part);
  if (index < 0 || AssemblyOf(composition(), index).anchored) return;
  b2Body* body = impl_->built.bodies[static_cast<std::size_t>(index)];
  if (body->GetType() != b2_dynamicBody) return;
  body->ApplyLinearImpulseToCenter(ToB2(edit.impulse), true);
  body->ApplyAngularImpulse(edit.turn, true);
}

}  // namespace seam
