/// Usual slips of a scene's TOML are named in plain words, with the remedy.

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "common/base/check.h"
#include "common/scene/scene.h"

namespace seam {
namespace toml_hint_test {

/// Returns the loader's message about a part with this line; "" if it loads.
std::string Complaint(const std::string& line) {
  try {
    ParseScene("[[part]]\n" + line + "\nbox = [1, 1]\n", "s.toml");
  } catch (const OperatorError& error) {
    return error.what();
  }
  return "";
}

TEST(TomlHint, NamesTheSlipTheLineAndTheRemedy) {
  const std::pair<const char*, const char*> slips[] = {
      {"name = buggy", "name = buggy: text stands in quotes: \"buggy\""},
      {"name = my-car  # fast", "name = my-car: text stands in quotes: \"my-car\""},
      {"torque = 8,0", "torque = 8,0: a decimal point, not a comma: 8.0"},
      {"density = -12,25", "density = -12,25: a decimal point, not a comma: -12.25"},
      {"name: \"x\"", "name: \"x\": write name = ..., with = and not :"},
      {"anchored = True", "anchored = True: say true or false, in small letters"},
      {"bullet = yes", "bullet = yes: say true or false, in small letters"},
      {"angle = 90deg",
       "angle = 90deg: angles are in radians and have no unit: 180 degrees are "
       "3.1416"},
      {"angle = 180°", "angles are in radians and have no unit"},
      {"spin = 5 rad", "spin = 5 rad: numbers have no unit: 5"},
      {"position = [1m, 2m]", "numbers have no unit: 1"},
      {"position = (1, 2)", "position = (1, 2): square brackets: [1, 2]"},
      {"position = [1; 2]", "a comma between numbers, not a semicolon"},
      {"position = [1 2]", "a comma between numbers, and a decimal point"},
      {"position = [1,5 2]", "a comma between numbers, and a decimal point"},
      {"position [1, 2]", "position [1, 2]: there is no = behind position"},
      {"name = “a”", "quotes are plain ones"},
      {"density = .5", "density = .5: a digit before the point: 0.5"},
      {"density = -.5", "a digit before the point: -0.5"},
      {"density = 5.", "density = 5.: a digit behind the point: 5.0"},
      {"density = 05", "density = 05: no zeros before a number: 5"},
      {"anchored = true false", "one value, and nothing behind it on its line"},
      {"name = \"a\" \"b\"", "one value, and nothing behind it on its line"},
      {"[[part]", "[[part]: a table of a list ends with two brackets"},
      {"[solver", "[solver: a table's name ends with a bracket"},
      {"density =", "density =: there is no value behind ="}};
  for (const auto& [line, words] : slips) {
    const std::string told = Complaint(line);
    EXPECT_EQ(told.rfind("s.toml:2: ", 0), 0u) << told;
    EXPECT_NE(told.find(words), std::string::npos) << line << "\n  " << told;
    EXPECT_EQ(told.find('\n'), std::string::npos) << told;
  }
}

TEST(TomlHint, AnAngleInDegreesIsToldTheUnit) {
  EXPECT_NE(Complaint("name = \"a\"\nangle = 180").find("in radians: 180 degrees are 3.1416"),
            std::string::npos)
      << Complaint("name = \"a\"\nangle = 180");
}

TEST(TomlHint, OtherMistakesKeepTheParsersWords) {
  EXPECT_NE(Complaint("name = \"a\"\nname = \"b\"").find("s.toml:"), std::string::npos);
  EXPECT_NE(Complaint("name = \"a, b: c = d\"").find("must be 1 to 32 letters"), std::string::npos);
  // A line of any length and form is looked at in bounded time.
  EXPECT_NE(Complaint("density = " + std::string(100000, '1') + "x"), "");
  EXPECT_NE(Complaint("position = [" + std::string(390, ' ')), "");
  EXPECT_NE(Complaint(std::string(390, '[')), "");
}

TEST(TomlHint, NamesTheShapeThatAValueHas) {
  const std::string three = Complaint("name = 'a'\nposition = [1, 2, 3]");
  EXPECT_EQ(three, "s.toml:3: part 'a': position must be two numbers [x, y], not an array of 3");
  const std::string one = Complaint("name = 'a'\nbox = [1, 1]\n[water]\nname = 'pool'");
  EXPECT_EQ(one, "s.toml:4: scene: water needs two brackets, [[water]]: there may be several");
}

}  // namespace toml_hint_test
}  // namespace seam
