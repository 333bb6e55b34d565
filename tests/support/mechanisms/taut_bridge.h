#pragma once
/// A taut bridge: planks of 1 m hinged in a straight line between two piers, and a load that falls
/// on its middle. Straight, it cannot give way at all; a joint that gives way by 1e-5 m lets it
/// sink by centimetres. The family of tests and of `seam-lab world taut-bridge`.

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "common/measure/joint_drift.h"
#include "common/physics/world.h"
#include "tests/support/small_world.h"

namespace seam {

struct TautBridge {
  int planks = 60;
  double load = 40;    ///< kg
  double drop = 0.05;  ///< m, from where it touches: 2 cm above the planks
  int substeps = 2;    ///< joint_substeps
  std::string joints = "auto";
  double plank_density = 1;  ///< kg/m2; a plank has 0.2 m2
  std::string solver;        ///< further lines of [solver]
  std::string more;          ///< further parts
};

inline std::string TautBridgeParts(const TautBridge& bridge) {
  const double half = bridge.planks / 2.0;
  const std::string last = std::to_string(bridge.planks - 1);
  const auto pier = [](const char* name, double x) {
    return std::string("[[part]]\nname = \"") + name + "\"\nbox = [2, 2]\nanchored = true\n" +
           "friction = 0.6\nposition = [" + FloatDigits(x) + ", 0]\n";
  };
  const auto hinge = [](const std::string& name, const std::string& a, const std::string& b,
                        double x) {
    return "[[joint]]\nname = \"" + name + "\"\nkind = \"hinge\"\na = \"" + a + "\"\nb = \"" + b +
           "\"\nanchor = [" + FloatDigits(x) + ", 0]\n";
  };
  return pier("left", -half - 1) + pier("right", half + 1) +
         "[[part]]\nname = \"plank\"\nbox = [1, 0.2]\nfriction = 0.6\ndensity = " +
         FloatDigits(bridge.plank_density) + "\nposition = [" + FloatDigits(0.5 - half) +
         ", 0]\nrepeat = {count = " + std::to_string(bridge.planks) + ", step = [1, 0]}\n" +
         "[[part]]\nname = \"load\"\nbox = [2, 2]\nfriction = 0.6\ndensity = " +
         FloatDigits(bridge.load / 4) + "\nposition = [0, " + FloatDigits(1.12 + bridge.drop) +
         "]\n" + bridge.more + hinge("first", "left", "plank.0", -half) +
         hinge("last", "plank." + last, "right", half) +
         hinge("pin", "plank.0", "plank.1", 1 - half) + "repeat = {count = " + last +
         ", step = [1, 0]}\n";
}

inline std::unique_ptr<World> TautBridgeWorld(const TautBridge& bridge) {
  return SmallWorld(TautBridgeParts(bridge),
                    "joints = \"" + bridge.joints + "\"\njoint_substeps = " +
                        std::to_string(bridge.substeps) + "\n" + bridge.solver);
}

struct BridgeCourse {
  double gained = 0;    ///< J: the most energy above that at the beginning
  double released = 0;  ///< J: the most that falling has released
  double gap = 0;       ///< m: the widest joint
  double fastest = 0;   ///< m/s, of any body
  double lowest = 1e9;  ///< m, of any body's middle
};

inline BridgeCourse FollowBridge(World* world, double seconds) {
  const JointMeter meter(world->scene(), world->composition());
  const double begin = world->Energy();
  BridgeCourse course;
  for (int tick = 0; tick < seconds * world->scene().solver.tick_hz; ++tick) {
    world->Step();
    std::vector<BodyState> states;
    double kinetic = 0;
    for (int body = 0; body < world->body_count(); ++body) {
      const BodyState state = world->Read(body);
      const MassPoint mass = world->mass_point(body);
      const double speed = double{state.velocity.norm()}, spin = double{state.spin};
      kinetic += (double{mass.mass} * speed * speed + double{mass.inertia} * spin * spin) / 2;
      course.fastest = std::max(course.fastest, speed);
      course.lowest = std::min(course.lowest, double{state.position.y()});
      states.push_back(state);
    }
    const double now = world->Energy();
    course.gained = std::max(course.gained, now - begin);
    course.released = std::max(course.released, begin - (now - kinetic));
    course.gap = std::max(course.gap, meter.Worst(states, world->tick()));
  }
  return course;
}

}  // namespace seam
