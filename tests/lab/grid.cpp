#include "tests/lab/grid.h"

#include <fmt/format.h>

#include <set>

#include "common/base/bytes.h"
#include "common/base/check.h"
#include "common/sync/method.h"
#include "tests/lab/experiment/build_id.h"
#include "tests/lab/scene_settings.h"
#include "tests/lab/sweep_file.h"

namespace seam {
namespace {

/// The names in "buffer/fade", "central/own" or "strict", in full.
void SetMethod(const std::string& method, SessionSettings* settings) {
  const MethodNames names = NamesOf(MakeSyncConfig(SplitMethod(method)));
  settings->mode = names.mode;
  settings->reconcile = names.reconcile;
  settings->predict = names.predict;
}

/// All combinations for one scene and method, appended.
void AddPoints(const SweepFile& file, GridPoint point, std::vector<GridPoint>* points) {
  SessionSettings& s = point.settings;
  for (const std::string& network : file.networks) {
    for (const std::int64_t send_hz : file.send_hz) {
      for (const std::string& drive : file.drive) {
        for (const std::string& smooth : file.smooth) {
          s.impair = network;
          s.send_hz = static_cast<int>(send_hz);
          s.drive = drive;
          s.smooth = smooth;
          s.seed = file.seeds.front();
          Configure(s, *point.scene);  // throws what is wrong with it
          for (const std::int64_t seed : file.seeds) {
            s.seed = seed;
            point.key = CsvRow(GridKey(point));
            points->push_back(point);
          }
        }
      }
    }
  }
}

}  // namespace

Values GridKey(const GridPoint& point) {
  const SessionSettings& s = point.settings;
  const std::string& text = point.scene->text;
  return {{"version", kLabVersion},
          {"commit", BuiltCommit()},
          {"numerics", Numerics()},
          {"scene", s.scene},
          {"scene_hash", fmt::format("{:016x}", Fnv1a(text.data(), text.size()))},
          {"set", JoinSettings(s.set)},
          {"mode", s.mode},
          {"reconcile", VariantOf(MethodNames{s.mode, s.reconcile, s.predict})},
          {"impair", s.impair},
          Count("send_hz", s.send_hz),
          {"drive", s.drive},
          {"smooth", s.smooth},
          {"duration_s", fmt::format("{}", s.duration_s)},
          Count("seed", s.seed)};
}

Values PointValues(const GridPoint& point) {
  const ImpairProfile net = FindProfile(point.settings.impair);
  const Solver& solver = point.scene->solver;
  const auto number = [](const char* column, double value) {
    return Value{column, fmt::format("{:g}", value)};
  };
  return {number("one_way_ms", static_cast<double>(net.delay_us) * 1e-3),
          number("jitter_ms", static_cast<double>(net.jitter_mean_us) * 1e-3),
          number("loss_percent", 100 * MeanLoss(net)),
          Count("tick_hz", solver.tick_hz),
          Count("substeps", solver.substeps),
          Count("velocity_iterations", solver.velocity_iterations),
          Count("position_iterations", solver.position_iterations),
          {"skin_m", solver.skin > 0 ? fmt::format("{:g}", solver.skin) : ""},
          number("buffer_m", point.scene->buffer_m),
          Count("input_delay_ticks", point.scene->input_delay_ticks)};
}

Grid ReadGrid(const std::string& path) {
  const SweepFile file = ReadSweepFile(path);
  double size = 1;
  for (const std::size_t count :
       {file.scenes.size(), file.settings.size(), file.methods.size(), file.networks.size(),
        file.send_hz.size(), file.drive.size(), file.smooth.size(), file.seeds.size()}) {
    size *= static_cast<double>(count);
  }
  if (size > static_cast<double>(kGridPointsMax)) {
    throw OperatorError(
        fmt::format("{}: {:.0f} runs are more than {}", path, size, kGridPointsMax));
  }
  Grid grid;
  grid.floor = file.floor;
  grid.limit = file.limit;
  for (const std::string& scene : file.scenes) {
    for (const std::vector<std::string>& set : file.settings) {
      GridPoint point;
      point.scene = std::make_shared<Scene>(LoadSceneWith(scene, set));
      point.settings.scene = scene;
      point.settings.set = set;
      point.settings.show_age = file.show_age;
      const bool own = file.duration_s == 0;
      point.settings.duration_s = own ? point.scene->duration_s : file.duration_s;
      for (const std::string& method : file.methods) {
        SetMethod(method, &point.settings);
        AddPoints(file, point, &grid.points);
      }
    }
  }
  std::set<std::string> keys;
  for (const GridPoint& point : grid.points) {
    if (!keys.insert(point.key).second) {
      throw OperatorError(path + ": the same run twice: " + point.key);
    }
  }
  return grid;
}

}  // namespace seam
