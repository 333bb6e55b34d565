/// What grouping and sleep save where things lie about, and what they change.

#include <algorithm>
#include <memory>
#include <string>

#include "common/physics/part_places.h"
#include "common/physics/world.h"
#include "tests/lab/world/bench.h"

namespace seam {
namespace {

struct Rule {
  const char* name;
  bool sleep, groups;
};
constexpr Rule kRules[] = {{"neither", false, false},
                           {"sleep", true, false},
                           {"grouping", false, true},
                           {"sleep and grouping", true, true}};

/// Stacks of four crates; one is hit by a ball after four seconds.
std::unique_ptr<World> Yard(const Rule& rule, bool ball, bool quick) {
  const std::string stacks = quick ? "10" : "60";
  const std::string text =
      std::string("[solver]\nskin = 0.0025\nsubsteps = 2\nsleep = ") +
      (rule.sleep ? "true" : "false") + "\n" + (rule.groups ? "[grouping]\nafter = 1\n" : "") +
      "[[part]]\nname = \"ground\"\nchain = [[-300, 0], [300, 0]]\n"
      "[[part]]\nname = \"crate\"\nbox = [1, 1]\nposition = [0, 0.5]\nrepeat = {count = [" +
      stacks + ", 4], step = [3, 1]}\n" +
      (ball ? "[[part]]\nname = \"ball\"\ncircle = 0.4\nposition = [-34, 2.4]\ndensity = 3\n"
              "velocity = [8.35, 20]\n"
            : "");
  return std::make_unique<World>(ParseScene(text, "yard.toml"));
}

void Live(World* world, int ticks) {
  for (int i = 0; i < ticks; ++i) {
    world->Step();
    const std::vector<Edit> edits = world->ProposeEdits();
    if (!edits.empty()) world->Apply(edits);
  }
}

/// Most that a crate is elsewhere than in the other world, m.
double Apart(const World& one, const World& other) {
  double most = 0;
  for (std::size_t p = 1; p < one.scene().parts.size(); ++p) {
    const auto part = static_cast<PartId>(p);
    const Vec2 apart = PartPose(one, part).position - PartPose(other, part).position;
    most = std::max(most, static_cast<double>(apart.norm()));
  }
  return most;
}

}  // namespace

TextTable GroupingBench(bool quick) {
  TextTable table;
  table.name = "world-grouping";
  table.title = "Resting things as one body";
  table.header = {"rule",
                  "bodies at rest",
                  "cost at rest",
                  "error at rest, m",
                  "error after a hit, m",
                  "edits of the hit"};
  for (const Rule& rule : kRules) {
    const auto base = Yard(kRules[0], false, quick), yard = Yard(rule, false, quick);
    Live(base.get(), 180);
    Live(yard.get(), 180);
    const std::string bodies = std::to_string(yard->body_count());
    const std::string error = Digits(Apart(*yard, *base));
    const auto run = [quick](World* world) {
      return [world, quick] { Live(world, quick ? 20 : 120); };
    };
    const double cost = CostRatio(run(base.get()), run(yard.get()), quick ? 3 : 9);
    const auto struck_base = Yard(kRules[0], true, quick), struck = Yard(rule, true, quick);
    Live(struck_base.get(), 200);
    Live(struck.get(), 200);
    const int edits = struck->topology().revision();
    Live(struck_base.get(), 160);
    Live(struck.get(), 160);
    table.rows.push_back({rule.name, bodies, Digits(cost), error,
                          Digits(Apart(*struck, *struck_base)),
                          std::to_string(struck->topology().revision() - edits)});
  }
  table.note =
      "60 stacks of four crates, at rest after 3 s; cost of a tick beside the first row's world in "
      "the same run. Error: of the crate that is farthest from where it is with neither. Then a "
      "ball hits one stack at 4 s; its group is undone before the blow. What a blow does is "
      "chaotic: sleep alone, which changes only the last bits, makes centimetres, too.";
  table.command = "build/release/seam-lab world grouping";
  return table;
}

}  // namespace seam
