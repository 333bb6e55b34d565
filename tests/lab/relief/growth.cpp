/// How the server's bytes and CPU grow with players.

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/lab/load/load.h"
#include "tests/lab/relief/bar_rows.h"
#include "tests/lab/relief/benches.h"
#include "tests/lab/relief/relief_scene.h"

namespace seam {
namespace {

struct Point {
  int players = 0;
  SessionLoad load;
  double bytes() const { return load.to_client_kbps * players; }
};

Point MeasureAt(ReliefRoom room, int players, double seconds) {
  room.players = players;
  room.sleep = true;
  ClusterConfig config;
  config.scene = "relief";
  config.scene_text = ReliefText(room);
  config.mode = "buffer";
  config.drive = Drive::kBot;
  config.publish = Publish::kNone;
  config.duration_s = seconds;
  return {players, MeasureLoad(config)};
}

/// Of y = a N^k, by least squares of the logarithms.
double Exponent(const std::vector<Point>& points, double (*of)(const Point&)) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const Point& point : points) {
    const double x = std::log(point.players), y = std::log(of(point));
    n += 1;
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

void AddRow(const std::string& name, const std::vector<Point>& points, bool bar,
            std::vector<BarRow>* rows) {
  const auto add = [&](const std::string& what, double (*of)(const Point&),
                       const std::string& unit) {
    std::string each;
    double held = 1;
    for (const Point& point : points) {
      each += fmt::format("{}{}: {}", each.empty() ? "" : ", ", point.players, Digits(of(point)));
      held = std::min(held, point.load.held_share);
    }
    const double exponent = Exponent(points, of);
    const std::string detail = each + " " + unit;
    const std::string figure = name + ": " + what + " grow as N to the power of";
    BarRow row = bar ? AtMost(figure, exponent, 1.2, "", detail)
                     : Printed(figure, Digits(exponent) + " (" + detail + ")");
    row.given = fmt::format("clients hold {:.0f} % (≥ 80)", 100 * held);
    row.valid = held >= 0.8;
    rows->push_back(row);
  };
  add(
      "the server's bytes", [](const Point& p) { return p.bytes(); }, "kB/s");
  add(
      "the server's µs a tick", [](const Point& p) { return p.load.server_us; }, "µs");
}

}  // namespace

TextTable ReliefGrowthBench(bool quick) {
  const double seconds = quick ? 2 : 4;
  const std::vector<int> counts =
      quick ? std::vector<int>{4, 8, 16} : std::vector<int>{8, 16, 32, 64, 128, 256};
  const std::vector<int> many =
      quick ? std::vector<int>{8, 16} : std::vector<int>{32, 64, 128, 256, 512, 1000};
  std::vector<BarRow> rows;
  std::vector<Point> spread, crowded, large;
  ReliefRoom room, crowd, plains;
  room.each = crowd.each = 15;
  crowd.spacing = 9;
  plains.each = 2;
  plains.spacing = 20;
  plains.plains = 4;
  plains.things = ReliefThings::kBalls;
  for (const int players : counts) spread.push_back(MeasureAt(room, players, seconds));
  for (const int players : counts) {
    if (players <= 32) crowded.push_back(MeasureAt(crowd, players, seconds));
  }
  for (const int players : many) large.push_back(MeasureAt(plains, players, seconds));
  AddRow("30 m apart", spread, true, &rows);
  AddRow("9 m apart", crowded, false, &rows);
  AddRow("20 m apart on four plains, a sled and a ball each", large, true, &rows);
  return TableOf("growth", "How it grows with players, 15 bodies each but for the last rows", rows,
                 fmt::format("Sessions of {:.0f} s over `demo`, bots, in virtual time, one of each "
                             "size; after the first second.",
                             seconds));
}

}  // namespace seam
