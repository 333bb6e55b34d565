#include "common/base/check.h"
#include "common/record/log_file.h"
#include "common/record/recording.h"

namespace seam {

Recording ReadRecording(const std::string& path, const std::string& room) {
  LogReader reader(path);
  RecordingBuilder builder(room);
  LogEvent event;
  while (reader.Next(&event)) builder.Add(event.channel, event.data);
  if (!builder.has_room()) {
    const std::string which = room.empty() ? "no Seam2D room" : "no room \"" + room + "\"";
    throw OperatorError(path + ": " + which + " in this log (record channels SEAM.*)");
  }
  Recording recording = std::move(builder.recording());
  recording.skipped_bytes = reader.skipped_bytes();
  return recording;
}

}  // namespace seam
