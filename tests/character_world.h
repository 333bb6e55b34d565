#pragma once
/// Worlds with one character, "hero" of ann, for tests and benches.

#include <algorithm>
#include <string>

#include "tests/scripted_world.h"

namespace seam {

constexpr const char* kFlatGround = R"(
[solver]
substeps = 4
[[player]]
name = "ann"
[[part]]
name = "ground"
chain = [[-200, 0], [200, 0]]
friction = 0.8
)";

/// `character` are more lines of [[character]], which may be followed by other tables.
inline Scene FlatScene(const std::string& character, const std::string& ground = kFlatGround) {
  const bool passive = character.find("\"passive\"") != std::string::npos;
  const std::string head = std::string("[[character]]\nname = \"hero\"\n") +
                           (passive ? "owner" : "player") + " = \"ann\"\n";
  return ParseScene(ground + head + character, "hero.toml");
}

/// rad by which a joint of the scene is beyond its limits, at most.
inline double BeyondLimits(const ScriptedWorld& run) {
  const Scene& scene = run.world.scene();
  double beyond = 0;
  for (const Joint& joint : scene.joints) {
    const auto angle = [&](PartId part) {
      const Part& p = scene.parts[static_cast<std::size_t>(part)];
      return static_cast<double>(run.Read(p.name).angle - p.angle);
    };
    const double turn = angle(joint.b) - angle(joint.a);
    beyond = std::max({beyond, static_cast<double>(joint.lower) - turn,
                       turn - static_cast<double>(joint.upper)});
  }
  return beyond;
}

}  // namespace seam
