/// A holder sends states seldom where every peer comes to them by itself, and at each send tick
/// where one only displays them or rules look at them.

#include <gtest/gtest.h>

#include <string>

#include "common/sync/replica.h"

namespace seam {
namespace refresh_test {

/// Three discs that never rest.
std::string Discs(const std::string& more) {
  return more + R"(
gravity = [0, 0]
duration = 10
[solver]
sleep = false
[[player]]
name = "ann"
[[player]]
name = "bob"
[[part]]
name = "disc"
circle = 0.3
velocity = [1, 0]
repeat = {count = [3, 1], step = [9, 0]}
)";
}

const char* const kTrigger = R"(
[[trigger]]
name = "goal"
box = [1, 1]
position = [50, 0]
for = "disc.*"
)";

struct Room {
  std::string text = Discs("");
  std::string reconcile = "rollback";
  bool server_follows = true;
};

/// Holds everything as peer 1 and steps for two seconds.
class Holder {
 public:
  explicit Holder(const Room& room)
      : client_(ParseScene(room.text, "discs.toml"), MakeSyncConfig("buffer", room.reconcile), 1,
                0) {
    Grant(1, room.server_follows);
    client_.Begin();
  }
  void Grant(int epoch, bool server_follows) {
    AuthorityRecord record;
    record.authority = 1;
    record.epoch = epoch;
    if (server_follows) record.secondaries.Add(0);
    record.secondaries.Add(2);
    for (int m = 0; m < client_.authority().count(); ++m) client_.authority().Set(m, record);
    client_.RolesChanged();
  }
  /// Returns the states of a disc in so many ticks.
  double StatesIn(int ticks) {
    std::size_t told = 0;
    for (int tick = 0; tick < ticks; ++tick) {
      client_.RecordInput(1, client_.tick() + 1, Input{});
      client_.Step();
      for (const States& states : client_.TakeStates()) told += states.id.size();
    }
    return static_cast<double>(told) / 3;
  }

 private:
  Replica client_;
};

TEST(Refresh, AHolderSendsFourStatesASecondWhereAllSimulateThem) {
  EXPECT_EQ(Holder(Room()).StatesIn(120), 8);
}

TEST(Refresh, AHolderSendsAtEachSendTickWhereACopyDoesNotAgreeByItself) {
  Room room;
  room.reconcile = "fade";
  EXPECT_EQ(Holder(room).StatesIn(120), 60);
}

TEST(Refresh, AHolderSendsAtEachSendTickInALargeRoom) {
  Room room;
  room.text = Discs("follow = 2\n");
  EXPECT_EQ(Holder(room).StatesIn(120), 60) << "others may only display them";
}

TEST(Refresh, AHolderSendsAtEachSendTickToAServerThatShowsWhatItDoesNotFollow) {
  Room room;
  room.text = Discs("server_follow = 2\n");
  room.server_follows = false;
  EXPECT_EQ(Holder(room).StatesIn(120), 60);
  room.server_follows = true;
  EXPECT_EQ(Holder(room).StatesIn(120), 8);
}

TEST(Refresh, AHolderSendsAtEachSendTickWhereRulesLook) {
  Room room;
  room.text += kTrigger;
  EXPECT_EQ(Holder(room).StatesIn(120), 60);
}

TEST(Refresh, AHolderSendsAtEachSendTickWhatHasACharacter) {
  Room room;
  room.text += "[[character]]\nname = \"carl\"\nposition = [0, 20]\n";
  EXPECT_GT(Holder(room).StatesIn(120), 60 * 9 / 3) << "its bodies too, and the discs seldom";
}

TEST(Refresh, AHolderSendsAtOnceInANewEpoch) {
  Holder holder((Room()));
  holder.StatesIn(120);
  EXPECT_EQ(holder.StatesIn(2), 0);
  holder.Grant(2, true);
  EXPECT_EQ(holder.StatesIn(2), 1);
  EXPECT_EQ(holder.StatesIn(2), 0);
}

}  // namespace refresh_test
}  // namespace seam
