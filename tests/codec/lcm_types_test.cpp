/// The types for other programs: their bytes come back as they were, and wrong ones are refused.

#include "common/codec/lcm_types.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/base/random.h"
#include "common/codec/codec.h"

namespace seam {
namespace lcm_types_test {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

template <class T>
std::string Why(ByteView bytes) {
  T message;
  return Decode(bytes, &message).why();
}

TEST(LcmTypesOfPrograms, ComeBackAsTheyWere) {
  LcmPose pose{1, 2, 3, "car", 0.1, -2.5, 3e-300, 4, 5, -6}, pose_back;
  EXPECT_TRUE(Decode(Encode(pose), &pose_back).ok());
  EXPECT_EQ(pose_back.tick, 2);
  EXPECT_EQ(pose_back.peer, 3);
  EXPECT_EQ(pose_back.name, "car");
  EXPECT_EQ(pose_back.x, 0.1);
  EXPECT_EQ(pose_back.angle, 3e-300);
  EXPECT_EQ(pose_back.spin, -6);
  LcmDrive drive{7, -0.25, 1, 5}, drive_back;
  EXPECT_TRUE(Decode(Encode(drive), &drive_back).ok());
  EXPECT_EQ(drive_back.drive, -0.25);
  EXPECT_EQ(drive_back.buttons, 5);
  const LcmHeard heard{"A.B", {9, "lidar", {0.5, -1e9}, "\xc3\xa9t\xc3\xa9"}};
  LcmHeard heard_back;
  EXPECT_TRUE(Decode(Encode(heard), &heard_back).ok());
  EXPECT_EQ(heard_back.channel, "A.B");
  EXPECT_EQ(heard_back.message.value, heard.message.value);
  EXPECT_EQ(heard_back.message.text, heard.message.text);
}

TEST(LcmTypesOfPrograms, ANumberOutOfRangeIsRefused) {
  for (const double wrong : {kNan, kInf, -kInf, 1.001, -1e300}) {
    EXPECT_EQ(Why<LcmDrive>(Encode(LcmDrive{0, wrong, 0, 0})), "has a drive that is not in -1..1");
    EXPECT_EQ(Why<LcmDrive>(Encode(LcmDrive{0, 0, wrong, 0})), "has a lift that is not in -1..1");
  }
  for (const int wrong : {-1, 32768}) {
    EXPECT_EQ(Why<LcmDrive>(Encode(LcmDrive{0, 0, 0, wrong})),
              "has buttons that are not in 0..32767");
  }
  EXPECT_EQ(Why<LcmPose>(Encode(LcmPose{0, 0, 0, "a", kNan, 0, 0, 0, 0, 0})),
            "has a pose that is no finite number");
}

/// Returns a good message's bytes with one byte changed.
Bytes With(Bytes bytes, std::size_t at, std::uint8_t byte) {
  bytes[at] = byte;
  return bytes;
}

TEST(LcmTypesOfPrograms, AWrongMessageIsRefused) {
  const Bytes good = Encode(LcmMessage{0, "gate", {1.5}, "open"});
  ASSERT_EQ(Why<LcmMessage>(good), "");
  const std::string foreign = "is no seam.message_t (another fingerprint or length)";
  EXPECT_EQ(Why<LcmMessage>(With(good, 3, good[3] ^ 1)), foreign);
  EXPECT_EQ(Why<LcmMessage>(Bytes()), foreign);
  EXPECT_EQ(Why<LcmMessage>(Encode(LcmDrive{})), foreign);
  EXPECT_EQ(Why<LcmMessage>(Bytes(good.begin(), good.end() - 1)), foreign);
  // hash, utime, length of the name, name, count, then the value
  const std::size_t name = 8 + 8 + 4, value = name + 5 + 2;
  EXPECT_EQ(Why<LcmMessage>(With(good, name, '\n')), "has no name of 1 to 64 printable bytes");
  EXPECT_EQ(Why<LcmMessage>(With(With(good, value, 0x7f), value + 1, 0xf8)),
            "has a value that is no finite number");
  EXPECT_EQ(Why<LcmMessage>(With(good, good.size() - 3, 1)),
            "has a text that is no line of at most 1000 printable bytes");
}

TEST(LcmTypesOfPrograms, DamagedBytesAreRefusedOrValid) {
  Random random(5);
  const Bytes good = Encode(LcmHeard{"C", {1, "n", {1, 2, 3}, "text"}});
  for (int i = 0; i < 20000; ++i) {
    Bytes bytes = good;
    const auto flips = 1 + random.Next() % 4;
    for (std::uint64_t f = 0; f < flips; ++f) {
      bytes[random.Next() % bytes.size()] = static_cast<std::uint8_t>(random.Next());
    }
    LcmHeard heard;
    if (!Decode(bytes, &heard).ok()) continue;
    EXPECT_EQ(Encode(heard), bytes);
  }
}

TEST(LcmTypesOfPrograms, AreNoMessagesOfTheRoom) {
  for (const Bytes& bytes :
       {Encode(LcmPose{}), Encode(LcmDrive{}), Encode(LcmHeard{"C", {0, "n", {}, ""}})}) {
    EXPECT_TRUE(std::holds_alternative<std::monostate>(Decode(bytes)));
  }
}

}  // namespace lcm_types_test
}  // namespace seam
