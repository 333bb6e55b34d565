#include <algorithm>
#include <cstdio>

#include "common/base/check.h"
#include "common/base/process.h"
#include "common/record/log_file.h"
#include "tests/lab/commands.h"

namespace seam {

int RunLog(const RunCommand& command) {
  SessionSettings settings = command.settings;
  settings.smooth = command.smooth == "on";
  ClusterConfig config = Configure(settings);
  LogWriter log(command.log, command.force);
  config.recorder = &log;
  config.keep = false;
  const std::int64_t begin_us = SteadyClockUs();
  const SessionResult result = RunSession(config);
  log.Flush();
  if (log.failures() > 0) throw OperatorError(command.log + ": not all was written: disk full?");
  const double wall_s = static_cast<double>(SteadyClockUs() - begin_us) * 1e-6;
  std::printf("%s: %lld ticks, %.3f s simulated in %.3f s: %.1f x real time\n",
              command.log.c_str(), static_cast<long long>(result.ticks), result.simulated_s,
              wall_s, result.simulated_s / std::max(wall_s, 1e-6));
  return 0;
}

}  // namespace seam
