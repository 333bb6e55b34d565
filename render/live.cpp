// Draws frames from the LCM bus as messages arrive: from a running session or lcm-logplayer.

#include <chrono>
#include <cstdio>

#include "common/base/check.h"
#include "common/base/process.h"
#include "common/record/bus.h"
#include "render/commands.h"
#include "render/live_renderer.h"

namespace seam {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double kQuiet_s = 2;       ///< the end of a session
constexpr double kFirstWait_s = 30;  ///< time to wait for its beginning, unless --seconds is given

double Since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

void RenderLive(const RenderOptions& options) {
  LiveRenderer live(options);
  Bus bus(options.lcm_url);
  Clock::time_point last_heard = Clock::now();
  bool heard = false;  // in the last poll: after a slow frame messages may be queued
  bus.Subscribe("SEAM\\..*", [&](const std::string& channel, std::int64_t, ByteView message) {
    if (!live.Add(channel, message)) return;
    last_heard = Clock::now();
    heard = true;
  });
  StopOnSignals();
  const Clock::time_point start = Clock::now();
  const double wait_s = options.seconds > 0 ? options.seconds : kFirstWait_s;
  while (g_stop == 0) {
    heard = false;
    bus.Poll(20000);
    live.DrawDue();
    if (options.seconds > 0 && Since(start) > options.seconds) break;
    if (live.frames() > 0 && !heard && Since(last_heard) > kQuiet_s) break;
    if (live.frames() == 0 && Since(start) > wait_s) break;
  }
  if (live.frames() == 0) {
    throw OperatorError(g_stop != 0 ? "stopped before there was anything to draw"
                                    : "heard no session on the bus: is anything publishing?");
  }
  std::fprintf(stderr, "%d frames in %s, %d skipped to keep up\n", live.frames(),
               live.path().c_str(), live.skipped());
}

}  // namespace seam
