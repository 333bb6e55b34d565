/// Cost and error of the ways to find buoyancy.

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "common/base/geometry.h"
#include "common/measure/energy.h"
#include "common/physics/world.h"
#include "tests/lab/world/bench.h"

namespace seam {
namespace {

struct Method {
  const char* name;
  const char* lines;  // of [[water]]
};
constexpr Method kMethods[] = {{"exact", ""},
                               {"voxel4", "method = \"voxel4\"\n"},
                               {"voxel 4 x 4", "method = \"voxel\"\nn = 4\n"},
                               {"voxel 8 x 8", "method = \"voxel\"\nn = 8\n"},
                               {"voxel 16 x 16", "method = \"voxel\"\nn = 16\n"}};

constexpr const char* kNoDrag = "drag_normal = 0\ndrag_tangent = 0\nviscosity = 0\n";
constexpr const char* kSettling = "drag_normal = 1\nviscosity = 2\n";

std::unique_ptr<World> Sea(const std::string& parts, const std::string& water, int tick_hz) {
  return std::make_unique<World>(
      ParseScene("[solver]\nsleep = false\ntick_hz = " + std::to_string(tick_hz) + "\n" + parts +
                     "[[water]]\nname = \"sea\"\nbox = [1000, 50]\nposition = [0, -25]\n" + water,
                 "water.toml"));
}

std::string Thing(const std::string& rest) { return "[[part]]\nname = \"p\"\n" + rest + "\n"; }

void Run(World* world, double seconds) {
  const auto ticks = static_cast<int>(std::lround(seconds / static_cast<double>(world->dt())));
  for (int i = 0; i < ticks; ++i) world->Step();
}

BodyState Settled(const std::string& thing, const Method& method, double seconds) {
  const auto world = Sea(Thing(thing), std::string(method.lines) + kSettling, 240);
  Run(world.get(), seconds);
  return world->Read(0);
}

/// Angle of a square's side with the level, degrees, 0..45, where it settles.
double Lean(double density, double start, const Method& method, double seconds) {
  const BodyState rest = Settled(
      "box = [1, 1]\ndensity = " + std::to_string(density) + "\nangle = " + std::to_string(start),
      method, seconds);
  return std::fabs(std::remainder(static_cast<double>(rest.angle), kPi / 2)) * 180 / kPi;
}

/// Of a thing that is let go 2 cm above its rest, s; 0 if it does not come back.
double BobbingPeriod(const std::string& thing, const Method& method) {
  const auto world = Sea(Thing(thing), std::string(method.lines) + kNoDrag, 240);
  const double dt = static_cast<double>(world->dt());
  double before = 1, first = -1, last = -1;
  int periods = 0;
  for (int i = 0; i * dt < 20; ++i) {
    world->Step();
    const double now = static_cast<double>(world->Read(0).velocity.y());
    if (before < 0 && now >= 0) {
      const double at = (i + before / (before - now)) * dt;
      if (first < 0)
        first = at;
      else
        ++periods;
      last = at;
    }
    before = now;
  }
  return periods == 0 ? 0 : (last - first) / periods;
}

/// Greatest change of the energy of a square that bobs and rocks for 20 s without any drag, as a
/// share of what it began with above its rest.
double EnergyDrift(const Method& method) {
  const std::string thing = "box = [1, 1]\ndensity = 0.5\nangle = 0.3\nposition = [0, 0.2]";
  const auto world = Sea(Thing(thing), std::string(method.lines) + kNoDrag, 240);
  const auto rest = Sea(Thing(thing), kSettling, 240);
  Run(rest.get(), 60);
  const EnergyMeter meter(world->scene(), world->composition());
  const double start = meter.Of({world->Read(0)});
  const double scale = start - meter.Of({rest->Read(0)});
  double worst = 0;
  for (int i = 0; i < 20 * 240; ++i) {
    world->Step();
    worst = std::max(worst, std::fabs(meter.Of({world->Read(0)}) - start) / scale);
  }
  return worst;
}

/// Rows of `welded` boxes each, apart from one another.
std::string Rows(int things, int welded) {
  std::string parts;
  for (int i = 0; i < things; ++i) {
    const std::string name = "b" + std::to_string(i), n = std::to_string(welded);
    const std::string x = std::to_string((i - things / 2) * (welded * 0.5 + 0.7));
    parts += "[[part]]\nname = \"" + name + "\"\nbox = [0.5, 0.5]\ndensity = 0.5\nposition = [" +
             x + ", 0.1]\nrepeat = {count = " + n + ", step = [0.5, 0]}\n";
    if (welded == 1) continue;
    parts += "[[joint]]\nname = \"j" + name + "\"\nkind = \"weld\"\na = \"" + name +
             ".0\"\nb = \"" + name + ".1\"\nrepeat = {count = " + std::to_string(welded - 1) +
             ", step = [0.5, 0]}\n";
  }
  return parts;
}

/// What a step of rows of boxes that bob apart costs beside one of the same rows without water or
/// gravity.
double Cost(const Method& method, const char* drag, int things, int welded, bool quick) {
  const std::string parts = Rows(things, welded);
  const std::unique_ptr<World> wet = Sea(parts, std::string(method.lines) + drag, 60);
  World dry(ParseScene("gravity = [0, 0]\n[solver]\nsleep = false\n" + parts, "dry.toml"));
  const auto steps = [quick](World* world) {
    return [world, quick] {
      for (int i = 0; i < (quick ? 20 : 200); ++i) world->Step();
    };
  };
  return CostRatio(steps(&dry), steps(wet.get()), quick ? 3 : 15);
}

std::string Off(double value, double truth) { return Digits(std::fabs(value - truth)); }

std::vector<std::string> Row(const Method& method, bool quick) {
  const double settle = quick ? 10 : 40;
  const auto draught = [&](const char* thing, double rest) {
    return Off(static_cast<double>(Settled(thing, method, settle).position.y()), rest);
  };
  // A segment of half an angle of 60 degrees is this share of a disc, and as deep as half a radius.
  const std::string disc =
      "circle = 1\ndensity = " + std::to_string((kPi / 3 - std::sin(kPi / 3) / 2) / kPi);
  // A square on its corner with the density s has the depth sqrt(s).
  const double corner = std::sqrt(0.5) - std::sqrt(0.3);
  const double bob = 2 * kPi * std::sqrt(0.25 * 0.6 / 10);
  return {
      method.name,
      draught("box = [2, 1]\ndensity = 0.25", 0.25),
      draught("box = [8, 0.6]\ndensity = 0.25", 0.15),
      draught("box = [1, 1]\ndensity = 0.3\nangle = 0.785398163", corner),
      draught(disc.c_str(), 0.5),
      Off(Lean(0.23, 0.3, method, quick ? 10 : 60), 19.49),
      Off(Lean(0.5, 0.3, method, quick ? 10 : 60), 45),
      Digits(BobbingPeriod("box = [8, 0.6]\ndensity = 0.25\nposition = [0, 0.17]", method) / bob -
             1),
      Digits(EnergyDrift(method)),
      Digits(Cost(method, kNoDrag, quick ? 50 : 300, 1, quick)),
      Digits(Cost(method, "", quick ? 50 : 300, 1, quick)),
      Digits(Cost(method, "", quick ? 2 : 10, 40, quick))};
}

}  // namespace

TextTable WaterBench(bool quick) {
  TextTable table;
  table.name = "water";
  table.title = "Buoyancy: what each way costs and how wrong it is";
  table.header = {"method",
                  "draught: box (m)",
                  "hull 8 x 0.6 (m)",
                  "square on its corner (m)",
                  "disc (m)",
                  "lean at s = 0.23 (deg)",
                  "lean at s = 0.5 (deg)",
                  "bobbing period",
                  "energy drift",
                  "cost: boxes, no drag",
                  "boxes, with drag",
                  "rows of 40 welded boxes, with drag"};
  for (const Method& method : kMethods) table.rows.push_back(Row(method, quick));
  table.note =
      "Errors against Archimedes, the stability of floating squares and T = 2 pi sqrt(draught/g), "
      "after settling at 240 Hz (the period as a share). Energy drift: of a square that bobs and "
      "rocks without drag for 20 s. Costs: CPU of whole steps beside those of the same things "
      "without water or gravity. A cell is under water by the share of its height below the level "
      "and has its middle as centre of lift: so a tilted thing rights itself too weakly. voxel4 is "
      "2 x 2 cells of the whole thing's box, however many parts it has. Drag goes by wet edges and "
      "is the same for all.";
  table.command = std::string("seam-lab world water") + (quick ? " --quick" : "");
  return table;
}

}  // namespace seam
