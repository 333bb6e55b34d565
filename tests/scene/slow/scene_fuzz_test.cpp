/// Damaged and random scenes: each either is refused with an OperatorError or can be simulated.
/// Box2D's assertions abort the process, so that a scene that should have been refused shows.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "common/base/check.h"
#include "common/base/random.h"
#include "common/physics/world.h"
#include "tests/support/soak.h"

namespace seam {
namespace scene_fuzz_test {

const char* const kShipped[] = {"crossing", "wall", "stack", "cradle", "relay"};

std::string ReadText(const std::string& name) {
  std::ifstream in("scenes/" + name + ".toml", std::ios::binary);
  EXPECT_TRUE(in.good()) << name;
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// True when the text is a scene; then it is also simulated for `ticks`.
bool Survives(const std::string& text, int ticks) {
  try {
    const Scene scene = ParseScene(text, "fuzz.toml");
    World world(scene);
    for (int i = 0; i < ticks; ++i) world.Step();
    for (int body = 0; body < world.body_count(); ++body) {
      EXPECT_TRUE(world.Read(body).position.allFinite()) << text;
    }
    return true;
  } catch (const OperatorError& e) {
    const std::string what = e.what();
    EXPECT_EQ(what.rfind("fuzz.toml:", 0), 0u) << what;
    EXPECT_EQ(what.find_first_of("\n\r\x1b"), std::string::npos) << what;
    return false;
  }
}

TEST(SceneFuzz, DeletingAnyLineIsRefusedOrHarmless) {
  int good = 0, bad = 0;
  for (const char* name : kShipped) {
    const std::string text = ReadText(name);
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = text.find('\n', at) + 1;
      (Survives(text.substr(0, at) + text.substr(end), 3) ? good : bad) += 1;
      at = end;
    }
  }
  EXPECT_GT(good, 20);
  EXPECT_GT(bad, 20);
}

TEST(SceneFuzz, RandomBytesAreRefusedOrHarmless) {
  constexpr std::uint64_t kSeed = 20240611;
  RecordProperty("seed", std::to_string(kSeed));
  Random random(kSeed);
  const std::string favourites = "0123456789.-+eE[]{}\"'=#,\n\\ntfx_";
  int good = 0, bad = 0;
  for (const char* name : kShipped) {
    const std::string text = ReadText(name);
    for (int round = 0; round < Soak(1500); ++round) {
      std::string damaged = text;
      const auto edits = 1 + random.Next() % 4;
      for (std::uint64_t i = 0; i < edits && !damaged.empty(); ++i) {
        const std::size_t at = random.Next() % damaged.size();
        const std::uint64_t kind = random.Next() % 4;
        const char byte = random.Chance(0.7) ? favourites[random.Next() % favourites.size()]
                                             : static_cast<char>(random.Next() & 0xff);
        if (kind == 0)
          damaged.erase(at, 1 + random.Next() % 30);
        else if (kind == 1)
          damaged.insert(at, 1, byte);
        else
          damaged[at] = byte;
      }
      (Survives(damaged, 1) ? good : bad) += 1;
    }
  }
  EXPECT_GT(good, 100);
  EXPECT_GT(bad, 1000);
}

std::string Text(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

std::string Pair(double x, double y) { return "[" + Text(x) + ", " + Text(y) + "]"; }

/// A length from a little below the least allowed to the greatest, as often small as large, m.
double RandomSize(Random* random) { return std::exp(random->Uniform(std::log(0.048), 2.3)); }

std::string RandomPoint(Random* random) {
  return Pair(random->Uniform(-2, 2), random->Chance(0.2) ? 0 : random->Uniform(-2, 2));
}

/// A shape at the allowed limits: thin, small, of many points that nearly meet.
std::string RandomShape(Random* random) {
  const double width = RandomSize(random), height = RandomSize(random);
  if (random->Chance(0.3)) return "box = " + Pair(width, height) + "\n";
  if (random->Chance(0.3)) return "circle = " + Text(width / 2) + "\n";
  std::string points;
  const bool polygon = random->Chance(0.7);
  const auto count = static_cast<int>(3 + random->Next() % 6);
  const double turn = random->Uniform(0, 6.3);
  for (int i = 0; i < count; ++i) {
    const double angle = turn + (i + random->Uniform(-0.4, 0.4)) * 6.2831853 / count;
    const std::string point = Pair(width / 2 * std::cos(angle), height / 2 * std::sin(angle));
    points += (i > 0 ? ", " : "") + (polygon ? point : RandomPoint(random));
  }
  return (polygon ? "polygon = [" : "chain = [") + points + "]\n";
}

/// Three parts of random shapes and places, mostly overlapping, and a joint between two of them.
std::string RandomScene(Random* random) {
  std::string text;
  for (int i = 0; i < 3; ++i) {
    const std::string shape = RandomShape(random);
    const bool chain = shape[1] == 'h';
    text += "[[part]]\nname = \"p" + std::to_string(i) + "\"\n" + shape;
    text += "position = " + RandomPoint(random) + "\n";
    text += "angle = " + Text(random->Uniform(-4, 4)) + "\n";
    if (random->Chance(0.2)) text += "density = " + Text(random->Chance(0.5) ? 0.01 : 100) + "\n";
    if (random->Chance(0.2)) text += "bullet = true\n";
    if (chain || random->Chance(0.2)) continue;
    text += "velocity = " + RandomPoint(random) + "\n";
  }
  static const char* const kKinds[] = {"weld", "revolute", "wheel", "distance"};
  const auto kind = random->Next() % 4;
  text += std::string("[[joint]]\nname = \"j\"\nkind = \"") + kKinds[kind] + "\"\n";
  text += "a = \"p0\"\nb = \"p1\"\n";
  const double lower = random->Uniform(-2, 0), upper = random->Uniform(-0.1, 2);
  if (kind == 1) text += "limits = " + Pair(lower, upper) + "\n";
  if (kind == 2) text += "axis = " + RandomPoint(random) + "\n";
  if (kind > 1 && random->Chance(0.5)) text += "frequency = " + Text(random->Uniform(0, 60)) + "\n";
  if (kind == 3) text += "length = " + Text(RandomSize(random)) + "\n";
  if ((kind == 1 || kind == 2) && random->Chance(0.5)) {
    text += "motor = {speed = " + Text(random->Uniform(-1000, 1000)) + ", torque = 1e7}\n";
  }
  return text;
}

TEST(SceneFuzz, RandomScenesThatPassNeverMakeBox2DAbort) {
  constexpr std::uint64_t kSeed = 77;
  RecordProperty("seed", std::to_string(kSeed));
  Random random(kSeed);
  int good = 0;
  for (int round = 0; round < Soak(6000); ++round)
    good += Survives(RandomScene(&random), 20) ? 1 : 0;
  EXPECT_GT(good, 1000);
}

}  // namespace scene_fuzz_test
}  // namespace seam
