#include <algorithm>
#include <ctime>

#include "server/authority/plan.h"
#include "tests/lab/report/text_table.h"
#include "tests/lab/world/bench.h"
#include "tests/lab/world/plan_worlds.h"

namespace seam {
namespace {

struct Case {
  const char* name;
  int players;
  float width, height;  // m
  bool regions;
};

/// Everything that moves, as it is held after some plans.
AuthorityView Settled(const Case& of, int mechanisms) {
  PlanWorld world;
  world.players = of.players;
  world.mechanisms = mechanisms;
  world.width = of.width;
  world.height = of.height;
  world.regions = of.regions;
  world.speed = 4;
  world.fast = 0;
  world.chains = false;
  world.one_way_s = 0.05f;
  AuthorityView view = RandomView(world, 1);
  for (int plan = 0; plan < 3; ++plan) {
    for (MechanismView& mechanism : view.mechanisms) mechanism.held_ticks = 1000;
    const AuthorityPlan planned = PlanAuthority(view);
    for (std::size_t m = 0; m < planned.size(); ++m) {
      view.mechanisms[m].now.authority = planned[m].authority;
      view.mechanisms[m].now.secondaries = planned[m].secondaries;
    }
  }
  return view;
}

double PlanMs(const AuthorityView& view, int repeats) {
  std::vector<double> all;
  for (int i = 0; i < repeats; ++i) {
    const double began = CpuSeconds();
    PlanAuthority(view);
    all.push_back(1e3 * (CpuSeconds() - began));
  }
  std::sort(all.begin(), all.end());
  return all[all.size() / 2];
}

}  // namespace

double PlanMs(int players, int mechanisms, float width, float height, int repeats) {
  return PlanMs(Settled(Case{"", players, width, height, false}, mechanisms), repeats);
}

TextTable PlannerBench(bool quick) {
  const int repeats = quick ? 5 : 51;
  TextTable table;
  table.name = "world-planner";
  table.title = "A plan of who has authority and who follows, 1000 bodies and vehicles that move";
  table.header = {"room", "players", "bodies", "ms a plan"};
  for (const Case& of :
       {Case{"players 30 m apart in a row", 256, 7680, 20, false},
        Case{"seen from above, 1500 m wide", 256, 1500, 1500, false},
        Case{"seen from above, 500 m wide", 256, 500, 500, false},
        Case{"crowded: 100 m wide", 256, 100, 20, false}, Case{"200 m wide", 31, 200, 40, false},
        Case{"200 m wide, by regions", 31, 200, 40, true}}) {
    const AuthorityView view = Settled(of, 1000);
    table.rows.push_back({of.name, std::to_string(view.players.size()),
                          std::to_string(view.boxes.size()), Digits(PlanMs(view, repeats))});
  }
  table.note =
      "CPU time of the median plan; plans come ten times a second. Vehicles have three bodies.";
  table.command = "build/release/seam-lab world planner";
  return table;
}

}  // namespace seam
