/// How far joints come apart under load: a light link between an anchored post and a load.
///
///   post (anchored) --joint-- link, 1 kg --joint-- load, 1 .. 100 kg, which swings and falls

#include <fmt/format.h>

#include <algorithm>

#include "common/measure/joint_drift.h"
#include "common/physics/world.h"
#include "tests/lab/world/bench.h"

namespace seam {
namespace {

struct JointCase {
  const char* name;
  const char* first;  // TOML of the two joints but name, a and b
  const char* second;
};

const JointCase kKinds[] = {
    {"hinge", "kind = \"hinge\"\nanchor = [0, 9.5]", "kind = \"hinge\"\nanchor = [1, 9.5]"},
    {"weld joint", "kind = \"weld\"\nanchor = [0, 9.5]", "kind = \"weld\"\nanchor = [1, 9.5]"},
    {"prismatic", "kind = \"prismatic\"\nanchor = [0, 9.5]\naxis = [1, 1]\nlimits = [-1, 1]",
     "kind = \"prismatic\"\nanchor = [1, 9.5]\naxis = [1, -1]\nlimits = [-1, 1]"},
    {"wheel, no spring", "kind = \"wheel\"\nanchor = [0, 9.5]",
     "kind = \"wheel\"\nanchor = [1, 9.5]"},
    {"rod", "kind = \"distance\"\nanchor_a = [0, 10]\nanchor_b = [0.5, 9.5]",
     "kind = \"distance\"\nanchor_a = [0.5, 9.5]\nanchor_b = [1.5, 9.5]"},
    {"rope", "kind = \"rope\"\nanchor_a = [0, 10]\nanchor_b = [0.5, 9.5]",
     "kind = \"rope\"\nanchor_a = [0.5, 9.5]\nanchor_b = [1.5, 9.5]"}};

std::string TextOf(const JointCase& kind, int load, int substeps) {
  const std::string welds = std::string(kind.name) == "weld joint" ? "welds = \"joint\"\n" : "";
  return "[solver]\nsleep = false\n" + welds + fmt::format("substeps = {}\n", substeps) +
         "[[part]]\nname = \"post\"\nbox = [0.5, 0.5]\nposition = [0, 10]\nanchored = true\n"
         "[[part]]\nname = \"link\"\nbox = [1, 1]\nposition = [0.5, 9.5]\ngroup = -1\n" +
         fmt::format(
             "[[part]]\nname = \"load\"\nbox = [1, 1]\nposition = [1.5, 9.5]\n"
             "group = -1\ndensity = {}\n",
             load) +
         "[[joint]]\nname = \"first\"\na = \"post\"\nb = \"link\"\n" + kind.first +
         "\n[[joint]]\nname = \"second\"\na = \"link\"\nb = \"load\"\n" + kind.second + "\n";
}

/// m; the most in 4 s.
double DriftOf(const Scene& scene) {
  World world(scene);
  const JointMeter meter(world.scene(), world.composition());
  double worst = 0;
  for (int tick = 0; tick < 4 * scene.solver.tick_hz; ++tick) {
    world.Step();
    std::vector<BodyState> states;
    for (int body = 0; body < world.body_count(); ++body) states.push_back(world.Read(body));
    worst = std::max(worst, meter.Worst(states, world.tick()));
  }
  return worst;
}

void Run(const Scene& scene, int ticks) {
  World world(scene);
  for (int tick = 0; tick < ticks; ++tick) world.Step();
}

}  // namespace

TextTable JointsBench(bool quick) {
  TextTable table;
  table.name = "world-joints";
  table.title = "Joint drift under load, m";
  table.header = {"joint",
                  "load 1x",
                  "10x",
                  "100x",
                  "1x, 4 substeps",
                  "10x, 4 substeps",
                  "100x, 4 substeps",
                  "cost of 4 substeps"};
  for (const JointCase& kind : kKinds) {
    std::vector<std::string> row = {kind.name};
    for (const int substeps : {1, 4}) {
      for (const int load : {1, 10, 100}) {
        row.push_back(Digits(DriftOf(ParseScene(TextOf(kind, load, substeps), "joints.toml"))));
      }
    }
    const Scene stock = ParseScene(TextOf(kind, 10, 1), "joints.toml");
    const Scene fine = ParseScene(TextOf(kind, 10, 4), "joints.toml");
    const int ticks = quick ? 2000 : 10000;
    row.push_back(fmt::format("{:.2f} x", CostRatio([&] { Run(stock, ticks); },
                                                    [&] { Run(fine, ticks); }, quick ? 3 : 7)));
    table.rows.push_back(row);
  }
  table.note =
      "A link of 1 kg between an anchored post and a load that swings from the side; the worst of "
      "both joints in 4 s. 8/3 iterations a step at 60 Hz.";
  table.command = "seam-lab world joints";
  return table;
}

}  // namespace seam
