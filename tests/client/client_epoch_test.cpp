/// Epochs of rooms, and redirects, as a client takes them.

#include "tests/client/client_join.h"

namespace seam {
namespace client_epoch_test {

using ClientEpoch = ClientJoin;

TEST_F(ClientEpoch, AWelcomeOfALowerEpochThanItHasSeenIsRefused) {
  ASSERT_NE(LetIn(5), 0u);
  EXPECT_EQ(client_.epoch(), 5);
  for (int n = 0; n < 60 && client_.peer() >= 0; ++n) Next(100000);
  ASSERT_EQ(client_.peer(), -1) << "silent for 5 s";
  for (const std::int32_t epoch : {4, 1, 4}) {
    ASSERT_NE(LetIn(epoch), 0u);
    EXPECT_EQ(client_.peer(), -1) << epoch;
  }
  EXPECT_EQ(client_.fatal(), "");
  EXPECT_EQ(client_.TakeNotice(),
            "0.0.0.1:7777 refuses: it has epoch 4 of the room, which has gone on elsewhere to 5; "
            "asking on");
  ASSERT_NE(LetIn(5), 0u);
  EXPECT_EQ(client_.peer(), 1) << "the same epoch";
}

TEST_F(ClientEpoch, ShowsTheEpochItHasSeenWithItsProof) {
  Next(0);
  Answer(Encode(ChallengeOf(1)));
  AnyMessage any = Next(10000);
  EXPECT_EQ(std::get<Join>(any).epoch, 0);
  ASSERT_NE(LetIn(5), 0u);
  for (int n = 0; n < 60 && client_.peer() >= 0; ++n) Next(100000);
  Answer(Encode(ChallengeOf(2)));
  any = Next(10000);
  ASSERT_TRUE(std::holds_alternative<Join>(any));
  EXPECT_EQ(std::get<Join>(any).epoch, 5);
  EXPECT_EQ(std::get<Join>(any).proof, 75);
}

TEST_F(ClientEpoch, ARedirectThatIsNotInASealedSessionIsIgnored) {
  Redirect redirect;
  redirect.address = "0.0.0.3:7777";
  redirect.room = "main";
  Next(0);
  Answer(Encode(redirect));
  Next(10000);
  EXPECT_EQ(client_.server(), (Address{1, 7777}));
  const std::uint64_t session = LetIn();
  server_->Send({2, 1}, LooseDatagram(session, Encode(redirect)));
  Next(10000);
  EXPECT_EQ(client_.server(), (Address{1, 7777}));
  EXPECT_FALSE(client_.moving());
}

}  // namespace client_epoch_test
}  // namespace seam
