/// A ship of a thousand parts, as one body and as a thousand.

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "common/base/geometry.h"
#include "common/physics/faces.h"
#include "common/physics/part_places.h"
#include "common/physics/world.h"
#include "tests/lab/world/bench.h"

namespace seam {
namespace {

struct Build {
  const char* name;
  const char* solver;
};
constexpr Build kBuilds[] = {{"one body, merged rectangles", "faces = \"merged\"\n"},
                             {"one body, outer shell", "faces = \"outer\"\n"},
                             {"one body, all fixtures", "faces = \"all\"\n"},
                             {"1000 bodies, welds as joints", "welds = \"joint\"\n"}};

/// 50 x 20 boxes of half a metre; welded, or glued so that nothing breaks it.
std::unique_ptr<World> Ship(const Build& build, bool flying, bool quick, const char* bond) {
  const int columns = quick ? 20 : 50, rows = quick ? 10 : 20;
  std::string text =
      std::string(flying ? "gravity = [0, 0]\n" : "") + "[solver]\nsleep = false\n" + build.solver +
      "[[part]]\nname = \"ground\"\nchain = [[-100, 0], [100, 0]]\n"
      "[[part]]\nname = \"cell\"\nbox = [0.5, 0.5]\nposition = [0, " +
      (flying ? "20" : "0.265") + "]\ngroup = -1\n" + (flying ? "velocity = [3, 0]\n" : "") +
      "repeat = {count = [" + std::to_string(columns) + ", " + std::to_string(rows) +
      "], step = [0.5, 0.5], " + bond + "}\n";
  return std::make_unique<World>(ParseScene(text, "ship.toml"));
}

std::size_t Fixtures(const World& world) {
  std::size_t count = 0;
  for (const Assembly& assembly : world.composition().assemblies) {
    if (!assembly.anchored) count += FacesOf(world.scene(), assembly).size();
  }
  return count;
}

/// By how much parts are not where the ship as one rigid thing would have them, as its corners
/// say, m: the most of all parts.
double Bend(const World& world) {
  const auto& parts = world.scene().parts;
  const BodyState first = PartPose(world, 1);
  const BodyState last = PartPose(world, static_cast<PartId>(parts.size()) - 1);
  const Vec2 built = parts.back().position - parts[1].position;
  const Vec2 found = last.position - first.position;
  const double turn = std::atan2(static_cast<double>(found.y()), static_cast<double>(found.x())) -
                      std::atan2(static_cast<double>(built.y()), static_cast<double>(built.x()));
  const Rotation<double> rotation(turn);
  double most = 0;
  for (std::size_t p = 1; p < parts.size(); ++p) {
    const Eigen::Vector2d at = (parts[p].position - parts[1].position).cast<double>();
    const Vec2 now = PartPose(world, static_cast<PartId>(p)).position - first.position;
    most = std::max(most, (now.cast<double>() - rotation(at)).norm());
  }
  return most;
}

}  // namespace

TextTable AssemblyBench(bool quick) {
  TextTable table;
  table.name = "world-assembly";
  table.title = "A ship of a thousand parts";
  table.header = {"made of",     "shapes",          "cost at rest",
                  "cost flying", "bend at rest, m", "bend flying, m"};
  const int ticks = quick ? 10 : 60, pairs = quick ? 3 : 7;
  const auto run = [ticks](World* world) {
    return [world, ticks] {
      for (int i = 0; i < ticks; ++i) world->Step();
    };
  };
  const auto add = [&](const Build& build, const char* bond, const std::string& name) {
    std::vector<std::string> costs, bends;
    std::size_t fixtures = 0;
    for (const bool flying : {false, true}) {
      const auto base = Ship(kBuilds[0], flying, quick, "weld = true");
      const auto ship = Ship(build, flying, quick, bond);
      for (int i = 0; i < (quick ? 30 : 300); ++i) {
        base->Step();
        ship->Step();
      }
      bends.push_back(Digits(Bend(*ship)));
      costs.push_back(Digits(CostRatio(run(base.get()), run(ship.get()), pairs)));
      fixtures = Fixtures(*ship);
    }
    table.rows.push_back({name, std::to_string(fixtures), costs[0], costs[1], bends[0], bends[1]});
  };
  for (const Build& build : kBuilds) add(build, "weld = true", build.name);
  add(kBuilds[0], "glue = 1e6", "one body, merged rectangles, glued");
  table.note =
      "50 x 20 boxes, 1930 bonds, on the ground and flying; parts do not collide with each other. "
      "Cost of a tick beside the first row's ship in the same run (median of pairs of runs). Bend: "
      "how far the worst part is, after 5 s, from where its place in a rigid ship is. The joints' "
      "own cost is what makes the thousand bodies dear, and they bend, too. Glue that is far from "
      "breaking costs a look at the sum of forces.";
  table.command = "build/release/seam-lab world assembly";
  return table;
}

}  // namespace seam
