#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <optional>

#include "common/base/check.h"
#include "common/base/find_scene.h"
#include "common/base/plain_file.h"
#include "common/base/process.h"
#include "common/base/progress_count.h"
#include "common/measure/measure.h"
#include "common/measure/screen/peers_apart.h"
#include "common/record/room_log.h"
#include "tests/lab/commands.h"
#include "tests/lab/scene_settings.h"

namespace seam {
namespace {

std::string Metres(const std::optional<double>& metres) {
  return metres ? fmt::format("{:.3g} m", *metres) : "–";
}

/// Returns the headline, the error of others' bodies at the tick that is shown, with its age, the
/// error of the present and the disagreement of the peers beside it.
std::string Headline(const Recording& recording) {
  try {
    const Oracle plain = ComputeOracle(recording);
    const bool barriers = JudgedByBarriers(recording.room);
    const Measures m = Measure(
        recording, barriers ? ComputeOracle(recording, WithBarriers(recording.room)) : plain);
    return fmt::format(
        "error of others {} RMS at the tick shown, {:.0f} ms ago ({} against the present), views "
        "of "
        "one tick {} apart, stutter {:.3g} m/s2; floor {:.3g} m (the oracle against itself, one "
        "body moved by 1e-6 m)",
        Metres(m.path_error_rms_m), m.view_age_ms.value_or(0), Metres(m.error_others_m),
        Metres(PeersApart(recording)), m.stutter_shown_mps2, ErrorFloor(recording, plain));
  } catch (const OperatorError& error) {  // the log is whole all the same
    return std::string("not measured: ") + error.what();
  }
}

}  // namespace

int RunLog(const RunCommand& command) {
  SessionSettings settings = command.settings;
  settings.scene = FindScene(settings.scene);
  settings.smooth = command.smooth;
  for (const std::string& each : command.set) settings.set.push_back(each);
  if (command.buffer_m) settings.set.push_back(fmt::format("buffer={}", *command.buffer_m));
  if (command.input_delay_ticks) {
    settings.set.push_back(fmt::format("input_delay={}", *command.input_delay_ticks));
  }
  if (command.show_age_ticks) {
    settings.set.push_back(fmt::format("show_age={}", *command.show_age_ticks));
  }
  settings.set = SplitSettings(JoinSettings(settings.set));
  ClusterConfig config = Configure(settings);
  RequireOutput(command.log, command.force, {settings.scene});
  RoomLog log(command.log, command.force, nullptr);
  config.recorder = &log;
  config.keep = command.floor;
  const std::int64_t begin_us = SteadyClockUs();
  Recording recording;
  std::optional<ProgressCount> progress;
  const SessionResult result =
      RunSession(config, &recording, [&progress](std::int64_t done, std::int64_t ticks) {
        if (!progress) progress.emplace("running", "ticks", ticks);
        (*progress)(done);
      });
  progress.reset();
  log.Flush();
  if (!log.trouble().ok()) throw OperatorError(log.trouble().why());
  const double wall_s = static_cast<double>(SteadyClockUs() - begin_us) * 1e-6;
  std::printf("%s: %lld ticks, %.3f s simulated in %.3f s: %.1f x real time\n", command.log.c_str(),
              static_cast<long long>(result.ticks), result.simulated_s, wall_s,
              result.simulated_s / std::max(wall_s, 1e-6));
  if (command.floor) std::printf("%s\n", Headline(recording).c_str());
  for (const std::string& warning : result.warnings) {
    std::fprintf(stderr, "seam-lab: %s\n", warning.c_str());
  }
  return result.script_stopped ? 1 : 0;
}

}  // namespace seam
