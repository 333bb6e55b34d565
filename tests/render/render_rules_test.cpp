/// The server's decisions in pictures: triggers until taken, health, scores.

#include "common/scene/part_rules.h"
#include "tests/support/render_fixture.h"

namespace seam {
namespace render_rules_test {

constexpr double kTick = 60;
constexpr PartId kHurt = 2;

Recording WithMeta(std::int8_t kind, std::int32_t id, std::int8_t key, float value) {
  Recording recording = synthetic::MakeRecording(0);
  Meta meta;
  meta.tick = 30;
  meta.kind = {kind};
  meta.id = {id};
  meta.key = {key};
  meta.value = {value};
  recording.meta.push_back(meta);
  return recording;
}

Image Drawn(const Recording& recording, const Scene& scene, double tick, Viewport* viewport) {
  return RenderedWorld(Playback(recording, scene, synthetic::MakeOracle()), tick, viewport);
}

TEST(DrawRules, AHealthBarIsAsFullAsThePartIsWell) {
  Scene scene = synthetic::MakeScene();
  PartRules rules;
  rules.health = 100;
  scene.parts[kHurt].rules.Set(rules);
  const Recording hurt = WithMeta(kMetaPart, kHurt, kMetaHealth, 25);
  Viewport viewport;
  const Image well = Drawn(hurt, scene, 20, &viewport);  // before it was hurt
  const Image ill = Drawn(hurt, scene, kTick, &viewport);
  const auto filled = [&](const Image& image, double tick) {
    const Vec2 at = viewport.ToPx(synthetic::Truth(kHurt, tick).position);
    int columns = 0;  // of the bar's middle row that are neither pale nor grey
    for (int x = -11; x <= 11; ++x) {
      const Colour c = PixelAt(image, at + Vec2(static_cast<float>(x), -10));
      if (std::abs(c.r - c.g) > 60) ++columns;
    }
    return columns;
  };
  EXPECT_GT(filled(well, 20), 3 * filled(ill, kTick));
  EXPECT_GT(filled(ill, kTick), 0);
}

TEST(DrawRules, ATriggerIsDrawnUntilItIsTaken) {
  const Scene bare = synthetic::MakeScene();
  Scene scene = bare;
  Trigger trigger;
  trigger.name = "coin";
  trigger.kind = TriggerKind::kPickup;
  trigger.part = kHurt;
  trigger.size = {2, 2};
  scene.triggers.push_back(trigger);
  const Recording taken = WithMeta(kMetaPart, kHurt, kMetaTaken, 1);
  Viewport viewport;
  EXPECT_GT(Differences(Drawn(taken, scene, 20, &viewport), Drawn(taken, bare, 20, &viewport)), 50);
  EXPECT_EQ(
      Differences(Drawn(taken, scene, kTick, &viewport), Drawn(taken, bare, kTick, &viewport)), 0);
}

TEST(DrawRules, ScoresAppearOnceTheyAreKnown) {
  const Scene scene = synthetic::MakeScene();
  const Recording scored = WithMeta(kMetaPlayer, 0, kMetaScore, 7);
  const Recording none = synthetic::MakeRecording(0);
  Viewport viewport;
  EXPECT_EQ(Differences(Drawn(scored, scene, 20, &viewport), Drawn(none, scene, 20, &viewport)), 0);
  EXPECT_GT(
      Differences(Drawn(scored, scene, kTick, &viewport), Drawn(none, scene, kTick, &viewport)),
      50);
}

}  // namespace render_rules_test
}  // namespace seam
