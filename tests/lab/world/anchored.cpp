/// Anchored parts that no scene declares as bricks, beside the same as [[bricks]].

#include <cstdio>
#include <memory>

#include "common/base/geometry.h"
#include "common/physics/world.h"
#include "common/scene/bricks.h"
#include "tests/lab/world/bench.h"

namespace seam {
namespace {

constexpr int kMovers = 40;

/// Of a wall: half a metre high, with room between its rows or without.
constexpr double kApart = 0.6, kClose = 0.5;  // m, from row to row

/// A wall of bricks under boxes and balls that never rest.
std::string Wall(int columns, int rows, double pitch) {
  char line[300];
  std::string text = "bounds = [[-3000, -1000], [3000, 1000]]\n[solver]\nsleep = false\n";
  for (int row = 0; row < rows; ++row) {
    std::snprintf(line, sizeof line,
                  "[[bricks]]\nname = \"row%d\"\nbrick = [1, 0.5]\nposition = [%d, %g]\n"
                  "count = [%d, 1]\n",
                  row, -columns / 2, -pitch * row - 0.5, columns);
    text += line;
  }
  for (int i = 0; i < kMovers; ++i) {
    std::snprintf(line, sizeof line,
                  "[[part]]\nname = \"m%d\"\n%s\nposition = [%g, 2]\nrestitution = 0.9\n"
                  "velocity = [%d, 0]\nfriction = 0.1\n",
                  i, i % 2 == 0 ? "circle = 0.4" : "box = [0.8, 0.6]",
                  columns * ((i + 0.5) / kMovers - 0.5) * 0.8, i % 5 - 2);
    text += line;
  }
  return text;
}

enum class AnchoredKind { kSingle, kWelded };

/// The bricks as parts, alone or welded in rows; all of it, gravity too, turned about the origin.
Scene AsParts(Scene scene, AnchoredKind kind, float angle) {
  scene.gravity = Turned(scene.gravity, angle);
  for (Part& part : scene.parts) {
    part.position = Turned(part.position, angle);
    part.velocity = Turned(part.velocity, angle);
    part.angle += angle;
  }
  for (const BrickField& field : scene.bricks) {
    bool first = true;
    EachBrick(field, [&](int x, int y) {
      Part part = BrickPart(field, x, y);
      part.id = static_cast<PartId>(scene.parts.size());
      part.anchored = kind != AnchoredKind::kWelded || first;
      part.position = Turned(part.position, angle);
      part.angle = angle;
      if (kind == AnchoredKind::kWelded && !first) {
        Joint weld;
        weld.name = part.name;
        weld.kind = JointKind::kWeld;
        weld.a = part.id - 1;
        weld.b = part.id;
        weld.anchor_a = weld.anchor_b = part.position;
        scene.joints.push_back(weld);
      }
      first = false;
      scene.parts.push_back(std::move(part));
      return true;
    });
  }
  scene.bricks = {};
  return scene;
}

}  // namespace

TextTable AnchoredBench(bool quick) {
  const int columns = quick ? 60 : 130, rows = quick ? 10 : 30;
  const int pairs = quick ? 3 : 9, ticks = quick ? 10 : 60;
  TextTable table;
  table.name = "world-anchored";
  table.title = std::to_string(columns * rows) + " anchored parts beside as many bricks";
  table.header = {"", "build", "a tick", "a barrier", "build and a second"};
  struct Row {
    const char* name;
    AnchoredKind kind;
    float angle;  // rad
    double pitch = kApart;
  };
  for (const Row& row :
       {Row{"single parts", AnchoredKind::kSingle, 0},
        Row{"turned by 0.02", AnchoredKind::kSingle, 0.02f},
        Row{"turned by 0.8", AnchoredKind::kSingle, 0.8f},
        Row{"welded in rows", AnchoredKind::kWelded, 0},
        Row{"welded, turned by 0.3", AnchoredKind::kWelded, 0.3f},
        Row{"welded, turned by 0.8", AnchoredKind::kWelded, 0.8f},
        Row{"single, no room, turned by 0.3", AnchoredKind::kSingle, 0.3f, kClose},
        Row{"single, no room, turned by 0.8", AnchoredKind::kSingle, 0.8f, kClose}}) {
    const Scene bricks = ParseScene(Wall(columns, rows, row.pitch), "wall.toml");
    const Scene parts = AsParts(bricks, row.kind, row.angle);
    const auto build = [](const Scene& scene) { return [&scene] { World world(scene); }; };
    World of_bricks(bricks), of_parts(parts);
    const auto step = [ticks](World* world) {
      return [world, ticks] {
        for (int i = 0; i < ticks; ++i) world->Step();
      };
    };
    const auto whole = [](const Scene& scene) {
      return [&scene] {
        World world(scene);
        for (int i = 0; i < 60; ++i) world.Step();
      };
    };
    const auto barrier = [](World* world) { return [world] { world->Barrier(); }; };
    table.rows.push_back({row.name, Digits(CostRatio(build(bricks), build(parts), pairs)),
                          Digits(CostRatio(step(&of_bricks), step(&of_parts), pairs)),
                          Digits(CostRatio(barrier(&of_bricks), barrier(&of_parts), pairs)),
                          Digits(CostRatio(whole(bricks), whole(parts), pairs))});
  }
  table.note =
      "CPU time as a multiple of what the same costs with [[bricks]], in turns. The world is built "
      "from a scene that has been read; forty boxes and balls bounce on it.";
  table.command = "build/release/seam-lab world anchored";
  return table;
}

}  // namespace seam
