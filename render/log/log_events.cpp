/// seam-log: events.

#include <cstdio>

#include "common/record/damage.h"
#include "common/record/events/event_text.h"
#include "common/record/events/summary_text.h"
#include "render/log/log_commands.h"

namespace seam {

int RunLogEvents(const LogEventsCommand& command) {
  const Recording recording = ReadRecording(command.log, command.room, command.session);
  ReportDamage("seam-log", command.log, recording);
  const int tick_hz = recording.room.tick_hz;
  for (const Event& event : recording.events) {
    const double time_s = static_cast<double>(event.tick) / tick_hz;
    if (command.json) {
      std::printf("%s\n", EventJson(event, time_s).c_str());
    } else {
      std::printf("%9.2f s  %-13s %s\n", time_s, EventKindName(event.kind), event.text.c_str());
    }
  }
  if (!command.json && !recording.summaries.empty()) {
    std::printf("%s", SummaryTable(recording.summaries.back(), tick_hz).c_str());
  }
  return StatusAfterReading(0);
}

}  // namespace seam
