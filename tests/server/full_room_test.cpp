/// A room at its limit: spectators never take the players' places.

#include <gtest/gtest.h>

#include "common/base/entropy.h"
#include "common/scene/scene.h"
#include "server/sessions/place_table.h"

namespace seam {
namespace full_room_test {

class Counting : public Entropy {
 public:
  std::uint64_t Next() override { return ++number_; }

 private:
  std::uint64_t number_ = 0;
};

TEST(FullRoom, AdmitsAllPlayersAfterSpectatorsFilledTheirPlaces) {
  const Scene scene =
      ParseScene("[[player]]\nname = \"p\"\nrepeat = {count = " + std::to_string(kPlayersMax) +
                     "}\n[[part]]\nname = \"ball\"\ncircle = 1\n",
                 "full.toml");
  Counting entropy;
  PlaceTable places(scene, entropy);
  std::uint64_t session = 0;
  const auto claim = [&](const std::string& name) {
    const PlaceTable::Answer answer = places.Claim(0, name, 0, ++session);
    if (answer.peer > 0) places.Enter(answer.peer, 0);
    return answer;
  };
  const int spectators = kPeersMax - 1 - kPlayersMax;
  for (int n = 0; n < spectators; ++n) {
    ASSERT_GT(claim("guest" + std::to_string(n)).peer, kPlayersMax);
  }
  EXPECT_EQ(claim("one-more").refusal, "the room is full");
  for (int p = 0; p < kPlayersMax; ++p) {
    const PlaceTable::Answer answer = claim("p-" + std::to_string(p));
    ASSERT_EQ(answer.peer, p + 1) << answer.refusal;
    EXPECT_EQ(places.at(answer.peer).player, p);
  }
  EXPECT_EQ(places.FreeNames(0), "no player is free");
}

}  // namespace full_room_test
}  // namespace seam
