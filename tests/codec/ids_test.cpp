/// Ids of parts exceed 16 bits, and ids beyond the limit are refused.

#include <gtest/gtest.h>

#include <variant>

#include "common/codec/codec.h"

namespace seam {
namespace ids_test {

constexpr std::int32_t kHigh = 65534;

/// Returns the message received when `message` is sent; default constructed if refused.
template <class Message>
Message Arrived(const Message& message) {
  const Bytes bytes = Encode(message);
  const AnyMessage decoded = Decode({bytes.data(), bytes.size()});
  const Message* arrived = std::get_if<Message>(&decoded);
  return arrived == nullptr ? Message() : *arrived;
}

/// The same after replacing the bytes of `from` by those of `to` everywhere: values that Encode
/// would never write.
template <class Message>
bool IsTaken(const Message& message, std::int32_t from, std::int32_t to) {
  Bytes bytes = Encode(message);
  for (std::size_t at = 8; at + 4 <= bytes.size(); ++at) {
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < 4; ++i) word = word << 8 | bytes[at + i];
    if (word != static_cast<std::uint32_t>(from)) continue;
    for (std::size_t i = 0; i < 4; ++i) {
      bytes[at + i] = static_cast<std::uint8_t>(static_cast<std::uint32_t>(to) >> (24 - 8 * i));
    }
  }
  return !std::holds_alternative<std::monostate>(Decode({bytes.data(), bytes.size()}));
}

States OneState(std::int32_t id) {
  States states;
  states.id = {3, id};
  states.epoch = {1, 1};
  states.flags = {0, 0};
  states.x = states.y = states.angle = states.vx = states.vy = states.spin = {5, 6};
  return states;
}

View OneView(std::int32_t id) {
  View view;
  view.id = {3, id};
  view.role = {0, 0};
  view.authority = {0, 1023};
  view.x = view.y = view.angle = view.vx = view.vy = view.spin = view.age = {5, 6};
  return view;
}

TEST(Ids, IdsAboveSixteenBitsArriveAsTheyWereSent) {
  for (const std::int32_t id : {32768, kHigh, kIdsMax - 1}) {
    EXPECT_EQ(Arrived(OneState(id)).id, (std::vector<std::int32_t>{3, id}));
    EXPECT_EQ(Arrived(OneView(id)).id, (std::vector<std::int32_t>{3, id}));

    Rest rest;
    rest.id = {id};
    rest.epoch = {1};
    rest.x = rest.y = rest.angle = {0};
    EXPECT_EQ(Arrived(rest).id, rest.id);

    ExactStates exact;
    exact.id = {id};
    exact.epoch = {1};
    exact.x = exact.y = exact.angle = exact.vx = exact.vy = exact.spin = {0};
    EXPECT_EQ(Arrived(exact).id, exact.id);

    Release release;
    release.mechanism = {id};
    release.epoch = {1};
    EXPECT_EQ(Arrived(release).mechanism, release.mechanism);

    ImpactReport report;
    report.id = report.by = {id};
    report.epoch = {1};
    report.x = report.y = report.dv = {1};
    EXPECT_EQ(Arrived(report).id, report.id);
    EXPECT_EQ(Arrived(report).by, report.by);

    Impacts impacts;
    impacts.id_a = impacts.id_b = {id};
    impacts.x = impacts.y = impacts.dv = {1};
    EXPECT_EQ(Arrived(impacts).id_a, impacts.id_a);
    EXPECT_EQ(Arrived(impacts).id_b, impacts.id_b);

    EditOrder edit;
    edit.kind = 2;
    edit.a = id - 1;
    edit.b = id;
    EXPECT_EQ(Arrived(edit).a, id - 1);
    EXPECT_EQ(Arrived(edit).b, id);

    Snapshot snapshot;
    snapshot.kind = {5};
    snapshot.joint = {-1};
    snapshot.a = snapshot.b = {id};
    EXPECT_EQ(Arrived(snapshot).a, snapshot.a);
    EXPECT_EQ(Arrived(snapshot).b, snapshot.b);

    Meta meta;
    meta.kind = {kMetaPart};
    meta.id = {id};
    meta.key = {kMetaHealth};
    meta.value = {1};
    EXPECT_EQ(Arrived(meta).id, meta.id);
  }
}

TEST(Ids, RefusesIdsBeyondTheLimitAndBelowZero) {
  ASSERT_TRUE(IsTaken(OneState(kHigh), kHigh, kIdsMax - 1));
  EXPECT_FALSE(IsTaken(OneState(kHigh), kHigh, kIdsMax));
  EXPECT_FALSE(IsTaken(OneState(kHigh), kHigh, -1));
  ASSERT_TRUE(IsTaken(OneView(kHigh), kHigh, kIdsMax - 1));
  EXPECT_FALSE(IsTaken(OneView(kHigh), kHigh, kIdsMax));
  EditOrder edit;
  edit.a = kHigh;
  ASSERT_TRUE(IsTaken(edit, kHigh, -1)) << "no part";
  EXPECT_FALSE(IsTaken(edit, kHigh, -2));
  EXPECT_FALSE(IsTaken(edit, kHigh, kIdsMax));
  Meta meta;
  meta.kind = {kMetaPart};
  meta.id = {kHigh};
  meta.key = {kMetaHealth};
  meta.value = {1};
  ASSERT_TRUE(IsTaken(meta, kHigh, kIdsMax - 1));
  EXPECT_FALSE(IsTaken(meta, kHigh, kIdsMax));
}

TEST(Ids, AMechanismThatAllFollowFitsOneMessage) {
  Grants grants;
  grants.mechanism = {kHigh};
  grants.authority = {kPeersMax - 1};
  grants.epoch = {7};
  grants.followers = {kPlayersFollowingMax + 1};
  for (int peer = 0; peer <= kPlayersFollowingMax; ++peer) {
    grants.follower.push_back(static_cast<std::int16_t>(peer));
  }
  EXPECT_LE(Encode(grants).size(), kMessageBytesMax);
  const Grants arrived = Arrived(grants);
  EXPECT_EQ(arrived.mechanism, grants.mechanism);
  EXPECT_EQ(arrived.authority, grants.authority);
  EXPECT_EQ(arrived.follower, grants.follower);
}

}  // namespace ids_test
}  // namespace seam
