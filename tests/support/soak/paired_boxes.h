#pragma once
/// Boxes in pairs that are bonded and broken again, for rooms with a long edit history.

#include "client/embed/cluster.h"
#include "common/physics/part_places.h"

namespace seam {

/// Returns the scene text of the boxes, two by two, so far away that no player is near.
inline const char* const kPairedBoxes = R"(
[[part]]
name = "box"
box = [0.5, 0.5]
position = [-15, 20]
repeat = {count = [8, 2], step = [1.5, 0.6]}
)";
constexpr int kPairCount = 8;

/// Bonds every pair and breaks it again as soon as that is done, `cycles` times. `first`: the id of
/// the first box.
inline void BondAndBreak(Cluster* cluster, PartId first, int cycles) {
  Server& server = cluster->server();
  const World& world = server.replica().world();
  // An edit waits for the inputs of its tick: at most a second.
  const auto run_until = [&](int edits) {
    const std::int64_t last = server.tick() + 120;
    while (server.replica().revision() < edits && server.tick() < last) {
      cluster->RunToTick(server.tick() + 1);
    }
  };
  for (int i = 0; i < cycles; ++i) {
    for (int pair = 0; pair < kPairCount; ++pair) {
      const PartId a = first + 2 * pair;
      server.Order(Edit(BondAsTheyAre(world, a, a + 1, 0), EditCause::kOutside));
    }
    run_until(server.replica().revision() + kPairCount);
    const std::vector<Joint>& joints = world.scene().joints;
    for (std::size_t j = 0; j < joints.size(); ++j) {
      if (joints[j].gone) continue;
      server.Order(Edit(BreakEdit{static_cast<std::int32_t>(j)}, EditCause::kOutside));
    }
    run_until(server.replica().revision() + kPairCount);
  }
}

}  // namespace seam
