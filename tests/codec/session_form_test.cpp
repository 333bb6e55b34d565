/// Messages of the bus say their session; those of the edge do not, and are as long as before.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "common/codec/codec.h"
#include "tests/support/random_messages.h"

namespace seam {
namespace session_form_test {

/// Checks a message of the bus in its two forms. `hash`: of the type without the session.
template <class Message>
void CheckSessionForms(std::uint64_t hash) {
  RandomMessages random(5);
  Message without;
  random.Fill(without);
  Message with = without;
  with.session = 0x1122334455667788;
  const Bytes longer = Encode(with), shorter = Encode(without);
  std::size_t younger =
      0;  // ages and `unmoved` of a view are at its end, an event's kind and so on
  if constexpr (std::is_same_v<Message, View>) younger = 4 * with.id.size() + 2;
  if constexpr (std::is_same_v<Message, Event>) younger = 29;
  ASSERT_EQ(longer.size(), shorter.size() + 8 + younger);
  EXPECT_EQ(SessionOf(longer), with.session);
  EXPECT_EQ(SessionOf(shorter), 0);
  const AnyMessage any = Decode(longer);
  ASSERT_TRUE(std::holds_alternative<Message>(any));
  EXPECT_EQ(Fields(std::get<Message>(any)), Fields(with));
  // The shorter form lacks the session alone, and has the hash of protocols 8 to 12.
  Bytes cut = longer;
  cut.erase(cut.begin() + 16, cut.begin() + 24);
  cut.resize(cut.size() - younger);
  for (int i = 0; i < 8; ++i)
    cut[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(hash >> (56 - 8 * i));
  EXPECT_EQ(cut, shorter);
  // A session of 0 is never written out, so that a message has one encoding.
  Bytes zero = longer;
  std::fill(zero.begin() + 16, zero.begin() + 24, std::uint8_t{0});
  EXPECT_TRUE(std::holds_alternative<std::monostate>(Decode(zero)));
}

TEST(SessionForm, AViewOfProtocol12HasNoAges) {
  RandomMessages random(6);
  View view;
  random.Fill(view, 3);
  view.age = {0, 6.5f, 1};
  View found = std::get<View>(Decode(Encode(view)));
  EXPECT_EQ(found.age, (std::vector<float>{0, 0, 0}));
  EXPECT_EQ(found.spin, view.spin);
  view.session = 7;
  found = std::get<View>(Decode(Encode(view)));
  EXPECT_EQ(found.age, view.age);
  EXPECT_EQ(found.spin, view.spin);
}

TEST(SessionForm, AnEventOfBefore026IsALine) {
  Event event = MakeEvent(EventKind::kBroke, "a and b come apart", 3);
  event.body = 5;
  event.value_milli = 7;
  event.session = 9;
  const Bytes now = Encode(event);
  EXPECT_EQ(std::get<Event>(Decode(now)).body, 5);
  // Version 0.25 wrote the same up to the text, with another hash.
  Bytes before(now.begin(), now.end() - 29);
  for (int i = 0; i < 8; ++i) {
    before[static_cast<std::size_t>(i)] =
        static_cast<std::uint8_t>(0x71e7d8d436202ff5u >> (56 - 8 * i));
  }
  const AnyMessage any = Decode(before);
  ASSERT_TRUE(std::holds_alternative<Event>(any));
  const Event& read = std::get<Event>(any);
  EXPECT_EQ(read.text, event.text);
  EXPECT_EQ(read.session, 9);
  EXPECT_EQ(read.kind, 0);
  EXPECT_EQ(read.player, -1);
  EXPECT_EQ(read.index, -1);
  EXPECT_EQ(read.value_milli, 0);
  EXPECT_EQ(SessionOf(before), 9);
}

TEST(SessionForm, AMessageWithoutSessionIsEncodedAsProtocol12Did) {
  CheckSessionForms<Room>(0x3b1556dd65c2c546);
  CheckSessionForms<Inputs>(0x61098e4e073aa192);
  CheckSessionForms<States>(0x1f0a57888e9a756c);
  CheckSessionForms<Grants>(0x67581669edb00607);
  CheckSessionForms<EditOrder>(0xb5af6cfe14504027);
  CheckSessionForms<Meta>(0x37a03ee57e14fe0e);
  CheckSessionForms<View>(0xc90a36171e1d6168);
  CheckSessionForms<Impacts>(0x84c369572c4b9199);
  CheckSessionForms<Strands>(0x4c2098e274343524);
  CheckSessionForms<Stats>(0x60f5b0e4b0054c75);
  CheckSessionForms<Load>(0xbe88264f7026f53b);
  CheckSessionForms<Event>(0x501798193aa2f237);
  EXPECT_EQ(SessionOf(Encode(Ping{})), std::nullopt) << "not a message of the bus";
  EXPECT_EQ(SessionOf(Bytes{1, 2, 3}), std::nullopt);
}

}  // namespace session_form_test
}  // namespace seam
