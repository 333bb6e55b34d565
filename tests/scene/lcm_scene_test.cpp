/// [lcm] of a scene: what it says, and one line for each mistake.

#include <gtest/gtest.h>

#include "common/base/check.h"
#include "common/scene/lcm/lcm_tables.h"
#include "common/scene/scene.h"

namespace seam {
namespace lcm_scene_test {

/// Lines 1 to 9 of a good scene; `more` begins on line 10.
Scene Load(const std::string& more, const std::string& script = "script = 'x = 1'") {
  return ParseScene(script + R"(
[[player]]
name = "ann"
[[part]]
name = "crate"
box = [1, 1]
position = [0, 2]
repeat = {count = 2, step = [2, 0]}

)" + more,
                    "s.toml");
}

std::string Complaint(const std::string& more, const std::string& script = "script = 'x = 1'") {
  try {
    Load(more, script);
    return "";
  } catch (const OperatorError& error) {
    return error.what();
  }
}

TEST(LcmScene, SaysItsChannels) {
  const Scene scene = Load(
      "[[lcm.publish]]\nchannel = \"POSE\"\nparts = \"crate.*\"\n"
      "[[lcm.publish]]\nchannel = \"a/b.c-d_1\"\nparts = [\"crate.1\"]\nplayer = \"ann\"\n"
      "rate_hz = 0.5\n"
      "[[lcm.drive]]\nchannel = \"DRIVE\"\nplayer = \"ann\"\n"
      "[[lcm.message]]\nchannel = \"M\"\n");
  const LcmTables& lcm = *scene.lcm;
  ASSERT_EQ(lcm.publish.size(), 2u);
  EXPECT_EQ(lcm.publish[0].channel, "POSE");
  EXPECT_EQ(lcm.publish[0].parts, (std::vector<PartId>{0, 1}));
  EXPECT_EQ(lcm.publish[0].player, -1);
  EXPECT_EQ(lcm.publish[0].rate_hz, 60) << "each tick";
  EXPECT_EQ(lcm.publish[1].player, 0);
  EXPECT_EQ(lcm.publish[1].rate_hz, 0.5);
  ASSERT_EQ(lcm.drive.size(), 1u);
  EXPECT_EQ(lcm.drive[0].player, 0);
  EXPECT_EQ(lcm.message, (std::vector<std::string>{"M"}));
  EXPECT_TRUE(Load("").lcm->publish.empty());
}

TEST(LcmScene, EachMistakeIsALineWithItsCure) {
  const std::string publish = "[[lcm.publish]]\n", parts = "parts = \"crate.0\"\n";
  const std::pair<std::string, const char*> mistakes[] = {
      {publish + parts, "s.toml:10: lcm.publish: channel is missing"},
      {publish + "channel = \"\"\n" + parts,
       "s.toml:11: lcm.publish: channel must be 1 to 63 letters, digits or _ - . /"},
      {publish + "channel = \"a*\"\n" + parts,
       "s.toml:11: lcm.publish: channel must be 1 to 63 letters, digits or _ - . /"},
      {publish + "channel = \"" + std::string(64, 'a') + "\"\n" + parts,
       "s.toml:11: lcm.publish: channel must be 1 to 63 letters, digits or _ - . /"},
      {publish + "channel = \"SEAM.main.view.0\"\n" + parts,
       "s.toml:11: lcm.publish: channel 'SEAM.main.view.0' is used by the rooms themselves: choose "
       "another name"},
      {publish + "channel = \"LCM_SELF_TEST\"\n" + parts,
       "s.toml:11: lcm.publish: channel 'LCM_SELF_TEST' is used by LCM itself: choose another "
       "name"},
      {publish + "channel = \"A\"\n", "s.toml:10: lcm.publish: needs parts"},
      {publish + "channel = \"A\"\nparts = \"create.0\"\n",
       "s.toml:12: lcm.publish: parts: there is no part 'create.0'"},
      {publish + "channel = \"A\"\nparts = [\"crate.*\", \"crate.1\"]\n",
       "s.toml:12: lcm.publish: parts: 'crate.1' names a part twice"},
      {publish + "channel = \"A\"\n" + parts + "rate_hz = 0\n",
       "s.toml:13: lcm.publish: rate_hz must be"},
      {publish + "channel = \"A\"\n" + parts + "rate_hz = 61\n",
       "s.toml:13: lcm.publish: rate_hz is above the scene's 60 ticks per second (tick_hz)"},
      {publish + "channel = \"A\"\n" + parts + "player = \"bob\"\n",
       "s.toml:13: lcm.publish: player: there is no player 'bob'"},
      {publish + "chanel = \"A\"\n", "s.toml:11: lcm.publish: unknown key 'chanel'"},
      {publish + "channel = \"A\"\n" + parts + "[[lcm.drive]]\nchannel = \"A\"\nplayer = \"ann\"\n",
       "s.toml:14: lcm.drive: channel 'A' is used by another table of [lcm]: each has its own"},
      {"[[lcm.drive]]\nchannel = \"A\"\n", "s.toml:10: lcm.drive: player is missing"},
      {"[[lcm.drive]]\nchannel = \"A\"\nplayer = \"ann\"\n[[lcm.drive]]\nchannel = \"B\"\n"
       "player = \"ann\"\n",
       "s.toml:15: lcm.drive: player 'ann' is driven by channel 'A' already"},
      {"[lcm]\npublsh = 1\n", "s.toml:11: lcm: unknown key 'publsh'"}};
  for (const auto& [more, says] : mistakes) {
    EXPECT_EQ(Complaint(more).rfind(says, 0), 0u) << more << "gives " << Complaint(more);
  }
  EXPECT_EQ(Complaint("[[lcm.message]]\nchannel = \"M\"\n", ""),
            "s.toml:10: lcm.message: the scene has no script to get the messages");
}

}  // namespace lcm_scene_test
}  // namespace seam
