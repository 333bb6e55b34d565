/// A running session as events: deltas restore every pose, late watchers get all of the scene, and
/// the bytes stay within their budget.

#include "render/view/live_feed.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "common/codec/codec.h"
#include "tests/render/page_reader.h"
#include "tests/support/render_synthetic.h"

namespace seam {
namespace live_feed_test {

/// Reads frames as render/view/view_deltas.h describes them.
class FrameReader {
 public:
  /// Reads one frame; the bodies of its peer stay from frame to frame.
  ViewFrame Read(PageReader* in) {
    ViewFrame frame;
    frame.peer = static_cast<int>(in->Unsigned());
    frame.tick = in->Signed();
    frame.world = static_cast<int>(in->Unsigned());
    auto& known = bodies_[frame.peer];
    if (in->Unsigned() == 1) known.clear();
    int id = -1;
    for (std::uint64_t k = in->Unsigned(); k > 0; --k) {
      id += static_cast<int>(in->Unsigned()) + 1;
      EXPECT_EQ(known.erase(id), 1u);
    }
    for (auto& [key, body] : known)
      for (std::size_t i = 0; i < 3; ++i) body.pose[i] += body.step[i];
    id = -1;
    for (std::uint64_t k = in->Unsigned(); k > 0; --k) {
      const std::uint64_t word = in->Unsigned();
      id += static_cast<int>(word / 2) + 1;
      const bool fresh = known.count(id) == 0;
      Body& body = known[id];
      if (word % 2 == 1) body.owner = static_cast<int>(in->Unsigned());
      for (std::size_t i = 0; i < 3; ++i) {
        const std::int64_t rest = in->Signed();
        body.pose[i] += rest;
        if (!fresh) body.step[i] += rest;
      }
    }
    for (const auto& [key, body] : known) frame.bodies.push_back({key, body.pose, body.owner});
    return frame;
  }

 private:
  struct Body {
    std::array<std::int64_t, 3> pose{}, step{};
    int owner = 0;
  };
  std::map<int, std::map<int, Body>> bodies_;
};

TEST(ViewDeltas, RestoreEveryPoseWhateverComesAndGoes) {
  std::mt19937 random(1);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  ViewDeltas deltas;
  FrameReader reader;
  ViewFrame frame;
  frame.peer = 3;
  for (int tick = 0; tick < 400; ++tick) {
    frame.tick = tick * 2;
    frame.world = below(5);
    std::vector<ViewFrame::Body> next;
    for (int id = 0; id < 60; ++id) {
      const auto old = std::find_if(frame.bodies.begin(), frame.bodies.end(),
                                    [&](const auto& body) { return body.id == id; });
      if (below(20) == 0) continue;  // not shown
      ViewFrame::Body body{id, {below(100000) - 50000, below(9) - 4, -below(7000)}, below(30)};
      if (old != frame.bodies.end() && below(4) != 0) body = *old;
      if (below(3) == 0) body.pose[0] += below(200) - 100;
      next.push_back(body);
    }
    frame.bodies = next;
    PageBytes bytes;
    deltas.Put(frame, tick % 50 == 0, &bytes);
    PageReader in(bytes);
    const ViewFrame read = reader.Read(&in);
    EXPECT_TRUE(in.AtEnd());
    EXPECT_EQ(read.tick, frame.tick);
    EXPECT_EQ(read.world, frame.world);
    ASSERT_EQ(read.bodies.size(), frame.bodies.size());
    for (std::size_t i = 0; i < read.bodies.size(); ++i) {
      EXPECT_EQ(read.bodies[i].id, frame.bodies[i].id);
      EXPECT_EQ(read.bodies[i].pose, frame.bodies[i].pose);
      EXPECT_EQ(read.bodies[i].owner, frame.bodies[i].owner);
    }
  }
}

TEST(ViewDeltas, ARestingAndAnEvenlyMovingBodyCostNothing) {
  ViewDeltas deltas;
  ViewFrame frame;
  for (int tick = 0; tick < 5; ++tick) {
    frame.bodies = {{7, {1000, 2000, 30}, 4}, {9, {100 * tick, 7, -20 * tick}, 4}};
    frame.tick = tick;
    PageBytes bytes;
    deltas.Put(frame, tick == 0, &bytes);
    if (tick < 2) continue;
    EXPECT_EQ(bytes.size(), 6u);
  }
}

TEST(EventRing, AWatcherThatIsTooSlowLosesItsPlace) {
  EventRing ring;
  std::uint64_t quick = ring.end(), slow = ring.end();
  const std::string data(100000, 'x');
  for (int i = 0; i < 100; ++i) {
    ring.Add("frames", data);
    ASSERT_TRUE(ring.Has(quick));
    EXPECT_EQ(*ring.At(&quick), EventText("frames", data));
    EXPECT_EQ(ring.At(&quick), nullptr);
  }
  EXPECT_FALSE(ring.Has(slow));
  ring.Clear();
  EXPECT_FALSE(ring.Has(quick));
  EXPECT_TRUE(ring.Has(ring.end()));
}

/// A session of many bodies that all move unevenly, as seen by two peers.
class CrowdFeed {
 public:
  explicit CrowdFeed(int bodies) : bodies_(bodies), feed_("", "") {
    Room room;
    room.room = "crowd";
    room.session = 5;
    room.protocol = kProtocolVersion;
    room.scene_name = "crowd";
    room.mode = "buffer";
    room.reconcile = "rollback";
    room.impair = "demo";
    room.tick_hz = 60;
    room.send_hz = 30;
    room.scene_text = fmt::format(
        "title = \"Crowd\"\nduration = 60\n[[player]]\nname = \"ann\"\n[[part]]\nname = \"b\"\n"
        "box = [1, 1]\nposition = [0, 5]\nrepeat = {{count = {}, step = [2, 0]}}\n",
        bodies);
    EXPECT_TRUE(feed_.Add("SEAM.crowd.scene", Encode(room)));
  }
  void Tick(int tick) {
    for (int peer = 0; peer < 2; ++peer) {
      View view;
      view.session = 5;
      view.sequence = tick;
      view.peer = peer;
      view.tick = tick;
      view.parts = 1;
      for (int id = 0; id < bodies_; ++id) {
        const double phase = 0.1 * tick + id;
        view.id.push_back(id);
        view.role.push_back(kRoleAuthority);
        view.authority.push_back(0);
        view.x.push_back(static_cast<float>(2 * id + std::sin(phase)));
        view.y.push_back(static_cast<float>(5 + std::cos(1.7 * phase)));
        view.angle.push_back(static_cast<float>(std::sin(2.3 * phase)));
        for (auto* column : {&view.vx, &view.vy, &view.spin, &view.age}) column->push_back(0);
      }
      EXPECT_TRUE(feed_.Add(fmt::format("SEAM.crowd.view.{}", peer), Encode(view)));
    }
    feed_.Flush(1000000 + tick * 1000000LL / 60);
  }
  LiveFeed& feed() { return feed_; }

 private:
  int bodies_;
  LiveFeed feed_;
};

TEST(LiveFeed, NineHundredMovingBodiesStayWithinTheBudget) {
  CrowdFeed crowd(450);  // twice: two views of each
  for (int tick = 0; tick < 60; ++tick) crowd.Tick(tick);
  const std::int64_t before = crowd.feed().bytes();
  for (int tick = 60; tick < 660; ++tick) crowd.Tick(tick);
  const double per_s = static_cast<double>(crowd.feed().bytes() - before) / 10;
  RecordProperty("bytes_per_s", static_cast<int>(per_s));
  EXPECT_LT(per_s, 200000);
  EXPECT_GT(per_s, 100000) << "and it is used";
}

TEST(LiveFeed, ASmallRoomIsShownTickByTick) {
  CrowdFeed crowd(10);
  std::uint64_t place = 0;
  const std::string waiting = *crowd.feed().Next(&place);
  EXPECT_EQ(waiting.rfind("retry: 500\nevent: waiting\ndata: ", 0), 0u) << waiting;
  for (int tick = 0; tick < 120; ++tick) crowd.Tick(tick);
  const EventRing::Piece start = crowd.feed().Next(&place);
  EXPECT_EQ(
      start->rfind(
          "retry: 500\nevent: start\ndata: {\"player\":\"\",\"oracle\":\"\",\"data\":\"H4s", 0),
      0u);
  // All ticks after the begin, of both peers, the first of each by itself.
  for (int tick = 120; tick < 180; ++tick) crowd.Tick(tick);
  int frames = 0;
  while (const EventRing::Piece piece = crowd.feed().Next(&place)) {
    if (piece->rfind("event: frames\n", 0) == 0) ++frames;
  }
  EXPECT_GE(frames, 25) << "thirty times a second";
}

TEST(LiveFeed, LinesOfTheRoomAreMarks) {
  CrowdFeed crowd(10);
  std::uint64_t place = 0;
  crowd.feed().Next(&place);
  for (int tick = 0; tick < 60; ++tick) crowd.Tick(tick);
  crowd.feed().Next(&place);
  for (const EventKind kind : {EventKind::kScript, EventKind::kScored, EventKind::kWarning}) {
    Event event;
    event.session = 5;
    event.tick = 50;
    event.kind = static_cast<std::int8_t>(kind);
    event.text = "line " + std::to_string(event.kind);
    event.sequence = event.kind;
    crowd.feed().Add("SEAM.crowd.event.0", Encode(event));
  }
  for (int tick = 60; tick < 70; ++tick) crowd.Tick(tick);
  std::string marks;
  while (const EventRing::Piece piece = crowd.feed().Next(&place)) {
    if (piece->rfind("event: marks\n", 0) == 0) marks += *piece;
  }
  const auto has = [&](const char* kind, EventKind of) {
    const std::string text = "\"text\":\"line " + std::to_string(static_cast<int>(of)) + "\"";
    const std::string name = std::string("\"kind\":\"") + kind + "\"";
    const std::size_t at = marks.find(text);
    return at != std::string::npos && marks.rfind(name, at) != std::string::npos;
  };
  EXPECT_TRUE(has("note", EventKind::kScript)) << marks;
  EXPECT_TRUE(has("note", EventKind::kScored)) << marks;
  EXPECT_TRUE(has("warning", EventKind::kWarning)) << marks;
}

TEST(LiveFeed, AnotherSessionBeginsAnew) {
  CrowdFeed first(10);
  for (int tick = 0; tick < 10; ++tick) first.Tick(tick);
  std::uint64_t place = 0;
  first.feed().Next(&place);
  Room room;
  room.room = "crowd";
  room.session = 6;
  room.protocol = kProtocolVersion;
  room.scene_name = "other";
  room.mode = "strict";
  room.impair = "demo";
  room.tick_hz = 60;
  room.send_hz = 30;
  room.scene_text = synthetic::SceneText();
  first.feed().Add("SEAM.crowd.scene", Encode(room));
  EXPECT_FALSE(first.feed().begun());
  EXPECT_EQ(first.feed().Next(&place)->rfind("retry: 500\nevent: waiting\n", 0), 0u);
}

TEST(LiveFeed, ADamagedTickNumberDoesNotStopIt) {
  CrowdFeed crowd(4);
  for (int tick = 0; tick < 10; ++tick) crowd.Tick(tick);
  View stray;
  stray.session = 5;
  stray.sequence = 5000;
  stray.tick = 1000000000;
  stray.parts = 1;
  EXPECT_FALSE(crowd.feed().Add("SEAM.crowd.view.0", Encode(stray)));
  const std::int64_t before = crowd.feed().bytes();
  for (int tick = 10; tick < 40; ++tick) crowd.Tick(tick);
  EXPECT_GT(crowd.feed().bytes(), before);
}

}  // namespace live_feed_test
}  // namespace seam
