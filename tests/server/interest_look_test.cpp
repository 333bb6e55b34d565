/// Which bodies are near which peer, in a room too large for all to be close to everyone.

#include <gtest/gtest.h>

#include <string>

#include "common/scene/scene.h"
#include "server/interest/interest.h"

namespace seam {
namespace interest_look_test {

constexpr int kAnn = 1, kWatcher = 2;

/// Discs at these places along a line, each a mechanism of its own.
std::string Discs(const std::vector<float>& places, int follow) {
  std::string text = "gravity = [0, 0]\nfollow = " + std::to_string(follow) + "\n[[player]]\n" +
                     "name = \"ann\"\n";
  for (std::size_t i = 0; i < places.size(); ++i) {
    text += "[[part]]\nname = \"disc" + std::to_string(i) + "\"\ncircle = 0.4\nposition = [" +
            std::to_string(places[i]) + ", 0]\n";
  }
  return text;
}

class InterestLook : public ::testing::Test {
 protected:
  void Begin(const std::vector<float>& places, int follow = 0) {
    scene_ = ParseScene(Discs(places, follow), "discs");
    config_ = MakeSyncConfig("buffer", "");
    replica_ = std::make_unique<Replica>(scene_, config_, 0, -1);
    interest_ = std::make_unique<Interest>(scene_, config_, *replica_);
  }
  void GiveAnn(int mechanism) {
    AuthorityRecord record = replica_->authority().at(mechanism);
    record.authority = kAnn;
    replica_->authority().Set(mechanism, record);
  }
  std::vector<Interest::Risen> Look() { return interest_->Look({{kAnn, 0}, {kWatcher, -1}}); }

  Scene scene_;
  SyncConfig config_;
  std::unique_ptr<Replica> replica_;
  std::unique_ptr<Interest> interest_;
};

TEST_F(InterestLook, EverythingIsCloseToEveryoneInASmallRoom) {
  Begin({0, 500}, 2);
  GiveAnn(0);
  EXPECT_TRUE(Look().empty());
  EXPECT_EQ(interest_->Of(kAnn, 1), Relevance::kClose);
}

TEST_F(InterestLook, ABodyWithinReachOfAnyHeldBodyIsNear) {
  // Ann holds a row of discs, one in each cell; another disc is just within reach of each end.
  const float reach = Interest::kNearReach;
  std::vector<float> places;
  for (int i = 0; i < 6; ++i) places.push_back(reach * (static_cast<float>(i) + 0.5f));
  places.push_back(places[0] - 0.99f * reach);
  places.push_back(places[5] + 0.99f * reach);
  places.push_back(places[5] + 4 * reach);
  Begin(places);
  for (int i = 0; i < 6; ++i) GiveAnn(i);
  Look();
  for (int i = 0; i < 8; ++i) EXPECT_EQ(interest_->Of(kAnn, i), Relevance::kNear) << i;
  EXPECT_EQ(interest_->Of(kAnn, 8), Relevance::kFar);
  EXPECT_EQ(interest_->Of(kWatcher, 8), Relevance::kNear) << "who only watches is near all";
}

TEST_F(InterestLook, ReportsAnApproachingBodyOnce) {
  Begin({0, 10, 80, 50});
  GiveAnn(0);
  Look();
  EXPECT_EQ(interest_->Of(kAnn, 2), Relevance::kFar);
  EXPECT_TRUE(Look().empty());
  GiveAnn(3);
  const std::vector<Interest::Risen> risen = Look();
  ASSERT_EQ(risen.size(), 1u) << "what she holds herself was near before";
  EXPECT_EQ(risen[0].peer, kAnn);
  EXPECT_EQ(risen[0].mechanism, 2);
  EXPECT_TRUE(Look().empty());
}

TEST_F(InterestLook, APeerThatJoinedAfterTheLastUpdateIsNearEverything) {
  Begin({0, 500});
  Look();
  EXPECT_EQ(interest_->Of(7, 1), Relevance::kNear);
}

}  // namespace interest_look_test
}  // namespace seam
