#include "tests/lab/grid.h"

#include <fmt/format.h>

#include <set>

#include "common/base/bytes.h"
#include "common/base/check.h"
#include "common/measure/table.h"
#include "common/sync/method.h"
#include "tests/lab/scene_settings.h"
#include "tests/lab/sweep_file.h"

namespace seam {
namespace {

std::string Key(const GridPoint& point) {
  const SessionSettings& s = point.settings;
  const std::string& text = point.scene->text;
  return fmt::format("{},{},{:016x},{},{},{},{},{},{},{},{},{}", kLabVersion, CsvField(s.scene),
                     Fnv1a(text.data(), text.size()), CsvField(JoinSettings(s.set)), s.mode,
                     VariantOf(MethodNames{s.mode, s.reconcile, s.predict}), CsvField(s.impair),
                     s.send_hz, s.drive, s.smooth, s.duration_s, s.seed);
}

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
            point.key = Key(point);
            points->push_back(point);
          }
        }
      }
    }
  }
}

}  // namespace

std::string GridHeader() {
  return "version,scene,scene_hash,set,mode,reconcile,impair,send_hz,drive,smooth,duration_s,seed";
}

std::string PointHeader() {
  return "one_way_ms,jitter_ms,loss_percent,tick_hz,substeps,velocity_iterations,"
         "position_iterations,skin_m,buffer_m,input_delay_ticks";
}

std::string PointValues(const GridPoint& point) {
  const ImpairProfile net = FindProfile(point.settings.impair);
  const Solver& solver = point.scene->solver;
  return fmt::format(
      ",{:g},{:g},{:g},{},{},{},{},{},{:g},{}", static_cast<double>(net.delay_us) * 1e-3,
      static_cast<double>(net.jitter_mean_us) * 1e-3, 100 * MeanLoss(net), solver.tick_hz,
      solver.substeps, solver.velocity_iterations, solver.position_iterations,
      solver.skin > 0 ? fmt::format("{:g}", solver.skin) : "", point.scene->buffer_m,
      point.scene->input_delay_ticks);
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
