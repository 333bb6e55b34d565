/// A city of anchored bricks under 100 moving bodies: as featherweight bricks, as ordinary static
/// bodies, and not there at all.

#include <malloc.h>
#include <unistd.h>

#include <cstdio>
#include <memory>

#include "common/physics/world.h"
#include "common/scene/bricks.h"
#include "common/topology/feather_store.h"
#include "tests/lab/world/bench.h"

namespace seam {
namespace {

constexpr int kBodiesOnBricks = 100, kCars = 20, kPitch = 20;  // a car: three bodies; pitch in m
constexpr float kRoad = 60;                                    // m: the road over the roofs

/// What rolls on the road and falls on roofs (or on the ground alone), and never rests.
std::string Movers(float left, float right, bool city) {
  std::string text = "bounds = [[-30000, -100], [30000, 1000]]\n[solver]\nsleep = false\n";
  char line[400];
  const float road = city ? kRoad : 0;
  const auto at = [&](int i, int of) {
    return left + 30 + (right - left - 60) * static_cast<float>(i) / static_cast<float>(of);
  };
  for (int i = 0; i < kCars; ++i) {
    const float x = at(i, kCars);
    std::snprintf(line, sizeof line,
                  "[[part]]\nname = \"car%d\"\nbox = [3, 0.8]\nposition = [%g, %g]\n"
                  "velocity = [15, 0]\nfriction = 0.1\n",
                  i, static_cast<double>(x), static_cast<double>(road + 0.9f));
    text += line;
    for (const int end : {-1, 1}) {
      std::snprintf(line, sizeof line,
                    "[[part]]\nname = \"wheel%d-%d\"\ncircle = 0.4\nposition = [%g, %g]\n"
                    "velocity = [15, 0]\nfriction = 0.9\nspin = -37\n",
                    i, 1 + end, static_cast<double>(x + static_cast<float>(end)),
                    static_cast<double>(road + 0.41f));
      text += line;
    }
  }
  for (int i = 0; i < kBodiesOnBricks - 3 * kCars; ++i) {
    std::snprintf(line, sizeof line,
                  "[[part]]\nname = \"ball%d\"\n%s\nposition = [%g, %g]\nrestitution = 0.8\n"
                  "velocity = [%d, 0]\n",
                  i, i % 2 == 0 ? "circle = 0.4" : "box = [0.8, 0.6]",
                  static_cast<double>(at(i, kBodiesOnBricks - 3 * kCars)),
                  static_cast<double>(city ? kRoad - 3 : 3), i % 9 - 4);
    text += line;
  }
  for (int i = 0; i < kCars; ++i) {
    for (const int end : {0, 2}) {
      std::snprintf(line, sizeof line,
                    "[[joint]]\nname = \"axle%d-%d\"\nkind = \"wheel\"\na = \"car%d\"\n"
                    "b = \"wheel%d-%d\"\nfrequency = 5\nmotor = {speed = -37, torque = 20}\n",
                    i, end, i, i, end);
      text += line;
    }
  }
  return text;
}

struct City {
  std::string bricks;         ///< [[bricks]]
  float left = 0, right = 0;  ///< m
};

/// Towers, a street at their feet, and a road over their roofs.
City CityOf(int towers) {
  City city;
  city.right = static_cast<float>(kPitch * towers) / 2;
  city.left = -city.right;
  char text[900];
  std::snprintf(text, sizeof text,
                "[[bricks]]\nname = \"street\"\nbrick = [1, 0.5]\nposition = [%g, -1]\n"
                "count = [%d, 2]\n"
                "[[bricks]]\nname = \"towers\"\nbrick = [0.5, 0.25]\nposition = [%g, 0]\n"
                "towers = {count = %d, pitch = %d, width = [8, 14], height = [24, 56], "
                "windows = true, seed = 1}\n"
                "[[bricks]]\nname = \"road\"\nbrick = [1, 0.5]\nposition = [%g, %g]\n"
                "count = [%d, 1]\n",
                static_cast<double>(city.left), kPitch * towers, static_cast<double>(city.left),
                towers, kPitch, static_cast<double>(city.left), static_cast<double>(kRoad - 0.5f),
                kPitch * towers);
  city.bricks = text;
  return city;
}

std::string Ground(const City& city) {
  char text[200];
  std::snprintf(text, sizeof text, "[[part]]\nname = \"ground\"\nchain = [[%g, 0], [%g, 0]]\n",
                static_cast<double>(city.left), static_cast<double>(city.right));
  return text;
}

/// The same bricks as parts: one static body each.
Scene AsParts(Scene scene) {
  for (const BrickField& field : scene.bricks) {
    EachBrick(field, [&](int x, int y) {
      Part part = BrickPart(field, x, y);
      part.id = static_cast<PartId>(scene.parts.size());
      scene.parts.push_back(std::move(part));
      return true;
    });
  }
  scene.bricks = {};
  return scene;
}

/// Bytes of this process in memory.
double ResidentBytes() {
  malloc_trim(0);
  long pages = 0, resident = 0;
  std::FILE* file = std::fopen("/proc/self/statm", "r");
  if (file == nullptr) return 0;
  const bool read = std::fscanf(file, "%ld %ld", &pages, &resident) == 2;
  std::fclose(file);
  return read ? static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) : 0;
}

/// A world that was made from text or a scene, with what that took.
struct Made {
  std::unique_ptr<World> world;
  double load_s = 0, bytes = 0;
};

Made Make(const std::function<Scene()>& scene) {
  Made made;
  const double before = ResidentBytes(), began = CpuSeconds();
  made.world = std::make_unique<World>(scene());
  made.load_s = CpuSeconds() - began;
  made.bytes = ResidentBytes() - before;
  return made;
}

void Steps(World& world, int ticks) {
  for (int i = 0; i < ticks; ++i) world.Step();
}

}  // namespace

TextTable FeatherweightBench(bool quick) {
  const City city = CityOf(quick ? 18 : 358);
  const int pairs = quick ? 5 : 9, ticks = quick ? 30 : 60;
  const std::string with = Movers(city.left, city.right, true) + city.bricks;
  const std::string without = Movers(city.left, city.right, false) + Ground(city);
  const std::size_t bricks = FeatherStore(ParseScene(with, "city").bricks).size();
  const double each = 1 / static_cast<double>(bricks);

  const Made none = Make([&] { return ParseScene(without, "ground"); });
  const Made feather = Make([&] { return ParseScene(with, "city"); });
  Steps(*none.world, 60);
  const double settled = ResidentBytes();
  Steps(*feather.world, 60);  // now the cells near the movers have fixtures
  const double fixtures = ResidentBytes() - settled;
  const Made parts = Make([&] { return AsParts(ParseScene(with, "city")); });

  const auto step = [&](const Made& made) { return [&] { Steps(*made.world, ticks); }; };
  const auto barrier = [](const Made& made) { return [&] { made.world->Barrier(); }; };
  const double of_feather = CostRatio(step(none), step(feather), pairs);
  const double of_parts = CostRatio(step(none), step(parts), quick ? 3 : 1);
  const double barrier_feather = CostRatio(barrier(none), barrier(feather), pairs);

  TextTable table;
  table.name = "featherweight";
  table.title = std::to_string(bricks) + " anchored bricks under " +
                std::to_string(kBodiesOnBricks) + " moving bodies";
  table.header = {"", "no city", "featherweight", "static bodies"};
  const auto row = [&](const char* name, const std::string& a, double b, double c) {
    table.rows.push_back({name, a, Digits(b), c < 0 ? "–" : Digits(c)});
  };
  row("memory in all, bytes a brick", "–", (feather.bytes + fixtures) * each, parts.bytes * each);
  row("of that the store, bytes a brick", "–",
      static_cast<double>(FeatherStore(feather.world->scene().bricks).bytes()) * each, -1);
  row("load (scene and world), CPU s", Digits(none.load_s), feather.load_s, parts.load_s);
  row("load beside static bodies", "–", feather.load_s / parts.load_s, 1);
  row("a step beside no city", "1", of_feather, of_parts);
  row("a step beside static bodies", "–", of_feather / of_parts, 1);
  row("a barrier beside no city", "1", barrier_feather, -1);
  table.note =
      "Twenty cars (three bodies each) on a road over the roofs, forty boxes and balls that bounce "
      "on the roofs and fall between the towers; nothing sleeps. Without a city the same move on "
      "one chain. Memory is the growth of the process (resident set); the store is counted. Steps "
      "and barriers: median ratio of CPU time, run in turns. A barrier (only rules that go back "
      "make "
      "them) builds the fixtures near the bodies anew: that is its price.";
  table.command = std::string("seam-lab world featherweight") + (quick ? " --quick" : "");
  return table;
}

}  // namespace seam
