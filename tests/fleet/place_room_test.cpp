#include <gtest/gtest.h>

#include <vector>

#include "common/codec/messages.h"
#include "common/fleet/directory.h"

namespace seam {
namespace place_room_test {

TEST(PlaceRoom, TakesTheEmptierOfTwoOfTheSameProtocolThatAreNotDraining) {
  std::vector<FleetServer> servers;
  for (const char* id : {"a", "b", "c", "d", "e"}) {
    servers.emplace_back();
    servers.back().id = id;
    servers.back().protocol = kProtocolVersion;
    servers.back().capacity = 8;
  }
  servers[0].protocol = kProtocolVersion - 1;
  servers[1].draining = true;
  servers[2].used = servers[2].capacity;
  servers[3].used = 4;
  servers[4].used = 1;
  Random random(1);
  int emptier = 0;
  for (int i = 0; i < 400; ++i) {
    const FleetServer* const placed = PlaceRoom(servers, kProtocolVersion, "", random);
    ASSERT_NE(placed, nullptr);
    ASSERT_TRUE(placed->id == "d" || placed->id == "e") << placed->id;
    emptier += placed->id == "e" ? 1 : 0;
  }
  EXPECT_NEAR(emptier, 300, 40) << "all draws but d and d";
  EXPECT_EQ(PlaceRoom(servers, kProtocolVersion, "e", random)->id, "d");
  EXPECT_EQ(PlaceRoom(servers, 3, "", random), nullptr);
}

}  // namespace place_room_test
}  // namespace seam
