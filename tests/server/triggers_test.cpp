/// Triggers and the metadata table, as functions of their inputs.

#include "server/rules/triggers.h"

#include <gtest/gtest.h>

#include <map>

#include "common/scene/part_rules.h"
#include "common/sync/metadata.h"

namespace seam {
namespace triggers_test {

/// Parts 0, 1, 2 of players 0, 1 and nobody, on a line.
struct Places {
  std::map<PartId, float> x;

  std::vector<TriggerEvent> Update(Triggers* triggers) const {
    return triggers->Update(
        [this](PartId part) -> std::optional<Vec2> {
          const auto found = x.find(part);
          if (found == x.end()) return std::nullopt;
          return Vec2(found->second, 0);
        },
        [](PartId part) { return part < 2 ? part : -1; });
  }
};

std::string Text(const std::vector<TriggerEvent>& events) {
  std::string text;
  for (const TriggerEvent& e : events) {
    text += (e.entered ? "+" : "-") + std::to_string(e.trigger) + ":" + std::to_string(e.part) +
            "/" + std::to_string(e.player) + " ";
  }
  return text;
}

Trigger At(float x, float width) {
  Trigger trigger;
  trigger.position = {x, 0};
  trigger.size = {width, 1};
  trigger.parts = {0, 1, 2};
  return trigger;
}

TEST(Triggers, ReportEachEntryAndEachExitOnce) {
  Triggers triggers({At(0, 2), At(1, 2)});
  Places places{{{0, -2}, {1, 5}, {2, 5}}};
  EXPECT_EQ(Text(places.Update(&triggers)), "");
  places.x[0] = -1;  // the side belongs to it
  EXPECT_EQ(Text(places.Update(&triggers)), "+0:0/0 ");
  EXPECT_EQ(Text(places.Update(&triggers)), "");
  places.x[0] = 1.5f;
  places.x[2] = 1.0f;
  EXPECT_EQ(Text(places.Update(&triggers)), "-0:0/0 +0:2/-1 +1:0/0 +1:2/-1 ");
  EXPECT_EQ(triggers.inside().size(), 3u);
  places.x.erase(2);  // gone from the world
  EXPECT_EQ(Text(places.Update(&triggers)), "-0:2/-1 -1:2/-1 ");
}

PlayerMask Only(int player) {
  PlayerMask mask;
  mask.Add(player);
  return mask;
}

TEST(Triggers, LookOnlyAtTheirPlayersParts) {
  Trigger of_first = At(0, 10);
  of_first.players = Only(0);
  Trigger of_second = At(0, 10);
  of_second.players = Only(1);
  Triggers triggers({of_first, of_second});
  Places places{{{0, 0}, {1, 0}, {2, 0}}};
  EXPECT_EQ(Text(places.Update(&triggers)), "+0:0/0 +1:1/1 ");
}

TEST(Triggers, FireOnceEvenIfSeveralEnterInTheSameTick) {
  Trigger once = At(0, 10);
  once.once = true;
  Triggers triggers({once});
  Places places{{{0, 0}, {1, 0}, {2, 0}}};
  EXPECT_EQ(Text(places.Update(&triggers)), "+0:0/0 ");
  EXPECT_TRUE(triggers.over(0));
  EXPECT_EQ(Text(places.Update(&triggers)), "-0:0/0 ");
  EXPECT_EQ(Text(places.Update(&triggers)), "");
}

TEST(Triggers, MoveWithTheirPartAndEndWithIt) {
  Trigger carried = At(0.5f, 1);
  carried.part = 2;
  carried.parts = {0};
  Triggers triggers({carried});
  Places places{{{0, 10}, {2, 0}}};
  EXPECT_EQ(Text(places.Update(&triggers)), "");
  places.x[2] = 9.5f;
  EXPECT_EQ(Text(places.Update(&triggers)), "+0:0/0 ");
  places.x.erase(2);
  EXPECT_EQ(Text(places.Update(&triggers)), "-0:0/0 ");
  places.x[2] = 9.5f;
  EXPECT_EQ(Text(places.Update(&triggers)), "");
}

TEST(Metadata, SendsChangesOnceAndEverythingToLatecomers) {
  MetaTable server, early, late;
  for (std::int32_t id = 0; id < 300; ++id) {
    server.Set({kMetaPart, id, kMetaHealth}, static_cast<float>(id) + 0.5f);
  }
  std::vector<Meta> changes = server.TakeChanges(7, 8);
  ASSERT_EQ(changes.size(), 3u) << "at most " << kMetaMax << " in a message";
  EXPECT_EQ(changes[0].tick, 8);
  for (const Meta& meta : changes) early.Apply(meta);
  EXPECT_TRUE(server.TakeChanges(7, 9).empty());
  server.Add({kMetaPlayer, 3, kMetaScore}, 2);
  server.Add({kMetaPlayer, 3, kMetaScore}, -5);
  server.Set({kMetaPart, 17, kMetaHealth}, 0);
  server.Set({kMetaPart, 18, kMetaHealth}, 18.5f);  // as it was
  changes = server.TakeChanges(7, 9);
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0].id, (std::vector<std::int32_t>{17, 3}));
  EXPECT_EQ(changes[0].value, (std::vector<float>{0, -3}));
  early.Apply(changes[0]);
  for (const Meta& meta : server.Export(7, 9)) late.Apply(meta);
  EXPECT_EQ(early.values(), server.values());
  EXPECT_EQ(late.values(), server.values());
  EXPECT_EQ(server.Get({kMetaPlayer, 4, kMetaScore}), 0);
}

}  // namespace triggers_test
}  // namespace seam
