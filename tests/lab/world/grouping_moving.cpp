/// What grouping saves where things lie still against each other and all of it moves.

#include <algorithm>

#include "common/base/find_scene.h"
#include "common/physics/part_places.h"
#include "common/physics/world.h"
#include "common/scene/grouping.h"
#include "tests/lab/world/bench.h"

namespace seam {
namespace {

/// scenes/freight.toml while it rolls, its player pressing on; or its crates on a hull at sea.
struct Carrier {
  const char* name;
  const char* scene;  // "": the ship
};
constexpr Carrier kCarriers[] = {{"rolling cart", "freight"}, {"floating ship", ""}};

std::string Ship(bool quick) {
  std::string text =
      "[solver]\nskin = 0.0025\nsubsteps = 2\n[grouping]\nafter = 1\n"
      "[[water]]\nname = \"sea\"\nbox = [400, 50]\nposition = [0, -25]\n"
      "[[part]]\nname = \"hull\"\npolygon = [[-5, 0.8], [-4.4, -1.2], [4.4, -1.2], [5, 0.8]]\n"
      "position = [0, 0.3]\ndensity = 0.5\nfriction = 0.9\nvelocity = [2, 0]\n";
  for (int row = 0; row < (quick ? 2 : 5); ++row) {
    const int count = 14 - row;
    text += "[[part]]\nname = \"row-" + std::to_string(row) + "\"\nbox = [0.6, 0.6]\nposition = [" +
            std::to_string(-0.3 * (count - 1)) + ", " + std::to_string(1.4 + 0.6 * row) +
            "]\ndensity = 0.2\nfriction = 0.8\nvelocity = [2, 0]\nrepeat = {count = " +
            std::to_string(count) + ", step = [0.6, 0]}\n";
  }
  return text;
}

void PlayAndApply(World* world, int ticks) {
  for (int i = 0; i < ticks; ++i) {
    for (std::size_t p = 0; p < world->scene().players.size(); ++p) {
      world->SetInput(static_cast<int>(p), world->scene().players[p].script.front().input);
    }
    world->Step();
    const std::vector<Edit> edits = world->ProposeEdits();
    if (!edits.empty()) world->Apply(edits);
  }
}

double LargestDistance(const World& one, const World& other) {
  double most = 0;
  for (const Part& part : one.scene().parts) {
    const Vec2 apart = PartPose(one, part.id).position - PartPose(other, part.id).position;
    most = std::max(most, static_cast<double>(apart.norm()));
  }
  return most;
}

}  // namespace

TextTable GroupingMovingBench(bool quick) {
  TextTable table;
  table.name = "world-grouping-moving";
  table.title = "Cargo as one body";
  table.header = {"cargo on a", "bodies single", "bodies grouped", "cost grouped", "apart, m"};
  for (const Carrier& carrier : kCarriers) {
    const bool ship = carrier.scene[0] == '\0';
    const Scene scene =
        ship ? ParseScene(Ship(quick), "ship.toml") : LoadScene(FindScene(carrier.scene));
    Scene ungrouped = scene;
    ungrouped.grouping.Set(Grouping{});
    World grouped(scene), single(ungrouped);
    PlayAndApply(&grouped, 100);
    PlayAndApply(&single, 100);
    const std::string bodies = std::to_string(single.body_count());
    const std::string left = std::to_string(grouped.body_count());
    const int ticks = quick ? 10 : 20;
    const double cost = CostRatio([&] { PlayAndApply(&single, ticks); },
                                  [&] { PlayAndApply(&grouped, ticks); }, quick ? 3 : 9);
    table.rows.push_back(
        {carrier.name, bodies, left, Digits(cost), Digits(LargestDistance(grouped, single))});
  }
  table.note =
      "Sixty crates in a pile; the cart is scenes/freight.toml, which rolls at 6 m/s, the ship a "
      "hull "
      "that floats. After 1.7 s both take turns, once with single crates and once grouped: the "
      "cost "
      "of a tick of the grouped world beside the other's, and how far the crate is from its double "
      "that is farthest from it, in the end.";
  table.command = "build/release/seam-lab world grouping-moving";
  return table;
}

}  // namespace seam
