/// Cost of a client's tick for a body without relevance to it.

#include <algorithm>
#include <cstdio>
#include <memory>

#include "common/sync/replica.h"
#include "tests/lab/world/bench.h"

namespace seam {
namespace {

constexpr int kFew = 100;

/// A client that has one of two boxes that touch; the others are far, the server's, and creep.
std::unique_ptr<Replica> RoomOf(int far) {
  char text[600];
  std::snprintf(text, sizeof text,
                "bounds = [[-1000, -1000], [4000, 4000]]\n"
                "[[player]]\nname = \"ann\"\nvehicle = \"own\"\n"
                "[[part]]\nname = \"ground\"\nchain = [[-50, 0], [2000, 0]]\n"
                "[[part]]\nname = \"own\"\nbox = [1, 1]\nposition = [0, 0.5]\n"
                "[[part]]\nname = \"beside\"\nbox = [1, 1]\nposition = [1.1, 0.5]\n"
                "[[part]]\nname = \"far\"\nbox = [1, 1]\nposition = [300, 300]\n"
                "velocity = [0.1, 0]\nrepeat = {count = [100, %d], step = [3, 3]}\n",
                far / 100);
  SyncConfig config = MakeSyncConfig("buffer", "rollback");
  config.shows_far = false;
  config.smooth_rate = 0;
  auto replica = std::make_unique<Replica>(ParseScene(text, "room.toml"), config, 1, 0);
  AuthorityRecord own;
  own.authority = 1;
  own.epoch = 1;
  replica->authority().Set(0, own);
  replica->RolesChanged();
  for (int tick = 0; tick < 60; ++tick) replica->Step();
  return replica;
}

/// CPU microseconds of a tick.
double TickUs(Replica* replica, int ticks) {
  const double began = CpuSeconds();
  for (int i = 0; i < ticks; ++i) replica->Step();
  return 1e6 * (CpuSeconds() - began) / ticks;
}

/// By turns with a room of few.
struct FarCost {
  FarCost(int far, int ticks, int pairs) {
    const std::unique_ptr<Replica> few = RoomOf(kFew), many = RoomOf(far);
    for (int pair = 0; pair < pairs; ++pair) {
      const double base = TickUs(few.get(), ticks);
      tick_us.push_back(TickUs(many.get(), ticks));
      body_ns.push_back(1e3 * (tick_us.back() - base) / (far - kFew));
    }
    std::sort(tick_us.begin(), tick_us.end());
    std::sort(body_ns.begin(), body_ns.end());
  }
  std::vector<double> tick_us, body_ns;  // ascending
};

}  // namespace

double FarBodyNs(int far, int ticks, int pairs) {
  const FarCost cost(far, ticks, pairs);
  return cost.body_ns[cost.body_ns.size() / 2];
}

TextTable ClientTickBench(bool quick) {
  const int ticks = quick ? 120 : 600, pairs = quick ? 3 : 9;
  TextTable table;
  table.name = "world-client-tick";
  table.title = "A client's tick beside bodies without relevance to it";
  table.header = {"far bodies", "us a tick", "ns a far body"};
  for (const int far : {1000, 10000, 60000}) {
    if (quick && far > 1000) break;
    const FarCost cost(far, ticks, pairs);
    table.rows.push_back({std::to_string(far), Digits(cost.tick_us[cost.tick_us.size() / 2]),
                          Digits(cost.body_ns[cost.body_ns.size() / 2])});
  }
  table.note =
      "CPU time of a client that simulates one box and displays another that it touches; the "
      "others "
      "are 300 m away and farther, and nobody looks at them. The last column is the difference to "
      "the same with 100 of them, in turns, by body.";
  table.command = "build/release/seam-lab world client-tick";
  return table;
}

}  // namespace seam
