#pragma once
/// Small scenes with mechanisms that the engine's own solver does not touch, for tests.

#include <memory>
#include <string>
#include <vector>

#include "common/measure/joint_drift.h"
#include "tests/support/small_world.h"

namespace seam {

/// Solver lines.
constexpr const char* kExactJoints = "joints = \"exact\"\n";

/// A part's table.
inline std::string PartText(const std::string& name, const std::string& rest) {
  return "[[part]]\nname = \"" + name + "\"\n" + rest + "\n";
}

/// A hinge's table.
inline std::string HingeText(const std::string& name, const std::string& a, const std::string& b,
                             double x, double y, const std::string& rest = "") {
  return "[[joint]]\nname = \"" + name + "\"\nkind = \"hinge\"\na = \"" + a + "\"\nb = \"" + b +
         "\"\nanchor = [" + FloatDigits(x) + ", " + FloatDigits(y) + "]\n" + rest + "\n";
}

/// `count` links "link.0".. of 1 m by 0.2 m from (x, y) to the right, hinged at their ends. `rest`
/// are further keys of each.
inline std::string ChainText(int count, double x, double y, const std::string& rest = "") {
  std::string text = PartText(
      "link", "box = [1, 0.2]\nposition = [" + FloatDigits(x + 0.5) + ", " + FloatDigits(y) +
                  "]\nrepeat = {count = " + std::to_string(count) + ", step = [1, 0]}\n" + rest);
  for (int i = 0; i + 1 < count; ++i) {
    text += HingeText("h" + std::to_string(i), "link." + std::to_string(i),
                      "link." + std::to_string(i + 1), x + i + 1, y);
  }
  return text;
}

constexpr const char* kGround = "[[part]]\nname = \"ground\"\nchain = [[-50, 0], [50, 0]]\n";

inline std::string PostText(double x, double y) {
  return PartText("post", "box = [0.2, 0.2]\nanchored = true\nposition = [" + FloatDigits(x) +
                              ", " + FloatDigits(y) + "]");
}

/// Exact joints, and no sleeping.
inline std::unique_ptr<World> ExactWorld(const std::string& parts, const std::string& solver = "",
                                         const std::string& top = "") {
  return SmallWorld(parts, kExactJoints + solver, top);
}

inline std::vector<BodyState> StatesOf(const World& world) {
  std::vector<BodyState> states;
  for (int body = 0; body < world.body_count(); ++body) states.push_back(world.Read(body));
  return states;
}

/// m: how far its worst joint is apart.
inline double Drift(const World& world) {
  return JointMeter(world.scene(), world.composition()).Worst(StatesOf(world), world.tick());
}

}  // namespace seam
