/// Settings that an operator changes: as they come, and from when on they act.

#include "common/sync/settings/live_settings.h"

#include <gtest/gtest.h>

#include <limits>

namespace seam {
namespace live_settings_test {

constexpr int kHz = 60;

Meta Told(std::int64_t tick, std::int32_t player, std::int8_t key, float value) {
  Meta meta;
  meta.tick = tick;
  meta.kind = {kMetaPlayer};
  meta.id = {player};
  meta.key = {key};
  meta.value = {value};
  return meta;
}

TEST(LiveSettings, ActHalfASecondAfterTheirMessage) {
  PlayerSettings settings;
  EXPECT_FALSE(settings.At(kMetaInputDelay, 1000));
  settings.Take(Told(100, 2, kMetaInputDelay, 4), 2, kHz);
  settings.Take(Told(110, 2, kMetaInputDelay, 7), 2, kHz);
  EXPECT_FALSE(settings.At(kMetaInputDelay, 129));
  EXPECT_EQ(settings.At(kMetaInputDelay, 130), 4);
  EXPECT_EQ(settings.At(kMetaInputDelay, 139), 4);
  EXPECT_EQ(settings.At(kMetaInputDelay, 140), 7);
  EXPECT_FALSE(settings.At(kMetaShowAge, 140)) << "another setting";
  settings.Forget(135);
  EXPECT_EQ(settings.At(kMetaInputDelay, 135), 4) << "the next does not act yet";
  settings.Forget(140);
  EXPECT_FALSE(settings.At(kMetaInputDelay, 139)) << "it has been replaced";
  EXPECT_EQ(settings.At(kMetaInputDelay, 140), 7);
}

TEST(LiveSettings, AreOfOnePlayerAndInRange) {
  PlayerSettings settings;
  settings.Take(Told(0, 1, kMetaShowAge, 5), 2, kHz);
  for (const float wrong : {-1.0f, 31.0f, 2.5f, std::numeric_limits<float>::infinity(), 1e30f}) {
    settings.Take(Told(0, 2, kMetaShowAge, wrong), 2, kHz);
  }
  settings.Take(Told(0, 2, kMetaScore, 3), 2, kHz);
  Meta part = Told(0, 2, kMetaShowAge, 5);
  part.kind = {kMetaPart};
  settings.Take(part, 2, kHz);
  EXPECT_FALSE(HoldsSettings(part));
  EXPECT_FALSE(HoldsSettings(Told(0, 2, kMetaScore, 3)));
  EXPECT_TRUE(HoldsSettings(Told(0, 2, kMetaShowAge, 3)));
  EXPECT_FALSE(settings.At(kMetaShowAge, 1000));
  settings.Take(Told(0, 2, kMetaShowAge, 30), 2, kHz);
  EXPECT_EQ(settings.At(kMetaShowAge, 1000), 30);
}

TEST(LiveSettings, AFloodOfThemIsForgotten) {
  PlayerSettings settings;
  for (int i = 0; i < 10000; ++i) {
    settings.Take(Told(1000000 + i, 0, kMetaShowAge, static_cast<float>(i % 31)), 0, kHz);
    settings.Forget(10);
  }
  int known = 0;
  for (std::int64_t tick = 1000000; tick < 1020000; ++tick) {
    known += settings.At(kMetaShowAge, tick) != settings.At(kMetaShowAge, tick - 1) ? 1 : 0;
  }
  EXPECT_LE(known, static_cast<int>(PlayerSettings::kPendingMax));
  EXPECT_EQ(settings.At(kMetaShowAge, 2000000), 9999 % 31) << "the newest counts";
}

}  // namespace live_settings_test
}  // namespace seam
