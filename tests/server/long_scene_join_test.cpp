/// A session is sent a long room in step with its acknowledgements, and has the time that it takes.

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "common/base/compress.h"
#include "common/base/random.h"
#include "server/sessions/session_table.h"
#include "tests/support/session_guest.h"

namespace seam {
namespace long_scene_join_test {

constexpr char kOnePlayer[] =
    "[[player]]\nname = \"ann\"\n[[part]]\nname = \"ground\"\nchain = [[-9, 0], [9, 0]]\n";
constexpr std::int64_t kStepUs = 20000;

/// Bytes that do not get shorter.
Bytes Noise(std::size_t size) {
  Random random(1);
  Bytes bytes(size);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.Next());
  return bytes;
}

class LongSceneJoin : public ::testing::Test {
 protected:
  static constexpr std::size_t kRoomBytes = 600000;

  LongSceneJoin() {
    ann_.SayHello();
    Step();
    ann_.SayJoin();
    Step();
  }
  /// `reads`: ann takes and acknowledges what has come.
  void Step(bool reads = true) {
    now_us_ += kStepUs;
    Address from;
    Bytes datagram;
    while (net_->Receive(&from, &datagram)) {
      table_.Receive(now_us_, from, datagram, [](Session&, ByteView) {});
    }
    table_.DropSilent(now_us_);
    table_.Advance(now_us_);
    table_.Flush(now_us_, &stats_);
    for (const SessionEvent& event : table_.TakeEvents()) last_ = event;
    if (const Session* session = table_.Find(1)) {
      most_ = std::max(most_, session->link.waiting());
    }
    if (!reads) return;
    ann_.Read(now_us_, [&](const AnyMessage& any) {
      if (const auto* welcome = std::get_if<Welcome>(&any)) size_ = welcome->room_bytes;
      const auto* chunk = std::get_if<Chunk>(&any);
      if (chunk == nullptr) return;
      EXPECT_EQ(static_cast<std::size_t>(chunk->offset_bytes), got_.size());
      got_.insert(got_.end(), chunk->data.begin(), chunk->data.end());
    });
    ann_.Flush(now_us_);
  }
  bool sent() const { return last_ && last_->kind == SessionEvent::Kind::kLoading; }

  Scene scene_ = ParseScene(kOnePlayer, "test.toml");
  MemoryNetwork network_;
  std::unique_ptr<Net> net_ = network_.Attach(Guest::kServer);
  SeededEntropy entropy_{1};
  const Bytes room_ = Noise(kRoomBytes);
  SessionTable table_{scene_, room_, AllowedTraffic(60, 30), *net_, entropy_};
  Guest ann_{&network_, 1, "ann"};
  Bytes got_;
  std::int32_t size_ = 0;
  std::size_t most_ = 0;  // messages that waited at the link
  std::optional<SessionEvent> last_;
  std::int64_t now_us_ = 1000000;
  Stats stats_;
};

TEST_F(LongSceneJoin, TheRoomComesWholeAndTheLinkHoldsLittleOfIt) {
  for (int n = 0; n < 3000 && !sent(); ++n) Step();
  ASSERT_TRUE(sent());
  for (int n = 0; n < 100; ++n) Step();
  ASSERT_EQ(got_.size(), static_cast<std::size_t>(size_));
  EXPECT_EQ(Decompress(got_, kRoomBytes), room_);
  EXPECT_LT(most_, 100u) << "of 600 messages";
}

TEST_F(LongSceneJoin, TheWorldFollowsOnlyAfterTheLastOfTheRoom) {
  for (int n = 0; n < 3000 && !sent(); ++n) {
    Step();
    if (!sent()) {
      table_.SendToAll(Encode(Meta()));
      EXPECT_EQ(table_.Find(1)->stage, SessionStage::kAdmitted);
    }
  }
  EXPECT_TRUE(sent());
  EXPECT_EQ(table_.Find(1)->room_sent, static_cast<std::size_t>(size_));
}

TEST_F(LongSceneJoin, ASlowSessionHasTheTimeForItsRoom) {
  // Acknowledges every 1.2 s only.
  for (int n = 0; !sent() && n < 40000; ++n) Step(n % 60 == 0);
  EXPECT_TRUE(sent()) << (last_ ? last_->why : "");
  EXPECT_GT(now_us_, 10000000) << "more than a session without a room has";
}

TEST_F(LongSceneJoin, ASessionThatAcknowledgesNothingIsDroppedAtLast) {
  const auto gone = [&] { return last_ && last_->kind == SessionEvent::Kind::kLeft; };
  std::int64_t silent_us = now_us_;
  for (int n = 0; !gone() && n < 1000; ++n) Step(false);
  EXPECT_TRUE(gone());
  EXPECT_EQ(last_->why, "not heard for 4 s");
  silent_us = now_us_ - silent_us;
  EXPECT_GT(silent_us, 4000000 + 10 * static_cast<std::int64_t>(kRoomBytes) - 100000)
      << "a client is silent while it parses a long scene";
  EXPECT_LT(silent_us, 12000000);
}

}  // namespace long_scene_join_test
}  // namespace seam
