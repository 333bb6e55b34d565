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

TEST(TomlHint, NamesTheSlipInInlineTablesAndArrays) {
  const std::pair<const char*, const char*> slips[] = {
      {"motor = {player: \"ann\", speed = -22}", "write player = ..., with = and not :"},
      {"motor = {player = \"a: b\", speed = fast, torque = 1}", "text stands in quotes: \"fast\""},
      {"motor = {speed = -22 torque = 12}", "a comma goes before torque"},
      {"motor = {speed = -22; torque = 12}", "a comma between members, not a semicolon"},
      {"motor = {speed = 1,5, torque = 12}", "a decimal point, not a comma"},
      {"motor = {speed = True, torque = 12}", "say true or false, in small letters"},
      {"motor = {speed = 5m/s}", "numbers have no unit: 5"},
      {"motor = {speed 5}", "there is no = behind speed"},
      {"owners = [\"ann\", bob]", "text stands in quotes: \"bob\""},
      {"repeat = {count = 2, step = [1 0]}", "a comma between numbers, and a decimal point"},
      {"density = 2;", "no semicolon at a line's end"},
      {"position = [\xe2\x88\x92 3, 0.5]", "a minus is the plain one: -"},
      {"angle = \xe2\x80\x93 3", "a minus is the plain one: -"},
      {"angle = 1 density = 2", "density goes on a line of its own"},
      {"motor = {player = \"ann\",\n speed = 3}", "a table in { } stands on one line"},
      {"position = [1, 2\nangle = 1", "position = [1, 2: its [ is not closed"},
      {"position = [\n 1, 2\n[[part]]", "position = [: its [ is not closed"}};
  for (const auto& [line, words] : slips) {
    const std::string told = Complaint(line);
    EXPECT_EQ(told.rfind("s.toml:2: ", 0), 0u) << line << "\n  " << told;
    EXPECT_NE(told.find(words), std::string::npos) << line << "\n  " << told;
  }
}

TEST(TomlHint, NamesATableWithTooFewBracketsOrTwice) {
  const std::string part = Complaint("name = \"a\"\nbox = [1, 1]\n[part]\nname = \"b\"");
  EXPECT_EQ(part, "s.toml:4: [part]: needs two brackets, [[part]]: there may be several");
  const std::string twice =
      Complaint("name = \"a\"\nbox = [1, 1]\n[solver]\n[camera]\n[solver]\nname = \"b\"");
  EXPECT_EQ(twice, "s.toml:6: [solver]: there is another on line 4");
}

TEST(TomlHint, AKeyOfTheFileBehindATableIsSentAboveTheFirst) {
  const std::string told = Complaint("name = \"a\"\ngravity = [0, -5]");
  EXPECT_EQ(told, "s.toml:3: part: unknown key 'gravity': it belongs above the first table");
}

TEST(TomlHint, NamesTheNameThatWasMeant) {
  const std::string player = "[[player]]\nname = \"anna\"\n";
  const auto complaint = [&](const std::string& more) {
    return Complaint("name = \"chassis\"\nbox = [1, 1]\n" + player +
                     "[[trigger]]\nname = \"goal\"\nposition = [0, 0]\nbox = [1, 1]\n" + more +
                     "[[part]]\nname = \"last\"");
  };
  EXPECT_NE(complaint("for = \"chasis\"\n").find("no part 'chasis' (did you mean 'chassis'?)"),
            std::string::npos)
      << complaint("for = \"chasis\"\n");
  EXPECT_NE(complaint("players = [\"Anna\"]\n").find("no player 'Anna' (did you mean 'anna'?)"),
            std::string::npos)
      << complaint("players = [\"Anna\"]\n");
  EXPECT_NE(complaint("for = \"last\"\n[[charges]]\nname = \"c\"\npart = \"last\"\nradius = "
                      "2\nimpulse = 1\ntrigger = \"gaol\"\n")
                .find("no trigger 'gaol' (did you mean 'goal'?)"),
            std::string::npos)
      << complaint(
             "for = \"last\"\n[[charges]]\nname = \"c\"\npart = \"last\"\nradius = 2\nimpulse = "
             "1\ntrigger = \"gaol\"\n");
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
