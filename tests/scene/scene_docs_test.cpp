/// docs/scenes.md against the loader: its example is a scene, and its tables name every key.

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tests/support/known_keys.h"
#include "tests/support/scripted_world.h"

namespace seam {
namespace scene_docs_test {

std::string Page() {
  std::ifstream in("docs/scenes.md");
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

std::string Example() {
  const std::string page = Page(), begin = "```toml\n";
  const auto from = page.find(begin);
  if (from == std::string::npos) return "";
  const auto start = from + begin.size();
  return page.substr(start, page.find("```", start) - start);
}

TEST(SceneDocs, TheWorkedExampleMatchesItsTitle) {
  ScriptedWorld run(ParseScene(Example(), "seesaw.toml"));
  EXPECT_EQ(run.world.scene().title, "Seesaw: ann drops a weight, bob's crates fly");
  EXPECT_EQ(run.world.body_count(), 5);
  run.StepTo(48);
  const float rest = run.Read("crate.0").position.y();
  float highest = rest;
  while (run.world.tick() < 480) {
    run.Step();
    highest = std::max(highest, run.Read("crate.0").position.y());
  }
  EXPECT_GT(highest, rest + 5);
}

TEST(SceneDocs, EveryKeyIsOnThePage) {
  const std::string page = Page();
  const std::string ball = "[[part]]\nname = \"p\"\ncircle = 1\n";
  const std::pair<std::string, std::string> tables[] = {
      {"", "## Top level"},
      {"[solver]", "## `[solver]`"},
      {"[planner]", "## `[planner]`"},
      {"[[part]]", "## `[[part]]`"},
      {ball + "[[joint]]", "## `[[joint]]`"},
      {ball + "[[bricks]]", "## `[[bricks]]`"},
      {ball + "[[strand]]", "## `[[strand]]`"},
      {ball + "[[thrust]]", "## `[[thrust]]`"},
      {ball + "[[propeller]]", "## `[[propeller]]`"},
      {ball + "[[water]]", "## `[[water]]`"},
      {ball + "[grouping]", "## `[grouping]`"},
      {ball + "[[character]]", "## `[[character]]`"},
      {"[[player]]", "## `[[player]]`"},
      {ball + "[[watch]]", "## `[[watch]]`"},
      {ball + "[[trigger]]", "## `[[trigger]]`"},
      {ball + "[[charges]]", "## `[[charges]]`"},
      {ball + "[[script]]", "## `[[script]]`"},
      {ball + "[[lcm.publish]]", "## `[lcm]`"},
      {ball + "[[lcm.drive]]", "## `[lcm]`"},
      {ball + "[camera]", "## `[camera]`"}};
  for (const auto& [table, heading] : tables) {
    const auto from = page.find(heading + "\n");
    ASSERT_NE(from, std::string::npos) << heading;
    const std::string section = page.substr(from, page.find("\n## ", from + 1) - from);
    const std::vector<std::string> keys = KnownKeys(table);
    EXPECT_GE(keys.size(), 2u) << heading;
    for (const std::string& key : keys) {
      const bool is_table = page.find("[" + key + "]") != std::string::npos;
      EXPECT_TRUE(is_table || section.find("`" + key + "`") != std::string::npos)
          << key << " is missing below " << heading;
    }
  }
}

}  // namespace scene_docs_test
}  // namespace seam
