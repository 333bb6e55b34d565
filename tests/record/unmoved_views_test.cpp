/// Views that show what the one before shows: published once a second, read at every tick.

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "common/record/recording.h"
#include "common/sync/publisher.h"

namespace seam {
namespace unmoved_views_test {

constexpr std::int64_t kTickUs = 16667;

/// Keeps what is published, in memory and by channel.
class Heard : public Recorder {
 public:
  void Publish(const std::string& channel, std::int64_t utime, ByteView message) override {
    ++published[channel];
    memory.builder.Add(channel, message, utime + 500);
  }
  void EndTick(const std::string&, const LogSeal&, bool) override {}
  MemoryRecorder memory;
  std::map<std::string, int> published;
};

View ViewOf(std::int64_t tick, float x) {
  View view;
  view.utime = 1000000 + tick * kTickUs;
  view.tick = tick;
  view.id = {3, 4};
  view.role = {kRoleAuthority, kRoleRemote};
  view.authority = {0, 1};
  view.x = {x, 7};
  view.age = {0, 1.5F};
  for (auto* field : {&view.y, &view.angle, &view.vx, &view.vy, &view.spin}) field->assign(2, 0);
  return view;
}

TEST(UnmovedViews, AreReadAtEveryTickAndPublishedOnceASecond) {
  Heard heard;
  Publisher publisher(heard, "r", 77);
  for (std::int64_t tick = 1; tick <= 300; ++tick)
    publisher.Publish(ViewOf(tick, tick < 200 ? 1 : 2));
  publisher.PublishUnmoved();
  EXPECT_LE(heard.published["SEAM.r.view.0"], 8) << "300 ticks are 5 s";
  EXPECT_GE(heard.published["SEAM.r.view.0"], 6);
  const Recording& recording = heard.memory.builder.recording();
  ASSERT_EQ(recording.views.at(0).size(), 300u);
  for (const auto& [tick, view] : recording.views.at(0)) {
    EXPECT_EQ(view.tick, tick);
    EXPECT_EQ(view.x[0], tick < 200 ? 1 : 2) << tick;
    EXPECT_NEAR(static_cast<double>(view.utime), static_cast<double>(ViewOf(tick, 0).utime), 2);
    EXPECT_NEAR(static_cast<double>(recording.view_us.at(0).at(tick)),
                static_cast<double>(ViewOf(tick, 0).utime + 500), 2);
  }
  EXPECT_EQ(recording.bus_gaps, 0);
}

TEST(UnmovedViews, EachFieldThatAPersonSeesCounts) {
  const auto published = [](auto change) {
    Heard heard;
    Publisher publisher(heard, "r", 77);
    publisher.Publish(ViewOf(1, 1));
    View next = ViewOf(2, 1);
    change(next);
    publisher.Publish(next);
    return heard.published["SEAM.r.view.0"];
  };
  EXPECT_EQ(published([](View&) {}), 1);
  EXPECT_EQ(published([](View& v) { v.y[1] = 1e-6F; }), 2);
  EXPECT_EQ(published([](View& v) { v.spin[0] = 1; }), 2);
  EXPECT_EQ(published([](View& v) { v.age[1] = 2; }), 2);
  EXPECT_EQ(published([](View& v) { v.role[1] = kRoleSecondary; }), 2);
  EXPECT_EQ(published([](View& v) { v.authority[1] = 0; }), 2);
  EXPECT_EQ(published([](View& v) { v.revision = 1; }), 2);
  EXPECT_EQ(published([](View& v) { v.id[1] = 5; }), 2);
}

TEST(UnmovedViews, TicksWithoutAViewStayGaps) {
  Heard heard;
  Publisher publisher(heard, "r", 77);
  for (std::int64_t tick = 1; tick <= 40; ++tick) {
    if (tick < 21 || tick > 25) publisher.Publish(ViewOf(tick, 1));
  }
  publisher.PublishUnmoved();
  const auto& views = heard.memory.builder.recording().views.at(0);
  EXPECT_EQ(views.size(), 35u);
  EXPECT_EQ(views.count(20), 1u);
  EXPECT_EQ(views.count(21), 0u);
  EXPECT_EQ(views.count(25), 0u);
}

TEST(UnmovedViews, HaveNoTimeOfReceiptWhereNoneIsKnown) {
  RecordingBuilder builder;
  View view = ViewOf(1, 1);
  view.session = 77;
  EXPECT_TRUE(builder.Add("SEAM.r.view.0", Encode(view)));
  view = ViewOf(9, 1);
  view.session = 77;
  view.sequence = 1;
  view.unmoved = 7;
  EXPECT_TRUE(builder.Add("SEAM.r.view.0", Encode(view)));
  EXPECT_EQ(builder.recording().views.at(0).size(), 9u);
  EXPECT_TRUE(builder.recording().view_us.empty());
}

TEST(UnmovedViews, ALostViewsTicksStayMissing) {
  RecordingBuilder builder;
  View moved = ViewOf(100, 2);
  moved.session = 77;
  moved.unmoved = 50;
  EXPECT_TRUE(builder.Add("SEAM.r.view.0", Encode(moved)));
  EXPECT_EQ(builder.recording().views.at(0).size(), 1u);
}

TEST(UnmovedViews, AreReadFromRecordingsWithoutThem) {
  View view = ViewOf(9, 1);
  view.session = 77;
  Bytes older = Encode(view);
  older.resize(older.size() - 2);
  const std::uint64_t hash = 0xb8a9d0d37dae25e1;  // of view_t up to protocol 17
  for (int i = 0; i < 8; ++i)
    older[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(hash >> (56 - 8 * i));
  const AnyMessage any = Decode(older);
  const View* const back = std::get_if<View>(&any);
  ASSERT_NE(back, nullptr);
  EXPECT_EQ(back->x, view.x);
  EXPECT_EQ(back->age, view.age);
  EXPECT_EQ(back->unmoved, 0);
}

}  // namespace unmoved_views_test
}  // namespace seam
