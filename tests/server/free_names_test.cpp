/// The refusal of a client lists the free names, as many as fit a message.

#include <gtest/gtest.h>

#include "common/codec/codec.h"
#include "server/sessions/place_table.h"

namespace seam {
namespace free_names_test {

Scene SceneOf(const std::vector<std::string>& players) {
  std::string text = "[[part]]\nname = \"ball\"\ncircle = 0.5\n";
  for (const std::string& name : players) text += "[[player]]\nname = \"" + name + "\"\n";
  return ParseScene(text, "test.toml");
}

TEST(FreeNames, ListPlayersWithAFreePlace) {
  const Scene scene = SceneOf({"ann", "bob"});
  SeededEntropy entropy(1);
  PlaceTable places(scene, entropy);
  EXPECT_EQ(places.FreeNames(0), "free are ann, bob");
  const auto enter = [&](const char* name, std::uint64_t session) {
    const int peer = places.Claim(1000, name, 0, session).peer;
    places.Enter(peer, 1000);
    places.Heard(peer, 1000, true);
    return peer;
  };
  const int bob = enter("bob", 1);
  enter("guest", 2);
  EXPECT_EQ(places.FreeNames(1000), "free are ann");
  EXPECT_EQ(places.Claim(2000, "bob", 0, 3).refusal, "the name bob is in use; free are ann");
  enter("ann", 4);
  EXPECT_EQ(places.FreeNames(1000), "no player is free");
  places.Leave(bob, 1, false);
  EXPECT_EQ(places.FreeNames(PlaceTable::kNameHeldUs), "no player is free") << "held for him";
  EXPECT_EQ(places.FreeNames(1000 + PlaceTable::kNameHeldUs), "free are ann, bob");
}

TEST(FreeNames, AreCountedIfTheyDoNotFitAMessage) {
  std::vector<std::string> names;
  for (int i = 10; i < 40; ++i) names.push_back("a-player-with-a-long-name-" + std::to_string(i));
  const Scene scene = SceneOf(names);
  SeededEntropy entropy(1);
  const PlaceTable places(scene, entropy);
  const std::string free = places.FreeNames(0);
  EXPECT_EQ(free, "free are " + names[0] + ", " + names[1] + ", " + names[2] + " and 27 more");
  Bye bye;
  bye.reason = "the name " + names[0] + " is in use; " + free;
  EXPECT_TRUE(std::holds_alternative<Bye>(Decode(Encode(bye)))) << bye.reason.size() << " bytes";
}

}  // namespace free_names_test
}  // namespace seam
