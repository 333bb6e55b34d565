#include <cmath>

#include "common/base/check.h"
#include "common/physics/assembly.h"
#include "common/physics/mass.h"
#include "common/physics/scene_draft.h"
#include "common/physics/scene_limits.h"

namespace seam {
namespace {

/// What the checks look at, and how they complain.
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
  const MassProperties mass = AssemblyProperties(c.scene, assembly);
  const double arm_squared = mass.centre.dot(mass.centre);
  if (!(mass.inertia >= kInertiaShareMin * mass.mass * arm_squared) || !(mass.inertia > 1e-12)) {
    c.Fail(root.line, "part '" + root.name + "': what is welded to it lies too far away");
  }
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
      c.Fail(part.line, "part '" + part.name +
                            "': is welded to an anchored part: no velocity, spin or owner");
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
  for (const Joint& joint : c.scene.joints) {
    if (joint.kind == JointKind::kWeld) continue;
    const Assembly& a = c.assembly_of(joint.a);
    const Assembly& b = c.assembly_of(joint.b);
    const std::string name = "joint '" + joint.name + "': ";
    if (a.id == b.id) c.Fail(joint.line, name + "its parts are welded together");
    if (a.anchored && b.anchored) c.Fail(joint.line, name + "both its parts are anchored");
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
      const Part& part = c.part(player.vehicle);
      const Assembly& assembly = c.assembly_of(player.vehicle);
      if (assembly.anchored) {
        c.Fail(part.line, name + "the vehicle '" + part.name + "' is anchored");
      }
      int& other = driver[static_cast<std::size_t>(assembly.mechanism)];
      if (other >= 0) {
        c.Fail(part.line, name + "the vehicle '" + part.name + "' is '" +
                              c.scene.players[static_cast<std::size_t>(other)].name + "'s");
      }
      other = static_cast<int>(p);
    }
    for (const Action& action : player.actions) {
      const Part& part = c.part(action.part);
      const Assembly& assembly = c.assembly_of(action.part);
      if (assembly.anchored) c.Fail(part.line, name + "action on '" + part.name + "': is anchored");
      const double mass = AssemblyProperties(c.scene, assembly).mass;
      if (static_cast<double>(action.impulse.norm()) / mass >
          static_cast<double>(c.scene.speed_limit)) {
        c.Fail(part.line, name + "action on '" + part.name + "' (" + Decimal(mass) +
                              " kg): its impulse makes it faster than the speed_limit");
      }
    }
  }
}

void CheckWatch(const Checked& c) {
  for (const WatchCollision& watch : c.scene.watch) {
    for (const PartId id : watch.struck) {
      const Part& part = c.part(id);
      if (c.assembly_of(id).anchored) {
        c.Fail(part.line, "watch: struck part '" + part.name + "' is anchored");
      }
    }
  }
}

}  // namespace

void CheckScene(const Scene& scene, const std::string& file) {
  const Composition composition = Compose(scene);
  const Checked checked{scene, composition, file};
  CheckAssemblies(checked);
  CheckJoints(checked);
  CheckOwners(checked);
  CheckPlayers(checked);
  CheckWatch(checked);
}

}  // namespace seam
