/// A mechanism with more followers than one message lists: a crowd of a very large room.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/codec/codec.h"
#include "common/scene/scene.h"
#include "common/sync/authority.h"
#include "common/sync/table/body_table.h"

namespace seam {
namespace many_followers_test {

AuthorityRecord FollowedBy(int first, int last) {
  AuthorityRecord record;
  record.authority = 7;
  record.epoch = 3;
  for (int peer = first; peer <= last; ++peer) record.secondaries.Add(peer);
  return record;
}

TEST(ManyFollowers, TheLowestAreListedAndTheMessageFitsADatagram) {
  for (const int last : {static_cast<int>(kGrantFollowersMax) - 1, kPlayersMax}) {
    Grants grants;
    AddRecord(5, FollowedBy(0, last), &grants);
    ASSERT_EQ(grants.follower.size(), kGrantFollowersMax) << last;
    for (std::size_t i = 0; i < grants.follower.size(); ++i) {
      EXPECT_EQ(grants.follower[i], static_cast<int>(i)) << "ascending, the server first";
    }
    EXPECT_EQ(grants.followers.front(), static_cast<int>(kGrantFollowersMax));
    const Bytes bytes = Encode(grants);
    EXPECT_LE(bytes.size(), kMessageBytesMax);
    const AnyMessage any = Decode(bytes);
    ASSERT_TRUE(std::holds_alternative<Grants>(any)) << last;
    EXPECT_EQ(std::get<Grants>(any).follower, grants.follower);
  }
}

TEST(ManyFollowers, EachMechanismOfACrowdHasAMessageOfItsOwn) {
  const Scene scene = ParseScene(
      "[[part]]\nname = \"ball\"\ncircle = 1\nrepeat = {count = 5, step = [3, 0]}\n", "balls.toml");
  const Topology topology(scene);
  const BodyTable bodies(5, 5);
  AuthorityTable table(topology.composition(), bodies);
  std::vector<int> all;
  for (int m = 0; m < table.count(); ++m) {
    table.Set(m, FollowedBy(1, m % 2 == 0 ? kPlayersMax : 2));
    all.push_back(m);
  }
  ASSERT_EQ(table.count(), 5);
  std::size_t mechanisms = 0;
  for (const Grants& grants : table.Export(1, 2, all)) {
    EXPECT_LE(Encode(grants).size(), kMessageBytesMax);
    mechanisms += grants.mechanism.size();
  }
  EXPECT_EQ(mechanisms, 5u);
}

}  // namespace many_followers_test
}  // namespace seam
