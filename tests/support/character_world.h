#pragma once
/// Worlds with one character, "hero" of ann, for tests and benches.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "common/scene/character.h"
#include "tests/support/scripted_world.h"

namespace seam {

constexpr const char* kCharacterSolver = "[solver]\nsubsteps = 4\n";
constexpr const char* kFlatGround = R"(
[[part]]
name = "ground"
chain = [[-200, 0], [200, 0]]
friction = 0.8
)";

/// `character`: more lines of [[character]], which other tables may follow; `script`: ann's inputs.
inline Scene CharacterScene(const std::string& character, const std::string& script = "[[0, {}]]",
                            const std::string& ground = kFlatGround) {
  const bool passive = character.find("\"passive\"") != std::string::npos;
  const std::string head = std::string("[[character]]\nname = \"hero\"\n") +
                           (passive ? "owner" : "player") + " = \"ann\"\n";
  const std::string player = "[[player]]\nname = \"ann\"\nscript = " + script + "\n";
  return ParseScene(kCharacterSolver + player + ground + head + character, "hero.toml");
}

/// Visible state of the hero.
struct Hero {
  Vec2 centre{0, 0}, velocity{0, 0};  ///< of mass, m and m/s
  float mass = 0;                     ///< kg
  float head_y = 0, foot_y = 0;       ///< m; middles, of the lower foot
  float lean = 0;                     ///< rad, of the torso
  bool upright() const { return std::abs(lean) < 0.6f && head_y - foot_y > 1.3f; }
};

inline Hero Look(const ScriptedWorld& run) {
  Hero hero;
  const World& world = run.world;
  for (const PartId part : world.scene().characters[0].parts) {
    const int body = run.Body(world.scene().parts[static_cast<std::size_t>(part)].name);
    const BodyState state = world.Read(body);
    hero.mass += world.mass(body);
    hero.centre += world.mass(body) * state.position;
    hero.velocity += world.mass(body) * state.velocity;
  }
  hero.centre /= hero.mass;
  hero.velocity /= hero.mass;
  hero.head_y = run.Read("hero.head").position.y();
  hero.foot_y =
      std::min(run.Read("hero.foot-l").position.y(), run.Read("hero.foot-r").position.y());
  hero.lean = run.Read("hero.torso").angle;
  return hero;
}

/// Applies an impulse to the middle of the torso, N s.
inline void Shove(ScriptedWorld* run, Vec2 impulse) {
  const int torso = run->Body("hero.torso");
  BodyState state = run->world.Read(torso);
  state.velocity += impulse / run->world.mass(torso);
  run->world.Write(torso, state);
}

/// True if the hero stands at rest 6 s after an impulse of `impulse` N s, and its head was never
/// near the ground.
inline bool StandsUnder(float impulse) {
  ScriptedWorld run(CharacterScene("position = [0, 0]\n"));
  run.StepTo(60);
  Shove(&run, Vec2(impulse, 0));
  for (int tick = 0; tick < 360; ++tick) {
    run.Step();
    if (Look(run).head_y < 0.9f) return false;
  }
  return Look(run).upright() && Look(run).velocity.norm() < 0.1f;
}

/// Returns the torques of the hero's motors in the engine's last step, N m. Requires a scene
/// without other joints. Takes a barrier, so the world is rebuilt.
inline std::vector<float> MotorTorques(ScriptedWorld* run) {
  const WorldSnapshot snapshot = run->world.Barrier();
  const Solver& solver = run->world.scene().solver;
  const auto steps_hz = static_cast<float>(solver.tick_hz * solver.substeps);
  // Per hinge: two of the point, the motor's, two of the limits.
  std::vector<float> torques(kCharacterJoints);
  for (std::size_t j = 0; j < torques.size(); ++j) {
    torques[j] = steps_hz * snapshot.joints.at(j).at(2);
  }
  return torques;
}

/// Returns the largest angle by which a joint of the scene exceeds its limits, rad.
inline double BeyondLimits(const ScriptedWorld& run) {
  const Scene& scene = run.world.scene();
  double beyond = 0;
  for (const Joint& joint : scene.joints) {
    if (!joint.limited) continue;
    const auto angle = [&](PartId part) {
      const Part& p = scene.parts[static_cast<std::size_t>(part)];
      return static_cast<double>(run.Read(p.name).angle - p.angle);
    };
    const double turn = angle(joint.b) - angle(joint.a);
    beyond = std::max(
        {beyond, static_cast<double>(joint.lower) - turn, turn - static_cast<double>(joint.upper)});
  }
  return beyond;
}

}  // namespace seam
