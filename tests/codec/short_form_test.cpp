/// The form of messages within datagrams: every message survives it, and no bytes harm who reads
/// it.

#include "common/codec/short_form.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <type_traits>

#include "common/base/random.h"
#include "common/codec/codec.h"
#include "tests/support/random_messages.h"

namespace seam {
namespace short_form_test {

Bytes Restored(const Bytes& form) {
  Bytes message;
  EXPECT_TRUE(ReadShortForm(form, &message));
  return message;
}

TEST(ShortForm, HasTheBytesThatTheProtocolPageShows) {
  Release release;
  release.tick = 258;
  release.mechanism = {7};
  release.epoch = {0};
  const Bytes message = Encode(release);
  const Bytes form = ShortForm(message);
  const auto& types = MessageTypes();
  const auto type = std::find_if(types.begin(), types.end(), [](const MessageType& t) {
    return t.name == std::string("release_t");
  });
  const auto number = static_cast<std::uint8_t>(type - types.begin());
  EXPECT_EQ(number, 15);
  const Bytes expected = {number, 0x00, 0xc0, 1, 2, 0x22, 1, 7, 0x04, 1};
  EXPECT_EQ(form, expected);
  EXPECT_EQ(Restored(form), message);
}

/// Bytes of messages of a type, and of their short forms.
struct Total {
  std::size_t messages = 0, forms = 0;
};

template <class Message>
constexpr bool kOfBusAndEdge = std::is_same_v<Message, Inputs> || std::is_same_v<Message, States> ||
                               std::is_same_v<Message, Grants> ||
                               std::is_same_v<Message, EditOrder> || std::is_same_v<Message, Meta>;

template <class Message>
void ExpectRestored(Total* total) {
  RandomMessages random(5);
  for (int round = 0; round < 200; ++round) {
    Message filled;
    random.Fill(filled);
    if constexpr (kOfBusAndEdge<Message>) filled.session = 0;
    const Bytes message = Encode(filled);
    if (message.size() > kMessageBytesMax) continue;
    const Bytes form = ShortForm(message);
    ASSERT_EQ(Restored(form), message);
    if (TypeOfShortForm(form) < 0) continue;  // of the bus alone
    ASSERT_LE(form.size(), message.size() - 7);
    total->messages += message.size();
    total->forms += form.size();
  }
}

TEST(ShortForm, EveryMessageOfTheEdgeComesBackAndIsShorter) {
  Total total;
#define SEAM_RESTORE(Struct, ...) ExpectRestored<Struct>(&total);
  SEAM_MESSAGES(SEAM_RESTORE)
#undef SEAM_RESTORE
  EXPECT_GT(total.messages, 100'000u);
  EXPECT_LT(total.forms, total.messages);
}

TEST(ShortForm, BytesOfNoTypeAreOneLonger) {
  Random random(6);
  for (std::size_t size = 1; size <= kMessageBytesMax; size += 1 + size / 8) {
    Bytes message(size);
    for (auto& byte : message) byte = static_cast<std::uint8_t>(random.Next());
    const Bytes form = ShortForm(message);
    EXPECT_EQ(form.size(), size + kShortFormExtra);
    EXPECT_EQ(TypeOfShortForm(form), -1);
    EXPECT_EQ(Restored(form), message);
  }
}

TEST(ShortForm, NoBytesMakeAMessageLongerThanTheLimit) {
  Random random(7);
  int read = 0;
  for (int round = 0; round < 200'000; ++round) {
    Bytes form(random.Next() % 64 + (round % 100 == 0 ? kShortFormBytesMax - 40 : 0));
    for (auto& byte : form) {
      byte = static_cast<std::uint8_t>(random.Next() % 3 == 0 ? random.Next() : 0);
    }
    Bytes message;
    if (!ReadShortForm(form, &message)) continue;
    ++read;
    ASSERT_GE(message.size(), 1u);
    ASSERT_LE(message.size(), kMessageBytesMax);
    ASSERT_EQ(Restored(ShortForm(message)), message);
  }
  EXPECT_GT(read, 1000);
  Bytes zeros(1150, 0), message;  // each of them eight
  zeros.back() = 1;
  zeros.push_back(1);
  EXPECT_FALSE(ReadShortForm(zeros, &message));
}

}  // namespace short_form_test
}  // namespace seam
