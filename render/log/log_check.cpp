#include "render/log/log_check.h"

#include <algorithm>
#include <cstdio>
#include <variant>

#include "common/base/check.h"
#include "common/codec/codec.h"
#include "common/record/damage.h"
#include "common/record/log_file.h"
#include "common/record/recording.h"

namespace seam {
namespace {

/// Returns the number of messages that are missing in all sessions, as their readers count them.
std::int64_t CountMissing(const std::string& path, const LogCheck& check) {
  std::int64_t missing = 0;
  for (const auto& [room, sessions] : check.rooms) {
    for (const auto& [id, span] : sessions) {
      char session[17] = "";
      const auto number = static_cast<unsigned long long>(id);
      if (id != 0) std::snprintf(session, sizeof session, "%016llx", number);
      try {
        missing += ReadRecording(path, room, session).bus_gaps;
      } catch (const OperatorError&) {
        continue;  // without its room or scene no reader takes it
      }
    }
  }
  return missing;
}

}  // namespace

LogCheck CheckLog(const std::string& path, const Secret* key) {
  LogCheck check;
  LogReader reader(path, key);
  for (LogEvent event; reader.Next(&event);) {
    const auto bytes =
        static_cast<std::int64_t>(kLogHeaderBytes + event.channel.size() + event.data.size());
    ++check.events;
    check.bytes += bytes;
    const std::string room = RoomOfChannel(event.channel);
    if (room.empty()) {
      ++check.foreign;
      continue;
    }
    const AnyMessage message = Decode(event.data);
    if (std::holds_alternative<std::monostate>(message)) {
      ++check.undecodable;
      continue;
    }
    const auto* seal = std::get_if<LogSeal>(&message);
    check.seals += seal != nullptr || std::holds_alternative<TickChain>(message) ? 1 : 0;
    check.keyed += seal != nullptr && !seal->log_keyed.empty() ? 1 : 0;
    SessionSpan& span = check.rooms[room][SessionOf(event.data).value_or(0)];
    ++span.events;
    span.bytes += bytes;
    span.us.Add(event.timestamp_us);
    span.happened += std::holds_alternative<Event>(message) ? 1 : 0;
    if (const auto* view = std::get_if<View>(&message)) span.ticks.Add(view->tick);
  }
  check.skipped_bytes = reader.skipped_bytes();
  check.damage = reader.damage();
  check.begins_after = reader.begins_after();
  check.missing = CountMissing(path, check);
  return check;
}

std::vector<std::string> LinesOf(const LogCheck& check) {
  Recording found;  // what all readers say about damage
  found.skipped_bytes = check.skipped_bytes;
  found.undecodable = check.undecodable;
  found.damage = check.damage;
  found.bus_gaps = check.missing;
  return DamageLines(found);
}

}  // namespace seam
