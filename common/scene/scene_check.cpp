#include "common/base/check.h"
#include "common/scene/assembly.h"
#include "common/scene/crowding/crowding.h"
#include "common/scene/forces.h"
#include "common/scene/joint_kinds.h"
#include "common/scene/mass.h"
#include "common/scene/scene_draft.h"
#include "common/scene/scene_limits.h"

namespace seam {
namespace {

/// Subject of the checks, and the way to report a fault.
struct Checked {
  const Scene& scene;
  const Composition& composition;
  const std::string& file;

  [[noreturn]] void Fail(int line, const std::string& what) const {
    throw OperatorError(file + ":" + std::to_string(line) + ": " + what);
  }
  const Part& part(PartId id) const { return scene.parts[static_cast<std::size_t>(id)]; }
  const Assembly& assembly_of(PartId id) const {
    const int index = composition.assembly_of_part[static_cast<std::size_t>(id)];
    return composition.assemblies[static_cast<std::size_t>(index)];
  }
};

void CheckMoving(const Checked& c, const Assembly& assembly) {
  const Part& root = c.part(assembly.id);
  for (const PartId id : assembly.parts) {
    const Part& part = c.part(id);
    const bool still = part.velocity == Vec2(0, 0) && part.spin == 0;
    if (!still && (part.velocity != root.velocity || part.spin != root.spin)) {
      c.Fail(part.line, "part '" + part.name + "': is welded to '" + root.name +
                            "', which has another velocity or spin");
    }
  }
}

void CheckAnchored(const Checked& c, const Assembly& assembly) {
  for (const PartId id : assembly.parts) {
    const Part& part = c.part(id);
    if (part.velocity != Vec2(0, 0) || part.spin != 0 || part.owner >= 0) {
      c.Fail(part.line,
             "part '" + part.name + "': is welded to an anchored part: no velocity, spin or owner");
    }
  }
}

void CheckAssemblies(const Checked& c) {
  for (const Assembly& assembly : c.composition.assemblies) {
    const Part& root = c.part(assembly.id);
    for (const PartId id : assembly.parts) {
      const Part& part = c.part(id);
      if ((part.position - root.position).norm() > kWeldReachMax) {
        c.Fail(part.line, "part '" + part.name + "': is welded to '" + root.name +
                              "' over more than " + Decimal(kWeldReachMax) + " m");
      }
    }
    if (assembly.anchored) {
      CheckAnchored(c, assembly);
    } else {
      CheckMoving(c, assembly);
    }
  }
}

void CheckJoints(const Checked& c) {
  for (std::size_t i = 0; i < c.scene.joints.size(); ++i) {
    const Joint& joint = c.scene.joints[i];
    if (IsRigid(joint, c.scene.solver)) continue;
    const Assembly& a = c.assembly_of(joint.a);
    const Assembly& b = c.assembly_of(joint.b);
    const std::string name = "joint '" + joint.name + "': ";
    if (HoldOf(joint.kind) == JointHold::kImposed) {
      if (!b.anchored) c.Fail(joint.line, name + "'" + c.part(joint.b).name + "' is not anchored");
      const int other = b.kinematic;
      if (other == static_cast<int>(i)) continue;
      const Joint& mover = c.scene.joints[static_cast<std::size_t>(other)];
      c.Fail(joint.line, name + "'" + mover.name + "' moves the same assembly");
    }
    if (a.id == b.id) c.Fail(joint.line, name + "its parts are welded together");
    if (a.anchored && b.anchored) c.Fail(joint.line, name + "both its parts are anchored");
    if (HoldOf(joint.kind) != JointHold::kCoupled) continue;
    for (const PartId id : {joint.a, joint.b}) {  // the engine finds gears only at moving bodies
      if (!c.assembly_of(id).anchored) continue;
      c.Fail(joint.line, name + "it turns '" + c.part(id).name + "', which is anchored");
    }
  }
}

void CheckThrusts(const Checked& c) {
  for (const Thrust& thrust : c.scene.thrusts) {
    if (!c.assembly_of(thrust.part).anchored) continue;
    const std::string what = thrust.screw.diameter > 0 ? "propeller" : "thrust";
    c.Fail(thrust.line,
           what + " '" + thrust.name + "': '" + c.part(thrust.part).name + "' is anchored");
  }
}

void CheckOwners(const Checked& c) {
  for (const Part& part : c.scene.parts) {
    const Assembly& assembly = c.assembly_of(part.id);
    if (part.owner < 0 || assembly.anchored) continue;
    const int owner = c.composition.mechanisms[static_cast<std::size_t>(assembly.mechanism)].owner;
    if (owner == part.owner) continue;
    c.Fail(part.line, "part '" + part.name + "': is joined to a part that '" +
                          c.scene.players[static_cast<std::size_t>(owner)].name + "' owns");
  }
}

void CheckPlayers(const Checked& c) {
  std::vector<int> driver(c.composition.mechanisms.size(), -1);
  for (std::size_t p = 0; p < c.scene.players.size(); ++p) {
    const Player& player = c.scene.players[p];
    const std::string name = "player '" + player.name + "': ";
    if (player.vehicle >= 0) {
      const std::string vehicle = name + "the vehicle '" + c.part(player.vehicle).name + "' is ";
      const Assembly& assembly = c.assembly_of(player.vehicle);
      if (assembly.anchored) c.Fail(player.line, vehicle + "anchored");
      int& other = driver[static_cast<std::size_t>(assembly.mechanism)];
      if (other >= 0) {
        const Player& first = c.scene.players[static_cast<std::size_t>(other)];
        const bool joined = first.vehicle != player.vehicle;
        c.Fail(player.line, vehicle + (joined ? "joined to '" : "'") + first.name +
                                (joined ? "'s: what is joined is one player's" : "'s already"));
      }
      other = static_cast<int>(p);
    }
    for (const Action& action : player.actions) {
      const std::string what = name + "action on '" + c.part(action.part).name + "': ";
      const Assembly& assembly = c.assembly_of(action.part);
      if (assembly.anchored) c.Fail(action.line, what + "it is anchored");
      const double mass = AssemblyProperties(c.scene, assembly).mass;
      const double speed = static_cast<double>(action.impulse.norm()) / mass;
      if (speed > static_cast<double>(c.scene.speed_limit)) {
        c.Fail(action.line,
               what + "the impulse makes its " + Decimal(mass) + " kg faster than the speed_limit");
      }
    }
  }
}

void CheckWatch(const Checked& c) {
  for (const WatchCollision& watch : c.scene.watch) {
    for (const PartId id : watch.struck) {
      if (!c.assembly_of(id).anchored) continue;
      c.Fail(watch.line, "watch: the struck part '" + c.part(id).name + "' is anchored");
    }
  }
}

}  // namespace

void CheckScene(const Scene& scene, const std::string& file) {
  const Composition composition = Compose(scene);
  const Checked checked{scene, composition, file};
  CheckAssemblies(checked);
  CheckJoints(checked);
  CheckThrusts(checked);
  CheckOwners(checked);
  CheckPlayers(checked);
  CheckWatch(checked);
  CheckCrowding(scene, composition, file);
}

}  // namespace seam
