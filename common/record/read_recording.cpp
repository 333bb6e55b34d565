/// Recordings from log files, and their lines for the operator.

#include <algorithm>
#include <optional>

#include "common/base/check.h"
#include "common/codec/message_limits.h"
#include "common/record/log_file.h"
#include "common/record/log_sessions.h"
#include "common/record/recorder.h"
#include "common/record/recording.h"

namespace seam {

Recording ReadRecording(const std::string& path, const std::string& room,
                        const std::string& session) {
  std::vector<LogSession> sessions = ListSessions(path, room);
  std::optional<std::int64_t> chosen;
  if (!sessions.empty()) chosen = sessions[ChooseSession(sessions, session, path)].id;
  LogReader reader(path);
  RecordingBuilder builder(room, chosen);
  LogEvent event;
  bool ours = false;
  while (reader.Next(&event)) {
    builder.Add(event.channel, event.data, event.timestamp_us);
    ours = ours || !RoomOfChannel(event.channel).empty();
  }
  if (!builder.has_room()) {
    const std::int32_t other = builder.recording().foreign_protocol;
    if (other != 0) {
      throw OperatorError(path + ": recorded with protocol " + std::to_string(other) +
                          "; this program reads protocol " +
                          std::to_string(kOldestReadableProtocol) + " to " +
                          std::to_string(kProtocolVersion));
    }
    throw OperatorError(path + ": " + WhyNoRoom(room, ours));
  }
  if (!builder.has_scene() && builder.scene_parts().have() > 0) {
    throw OperatorError(path + ": only " + std::to_string(builder.scene_parts().have()) + " of " +
                        std::to_string(builder.scene_parts().parts()) +
                        " parts of the scene are in this log: record for longer, they come again");
  }
  if (builder.recording().mixed) {
    throw OperatorError(path +
                        ": holds more than one session, recorded before protocol 13, when messages "
                        "did not say their session: record one session per log");
  }
  Recording recording = std::move(builder.recording());
  recording.skipped_bytes = reader.skipped_bytes();
  recording.damage = reader.damage();
  recording.sessions = std::move(sessions);
  return recording;
}

std::string SessionSuffix(const Recording& recording) {
  const std::vector<LogSession>& all = recording.sessions;
  if (all.size() < 2) return "";
  const auto chosen = std::find_if(all.begin(), all.end(), [&](const LogSession& session) {
    return session.id == recording.room.session;
  });
  return "#" + std::to_string(chosen - all.begin() + 1);
}

std::string ChosenSession(const Recording& recording) {
  const std::string suffix = SessionSuffix(recording);
  if (suffix.empty()) return "";
  const bool last = recording.room.session == recording.sessions.back().id;
  return SessionsText(recording.sessions) + "; this is " + suffix.substr(1) +
         (last ? ", the last" : "") + " (--session chooses)";
}

}  // namespace seam
