/// What an active character can do by its joints' torques alone, and its cost beside a limp one.

#include <fmt/format.h>

#include <algorithm>

#include "common/physics/part_places.h"
#include "tests/lab/world/bench.h"

namespace seam {
namespace {

std::string TextOf(const char* kind, int count) {
  std::string all =
      "[solver]\nsubsteps = 4\n[[player]]\nname = \"ann\"\n[[part]]\nname = \"ground\"\n"
      "chain = [[-200, 0], [400, 0]]\nfriction = 0.9\n";
  for (int i = 0; i < count; ++i) {
    const bool driven = i == 0 && kind[0] == 'a';
    all += fmt::format("[[character]]\nname = \"c{}\"\nkind = \"{}\"\n{}position = [{}, 0]\n", i,
                       kind, driven ? "player = \"ann\"\n" : "", 4 * i);
  }
  return all;
}

PartId Named(const World& world, const std::string& name) {
  for (const Part& part : world.scene().parts) {
    if (part.name == name) return part.id;
  }
  return -1;
}

void Steps(World* world, int ticks) {
  for (int i = 0; i < ticks; ++i) world->Step();
}

/// Whether it stands 4 s after a push of `impulse` N s on its torso.
bool Recovers(const Scene& scene, float impulse) {
  World world(scene);
  Steps(&world, 120);
  const PushEdit push{Named(world, "c0.torso"), {impulse, 0}};
  world.Apply({Edit(push, EditCause::kOutside)});
  const PartId head = Named(world, "c0.head");
  for (int tick = 0; tick < 240; ++tick) {
    world.Step();
    if (PartPose(world, head).position.y() < 0.9f) return false;
  }
  return true;
}

/// N s; the most in steps of 0.05 below which it always recovers.
float MostPush(const Scene& scene, float direction) {
  float most = 0;
  for (float push = 0.05f; push < 3; push += 0.05f) {
    if (!Recovers(scene, direction * push)) break;
    most = push;
  }
  return most;
}

}  // namespace

TextTable CharactersBench(bool quick) {
  const Scene one = ParseScene(TextOf("active", 1), "characters.toml");
  TextTable table;
  table.name = "world-characters";
  table.title = "An active character of 1.8 m and 0.65 kg: no force but its joints' torques";
  table.header = {"what", "value"};
  const auto add = [&](const char* what, const std::string& value) {
    table.rows.push_back({what, value});
  };
  add("recovers from a push on the torso from behind, N s", Digits(double{MostPush(one, 1)}));
  add("from the front, N s", Digits(double{MostPush(one, -1)}));
  for (const int drive : {127, -127}) {
    World world(one);
    Steps(&world, 60);
    world.SetInput(0, Input{static_cast<std::int8_t>(drive), 0, 0});
    Steps(&world, 180);
    const float from = PartPose(world, Named(world, "c0.torso")).position.x();
    Steps(&world, 180);
    const float to = PartPose(world, Named(world, "c0.torso")).position.x();
    add(drive > 0 ? "runs forwards, m/s" : "backwards, m/s", Digits(double{(to - from) / 3}));
  }
  {
    World world(one);
    Steps(&world, 90);
    const PartId torso = Named(world, "c0.torso");
    const float stands = PartPose(world, torso).position.y();
    float top = stands;
    world.SetInput(0, Input{0, 127, 0});
    for (int tick = 0; tick < 120; ++tick) {
      world.Step();
      top = std::max(top, PartPose(world, torso).position.y());
      if (tick == 20) world.SetInput(0, Input{});
    }
    add("jumps: the torso rises, m", Digits(double{top - stands}));
  }
  const Scene active = ParseScene(TextOf("active", 10), "characters.toml");
  const Scene passive = ParseScene(TextOf("passive", 10), "characters.toml");
  const auto run = [](const Scene& scene) {
    World world(scene);
    for (int body = 0; body < world.body_count(); ++body) world.SetAwake(body, true);
    Steps(&world, 60);  // the limp ones have not come to rest yet
  };
  add("step, beside a limp one's while it falls",
      fmt::format("{:.2f} x",
                  CostRatio([&] { run(passive); }, [&] { run(active); }, quick ? 5 : 21)));
  table.note = "Pushes grow by 0.05 N s until one makes it fall within 4 s.";
  table.command = "seam-lab world characters";
  return table;
}

}  // namespace seam
