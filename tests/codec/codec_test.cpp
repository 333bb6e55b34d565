#include "common/codec/codec.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "common/codec/validate.h"
#include "common/net/link.h"
#include "tests/support/allocations/count_allocations.h"
#include "tests/support/random_messages.h"
#include "tests/support/soak.h"

namespace seam {
namespace codec_test {

using Messages =
    ::testing::Types<Hello, Welcome, Redirect, Chunk, Room, ScenePart, Ping, Pong, Inputs, States,
                     Rest, PackedStates, PackedInputs, Grants, Release, ExactStates, ImpactReport,
                     TouchReport, EditOrder, Meta, View, Impacts, Strands, Stats, Event, Summary,
                     TickChain, LogSeal, Accepted, Bye, Reset, Differing>;

template <class Message>
class Codec : public ::testing::Test {};
TYPED_TEST_SUITE(Codec, Messages);

/// Decodes and checks invariants for any bytes: the result is empty or valid, encodes to the same
/// bytes again, and cost little memory.
AnyMessage DecodeChecked(const Bytes& bytes) {
  const std::size_t before = AllocatedBytes();
  AnyMessage any = Decode(bytes);
  EXPECT_LE(AllocatedBytes() - before, 16 * bytes.size() + 4096);
  std::visit(
      [&](const auto& m) {
        if constexpr (!std::is_same_v<std::decay_t<decltype(m)>, std::monostate>) {
          EXPECT_TRUE(Valid(m));
          EXPECT_EQ(Encode(m), bytes);
        }
      },
      any);
  return any;
}

bool Rejected(const Bytes& bytes) {
  return std::holds_alternative<std::monostate>(DecodeChecked(bytes));
}

template <class Message>
Message Small(std::uint64_t seed) {
  RandomMessages random(seed);
  Message message;
  random.Fill(message);
  while (Encode(message).size() > 260) random.Fill(message);
  return message;
}

TYPED_TEST(Codec, RoundTripsRandomContents) {
  RandomMessages random(1);
  for (int i = 0; i < 200; ++i) {
    TypeParam message;
    random.Fill(message);
    const AnyMessage any = DecodeChecked(Encode(message));
    ASSERT_TRUE(std::holds_alternative<TypeParam>(any)) << "round " << i;
    EXPECT_EQ(Fields(std::get<TypeParam>(any)), Fields(message)) << "round " << i;
  }
}

TYPED_TEST(Codec, RejectsEveryTruncationAndEveryTrailingByte) {
  for (const std::uint64_t seed : SoakSeeds(0, 5)) {
    const Bytes bytes = Encode(Small<TypeParam>(seed));
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      EXPECT_TRUE(Rejected(Bytes(bytes.begin(), bytes.begin() + static_cast<long>(size))));
    }
    Bytes longer = bytes;
    longer.push_back(0);
    EXPECT_TRUE(Rejected(longer));
  }
}

TYPED_TEST(Codec, SurvivesEveryCorruptionOfOneByte) {
  Bytes bytes = Encode(Small<TypeParam>(3));
  for (std::uint8_t& byte : bytes) {
    const std::uint8_t good = byte;
    for (int value = 0; value < 256; ++value) {
      byte = static_cast<std::uint8_t>(value);
      DecodeChecked(bytes);
    }
    byte = good;
  }
}

TYPED_TEST(Codec, SurvivesRandomBytesAfterTheRightHash) {
  Random random(4);
  const Bytes good = Encode(Small<TypeParam>(4));
  for (int i = 0; i < Soak(5000); ++i) {
    Bytes bytes(good.begin(), good.begin() + 8);
    const std::size_t size = random.Next() % 300;
    const bool mostly_zero = random.Chance(0.5);
    while (bytes.size() < 8 + size) {
      const bool zero = mostly_zero && random.Chance(0.9);
      bytes.push_back(zero ? std::uint8_t{0} : static_cast<std::uint8_t>(random.Next()));
    }
    DecodeChecked(bytes);
  }
}

TYPED_TEST(Codec, SurvivesManyCorruptionsAtOnce) {
  Random random(5);
  for (std::uint64_t round = 0; round < 2000; ++round) {
    Bytes bytes = Encode(Small<TypeParam>(round));
    for (int n = 1 + static_cast<int>(random.Next() % 8); n > 0; --n) {
      bytes[random.Next() % bytes.size()] = static_cast<std::uint8_t>(random.Next());
    }
    DecodeChecked(bytes);
  }
}

/// `bytes` with a big-endian integer of `size` bytes put at `at`.
Bytes With(Bytes bytes, std::size_t at, std::size_t size, std::uint64_t value) {
  for (std::size_t i = 0; i < size; ++i) {
    bytes[at + i] = static_cast<std::uint8_t>(value >> (8 * (size - 1 - i)));
  }
  return bytes;
}

TEST(CodecHostile, SurvivesHostileStringLengths) {
  Bye bye;
  bye.reason = "because";
  const Bytes bytes = Encode(bye);
  constexpr std::size_t kLengthAt = 16;
  ASSERT_EQ(bytes[kLengthAt + 3], 8);  // with its NUL
  for (const std::uint64_t length :
       {0u, 1u, 7u, 9u, 1u << 25, 1u << 28, 0x7fffffffu, 0x80000000u, 0xfffffff7u, 0xffffffffu}) {
    EXPECT_TRUE(Rejected(With(bytes, kLengthAt, 4, length))) << length;
  }
  EXPECT_TRUE(Rejected(With(bytes, bytes.size() - 1, 1, 'x'))) << "no NUL at the end";
  EXPECT_TRUE(Rejected(With(bytes, bytes.size() - 3, 1, 0))) << "a NUL inside";
  // The 20 bytes that end a stock decoder: hash, time, and a length with nothing behind it.
  for (const std::uint64_t length : {0u, 0xffffffffu}) {
    EXPECT_TRUE(Rejected(With(Bytes(bytes.begin(), bytes.begin() + 20), kLengthAt, 4, length)));
  }
}

TEST(CodecHostile, SurvivesHostileArrayCounts) {
  View view;
  const Bytes bytes = Encode(view);  // the count is its last field
  for (const std::uint64_t count : {1u, 255u, 1901u, 0x7fffu, 0x8000u, 0xff00u, 0xffffu}) {
    EXPECT_TRUE(Rejected(With(bytes, bytes.size() - 2, 2, count))) << count;
    Bytes longer = With(bytes, bytes.size() - 2, 2, count);
    longer.resize(kBusMessageBytesMax, 0);
    EXPECT_TRUE(Rejected(longer)) << count;
  }
}

TEST(CodecHostile, TooLongAndUnknownMessagesAreRefused) {
  EXPECT_TRUE(Rejected({}));
  EXPECT_TRUE(Rejected(Bytes(8, 0xff)));
  EXPECT_TRUE(Rejected(Bytes(kBusMessageBytesMax + 1, 0)));
  Random random(6);
  for (int i = 0; i < 20000; ++i) {
    Bytes bytes(random.Next() % 64);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random.Next());
    EXPECT_TRUE(Rejected(bytes));
  }
}

TEST(CodecHostile, FloatsThatAreNotFiniteAreRefused) {
  RandomMessages random(7);
  View view;
  random.Fill(view, 1);
  const Bytes bytes = Encode(view);
  for (std::size_t at = bytes.size() - 24; at < bytes.size(); at += 4) {
    EXPECT_TRUE(Rejected(With(bytes, at, 4, 0x7f800000u)));  // infinity
    EXPECT_TRUE(Rejected(With(bytes, at, 4, 0xffc00000u)));  // not a number
    EXPECT_FALSE(Rejected(With(bytes, at, 4, 0x3f800000u)));
  }
}

TEST(CodecBounds, TheLargestMessagesFitTheirCarriers) {
  RandomMessages random(8);
  States states;
  random.Fill(states, kStatesBodiesMax);
  EXPECT_LE(Encode(states).size(), kMessageBytesMax);
  Rest rest;
  random.Fill(rest, kRestBodiesMax);
  EXPECT_LE(Encode(rest).size(), kMessageBytesMax);
  Grants grants;
  random.Fill(grants, kGrantsMax);
  EXPECT_LE(Encode(grants).size(), kMessageBytesMax);
  Meta meta;
  random.Fill(meta, kMetaMax);
  EXPECT_LE(Encode(meta).size(), kMessageBytesMax);
  Inputs inputs;
  random.Fill(inputs, kInputsMax);
  EXPECT_LE(Encode(inputs).size(), kMessageBytesMax);
  Chunk chunk;
  chunk.data.assign(kChunkBytesMax, 0);
  EXPECT_LE(Encode(chunk).size(), kMessageBytesMax);
  View view;
  random.Fill(view, kViewBodiesMax);
  EXPECT_LE(Encode(view).size(), kBusMessageBytesMax);
  Impacts impacts;
  random.Fill(impacts, kImpactsMax);
  EXPECT_LE(Encode(impacts).size(), kBusMessageBytesMax);
  Strands strands;
  random.Fill(strands, kStrandPointsMax);
  EXPECT_LE(Encode(strands).size(), kBusMessageBytesMax);
  ScenePart part;
  part.session = 1;
  part.parts = 2;
  part.data.assign(kScenePartBytes, 0);
  EXPECT_LE(Encode(part).size(), kBusMessageBytesMax);
  Room room;
  room.scene_text.assign(kBusSceneBytesMax, '#');
  room.scene_name = room.mode = room.reconcile = room.predict = std::string(kLabelBytesMax, 'x');
  room.impair.assign(kImpairBytesMax, 'x');
  EXPECT_LE(Encode(room).size(), kBusMessageBytesMax);
  room.scene_text.assign(kSceneTextBytesMax, '#');
  const Bytes longest = Encode(room);
  EXPECT_LE(longest.size(), kRoomBytesMax);
  EXPECT_TRUE(std::holds_alternative<Room>(Decode(longest)));
}

TEST(CodecBounds, AMessageThatBreaksABoundIsNotValid) {
  const auto broken = [](auto change) {
    RandomMessages random(9);
    View view;
    random.Fill(view, 3);
    EXPECT_TRUE(Valid(view));
    change(view);
    return !Valid(view);
  };
  EXPECT_TRUE(broken([](View& v) { v.peer = kPeersMax; }));
  EXPECT_TRUE(broken([](View& v) { v.peer = -1; }));
  EXPECT_TRUE(broken([](View& v) { v.tick = -1; }));
  EXPECT_TRUE(broken([](View& v) { v.tick = kTickMax; }));
  EXPECT_TRUE(broken([](View& v) { v.utime = std::numeric_limits<std::int64_t>::min(); }));
  EXPECT_TRUE(broken([](View& v) { v.sequence = -1; }));
  EXPECT_TRUE(broken([](View& v) { v.part = v.parts; }));
  EXPECT_TRUE(broken([](View& v) { v.id[1] = v.id[0]; }));
  EXPECT_TRUE(broken([](View& v) { std::swap(v.id[1], v.id[2]); }));
  EXPECT_TRUE(broken([](View& v) { v.id[0] = -1; }));
  EXPECT_TRUE(broken([](View& v) { v.role[2] = 3; }));
  EXPECT_TRUE(broken([](View& v) { v.authority[2] = kPeersMax; }));
  EXPECT_TRUE(broken([](View& v) { v.spin.pop_back(); }));
  EXPECT_TRUE(broken([](View& v) { v.vx[1] = std::nanf(""); }));
  EXPECT_TRUE(broken([](View& v) { v.age.push_back(0); }));
  EXPECT_TRUE(broken([](View& v) { v.age[0] = -0.5f; }));
  EXPECT_TRUE(broken([](View& v) { v.age[0] = std::nanf(""); }));
}

TEST(CodecBounds, EpochsHaveThirtyTwoBitsAndAreNeverNegative) {
  RandomMessages random(11);
  States states;
  Grants grants;
  random.Fill(states, 1), random.Fill(grants, 1);
  Release release;
  release.mechanism = {3};
  release.epoch = {7};
  const Bytes said = Encode(release);
  // Offset of the epoch in a message with one body or mechanism, by the .lcm files.
  const std::pair<Bytes, std::size_t> cases[] = {
      {Encode(states), 62}, {Encode(grants), 40}, {said, said.size() - 4}};
  for (const auto& [bytes, at] : cases) {
    for (const std::uint32_t epoch : {0x8000u, 0x10000u, 0x7fffffffu}) {
      EXPECT_FALSE(Rejected(With(bytes, at, 4, epoch))) << epoch;
    }
    for (const std::uint32_t epoch : {0xffffffffu, 0x80000000u}) {
      EXPECT_TRUE(Rejected(With(bytes, at, 4, epoch))) << epoch;
    }
  }
}

TEST(CodecText, OnlyPrintableUtf8Passes) {
  EXPECT_TRUE(IsPrintable("plain, \u00e4\u20ac\U0001F600", 64));
  EXPECT_FALSE(IsPrintable("two\nlines", 64));
  EXPECT_TRUE(IsPrintable("two\r\n\tlines", 64, true));
  EXPECT_FALSE(IsPrintable("\x1b[2J", 64, true)) << "terminal escape";
  EXPECT_FALSE(IsPrintable("\x7f", 64));
  EXPECT_FALSE(
      IsPrintable("\xc2\x9b"
                  "2J",
                  64))
      << "8-bit terminal escape";
  EXPECT_FALSE(IsPrintable("\xc0\xaf", 64)) << "overlong";
  EXPECT_FALSE(IsPrintable("\xe0\x80\xaf", 64)) << "overlong";
  EXPECT_FALSE(IsPrintable("\xed\xa0\x80", 64)) << "surrogate";
  EXPECT_FALSE(IsPrintable("\xf4\x90\x80\x80", 64)) << "beyond U+10FFFF";
  EXPECT_FALSE(IsPrintable("cut \xe2\x82", 64));
  EXPECT_FALSE(IsPrintable("\x80", 64));
  EXPECT_FALSE(IsPrintable("12345", 4));
}

TEST(CodecWire, TypeHashesArePinnedToTheProtocolVersion) {
  // A changed hash means that recordings and peers of before no longer decode: bump
  // kProtocolVersion, and write the new hashes here. event_t has grown in protocol 14 and view_t in
  // 18, on the bus alone: their older forms are decoded (SessionForm).
  ASSERT_EQ(kProtocolVersion, 19);
  const std::map<std::string, std::uint64_t> pinned = {
      {"audit_t", 0x39a40a6c08bf57d9u},         {"bye_t", 0x51c7828d52d2d8f2u},
      {"challenge_t", 0xe59aa5f38bd06a54u},     {"chunk_t", 0xfe05a5dcca243573u},
      {"edit_t", 0x41c84806639d73c4u},          {"exact_states_t", 0x431818f6cd4b5951u},
      {"impact_report_t", 0xfbc55c3c7e89b9e3u}, {"touch_report_t", 0x56f8b75978eacdd2u},
      {"event_t", 0x08d79625822525c8u},         {"grants_t", 0xd85703db4578561au},
      {"hello_t", 0x77af54d8cac6751eu},         {"impacts_t", 0x4e6d49f2706f8cc4u},
      {"inputs_t", 0xda8f1891f3ebdd5au},        {"join_t", 0xbceea6740bc140dau},
      {"load_t", 0x161e7cf2e3dba711u},          {"meta_t", 0x854f240a2ce02096u},
      {"ping_t", 0x5033c4912646ec19u},          {"pong_t", 0x54224f4828f2f0bau},
      {"ready_t", 0x4d0d41c1f105b12fu},         {"release_t", 0x9abeee4bbddaf2f3u},
      {"rest_t", 0x74a2fc2deefa7466u},          {"room_t", 0x9d06db812b0fd058u},
      {"scene_part_t", 0x0a6cbaba0e401b6bu},    {"snapshot_t", 0x5041ad92d1002765u},
      {"states_t", 0x59ebd56a2b361895u},        {"stats_t", 0xfa9c7b02adbdd4ebu},
      {"strands_t", 0xc61a1fa141f00542u},       {"view_t", 0xfdd681eaae47d7ebu},
      {"welcome_t", 0x157085589a5edbb7u},       {"packed_states_t", 0x9e508524d7c14130u},
      {"packed_inputs_t", 0x7e50cd24d7c14120u}, {"reset_t", 0x136941e6878393ddu},
      {"differing_t", 0xfa7867b773f44db4u},     {"chain_t", 0x1bb504fc8ab818e3u},
      {"seal_t", 0x80b0f748ba568db6u},          {"summary_t", 0xeb72acb1fb62d80bu},
      {"accepted_t", 0x292fdd050bf2273bu},      {"redirect_t", 0x35aaf68715893148u},
      {"divergence_t", 0x03a8b7d95d04fe05u},
  };
  std::map<std::string, std::uint64_t> hashes;
  std::set<std::uint64_t> different;
  for (const MessageType& type : MessageTypes()) {
    hashes[type.name] = type.hash;
    different.insert(type.hash);
  }
  EXPECT_EQ(hashes, pinned);
  EXPECT_EQ(different.size(), MessageTypes().size());
  // Types that peers of any two versions understand.
  EXPECT_EQ(hashes["hello_t"], 0x77af54d8cac6751eu);
  EXPECT_EQ(hashes["bye_t"], 0x51c7828d52d2d8f2u);
}

}  // namespace codec_test
}  // namespace seam
