/// The message sizes in limits.h equal those of the encoder.

#include "common/sync/limits.h"

#include <gtest/gtest.h>

#include "common/codec/codec.h"
#include "tests/support/random_messages.h"

namespace seam {
namespace limits_test {

template <class Message>
void ExpectBytes(const MessageBytes& bytes, std::size_t count) {
  RandomMessages random(1);
  Message message;
  random.Fill(message, count);
  std::size_t session = 0;
  if constexpr (std::is_same_v<Message, View>) {  // only with a session it has ages
    message.session = 1;
    session = sizeof message.session;
  }
  EXPECT_EQ(Encode(message).size(), Largest(bytes, count) + session) << count << " elements";
}

TEST(Limits, MessagesHaveTheComputedSize) {
  for (const std::size_t count : {1, 7}) {
    ExpectBytes<States>(kStatesBytes, count);
    ExpectBytes<Rest>(kRestBytes, count);
    ExpectBytes<Meta>(kMetaBytes, count);
    ExpectBytes<Inputs>(kInputsBytes, count);
    ExpectBytes<View>(kViewBytes, count);
    ExpectBytes<Impacts>(kImpactsBytes, count);
  }
  Chunk chunk;
  chunk.data.assign(5, 0);
  EXPECT_EQ(Encode(chunk).size(), Largest(kChunkBytes, 5));
  EditOrder order;
  order.kind = kEditKindBlast;  // the one that has five numbers
  order.value.push_back(0);
  order.text = "[[part]]";
  EXPECT_EQ(Encode(order).size(), Largest(kEditBytes, order.text.size()));
  Room room;
  room.scene_text = "12345";
  room.mode = "buffer";
  EXPECT_EQ(Encode(room).size(), Largest(kRoomBytes, 11));
}

TEST(Limits, GrantsAndReleasesHaveTheComputedSize) {
  Grants grants;
  grants.mechanism = {1, 2};
  grants.authority = {0, 1};
  grants.epoch = {3, 4};
  grants.followers = {0, 3};
  grants.follower = {0, 1, 2};
  EXPECT_EQ(Encode(grants).size(), Largest(kGrantsBytes, 2) + 3 * kFollowerBytes);
  Release release;
  release.mechanism = {1, 2};
  release.epoch = {3, 4};
  EXPECT_EQ(Encode(release).size(), Largest(kReleaseBytes, 2));
}

}  // namespace limits_test
}  // namespace seam
