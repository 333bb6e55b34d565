/// seam-log: cut and merge.

#include <algorithm>
#include <cstdio>
#include <limits>
#include <memory>
#include <unordered_map>
#include <unordered_set>
#include <variant>

#include "common/base/check.h"
#include "common/record/damage.h"
#include "render/log/log_check.h"
#include "render/log/log_commands.h"
#include "render/log/log_copy.h"

namespace seam {
namespace {

constexpr std::int64_t kNoTick = std::numeric_limits<std::int64_t>::max();

/// The ticks that a cut keeps.
struct KeptTicks {
  std::int64_t first = -1, last = kNoTick;
};

KeptTicks TicksToKeep(const LogCutCommand& command, const Recording& recording) {
  if (command.range.given() && (command.from_tick || command.to_tick)) {
    throw OperatorError("--from and --to are seconds, --from-tick and --to-tick ticks: say one");
  }
  RequireRange(command.range, recording, command.log);
  KeptTicks kept;
  if (command.from_tick) kept.first = *command.from_tick;
  if (command.to_tick) kept.last = *command.to_tick;
  const int hz = recording.room.tick_hz;
  if (command.range.given()) {
    kept = {recording.first_tick, recording.last_tick};
    while (kept.first < kept.last && !command.range.Holds(kept.first, hz)) ++kept.first;
    while (kept.last > kept.first && !command.range.Holds(kept.last, hz)) --kept.last;
  }
  if (kept.first > kept.last) throw OperatorError("the first tick must not be after the last");
  if (kept.first > recording.last_tick || kept.last < recording.first_tick) {
    throw OperatorError(command.log + ": nothing is left: it has views of ticks " +
                        std::to_string(recording.first_tick) + " to " +
                        std::to_string(recording.last_tick));
  }
  return kept;
}

/// True for messages that readers need of before the part: they make the state at its begin.
bool IsContext(const AnyMessage& message) {
  return std::holds_alternative<Room>(message) || std::holds_alternative<ScenePart>(message) ||
         std::holds_alternative<EditOrder>(message) || std::holds_alternative<Inputs>(message) ||
         std::holds_alternative<Grants>(message) || std::holds_alternative<Meta>(message);
}

void RequireUndamaged(const std::string& path, const std::vector<DamagedRange>& damage,
                      std::int64_t last_tick) {
  for (const DamagedRange& part : damage) {
    if (part.first_tick > last_tick) continue;
    throw OperatorError(path + ": is damaged from tick " + std::to_string(part.first_tick) +
                        " on: only what precedes it can be copied (seam-log cut --to-tick " +
                        std::to_string(std::max<std::int64_t>(0, part.first_tick - 1)) + ")");
  }
}

/// A message as two logs have it, whatever log it stands in.
std::uint64_t KeyOf(const LogEvent& event, const AnyMessage& message) {
  const std::optional<LogSeal> seal = SealOf(message);
  const Bytes data = seal ? Encode(*seal) : event.data;
  const std::uint64_t channel = Fnv1a(event.channel.data(), event.channel.size());
  return Fnv1a(data.data(), data.size(), channel);
}

/// A log that is being merged: its next event, and by how much its clock is ahead of the first's.
struct Source {
  explicit Source(const std::string& path) : reader(path) {
    // A later segment begins with what precedes it, between two seals.
    keyframe_seals = reader.segment() > 0 ? 2 : 0;
    Take();
  }
  void Take() {
    there = reader.Next(&event);
    if (!there) return;
    message = Decode(event.data);
    in_keyframe = keyframe_seals > 0;
    if (in_keyframe && std::holds_alternative<LogSeal>(message)) --keyframe_seals;
    at_us = std::max(at_us, event.timestamp_us - ahead_us);
  }
  LogReader reader;
  LogEvent event;
  AnyMessage message;
  bool there = false;
  int keyframe_seals = 0;    // until the keyframe is over
  bool in_keyframe = false;  // the event is of what precedes a later segment
  std::int64_t ahead_us = 0;
  std::int64_t at_us = std::numeric_limits<std::int64_t>::min();  // never runs backwards
  /// Returns a key of the event: another one for a message that this log has again.
  std::uint64_t Key() {
    const std::uint64_t key = KeyOf(event, message);
    const int before = times[key]++;
    return Fnv1a(&before, sizeof before, key);
  }
  std::unordered_map<std::uint64_t, int> times;
};

/// Returns by how much the clock of the log is ahead: the median over the messages that both have.
std::int64_t ClockAhead(const std::unordered_map<std::uint64_t, std::int64_t>& first,
                        const std::string& path) {
  std::vector<std::int64_t> ahead;
  for (Source source(path); source.there; source.Take()) {
    if (source.in_keyframe) continue;  // with the times of the segment
    const auto found = first.find(KeyOf(source.event, source.message));
    if (found != first.end()) ahead.push_back(source.event.timestamp_us - found->second);
  }
  if (ahead.empty()) return 0;
  const auto middle = ahead.begin() + static_cast<std::ptrdiff_t>(ahead.size() / 2);
  std::nth_element(ahead.begin(), middle, ahead.end());
  return *middle;
}

/// Calls `take(event, place, message, in_part)` for the messages of the recording's session: where
/// each stands in the log, and whether it is of the ticks, or of those that readers need of before.
template <class Take>
void EachEvent(const std::string& log, const Recording& recording, const KeptTicks& kept,
               const Take& take) {
  LogReader reader(log);
  bool over = false;  // the messages without a tick go as those around them
  std::int64_t place = 0;
  for (LogEvent event; reader.Next(&event); ++place) {
    const bool ours = RoomOfChannel(event.channel) == recording.room.room &&
                      SessionOf(event.data).value_or(0) == recording.room.session;
    if (!ours) continue;
    const AnyMessage message = Decode(event.data);
    if (std::holds_alternative<std::monostate>(message)) continue;
    const std::optional<std::int64_t> tick = TickOfMessage(message);
    if (tick && !std::holds_alternative<Inputs>(message)) over = *tick > kept.last;
    const bool before = tick && *tick < kept.first && !IsContext(message);
    const bool after = tick ? *tick > kept.last : over;
    take(event, place, message, !before && !after);
  }
}

}  // namespace

int RunLogCut(const LogCutCommand& command) {
  const Recording recording = ReadRecording(command.log, command.room, command.session);
  ReportDamage("seam-log", command.log, recording);
  const KeptTicks kept = TicksToKeep(command, recording);
  RequireUndamaged(command.log, recording.damage, kept.last);
  // Messages stand in the order of arrival, with numbers by channel. All between the first and the
  // last one of a channel that are kept go with them: what is late, too, leaves no gap.
  std::unordered_map<std::string, std::int64_t> last;  // place of the last kept event by channel
  EachEvent(command.log, recording, kept,
            [&last](const LogEvent& event, std::int64_t place, const AnyMessage&, bool in_part) {
              if (in_part) last[event.channel] = place;
            });
  LogCopy copy(command.out, command.force, {command.log});
  std::unordered_set<std::string> begun;
  EachEvent(
      command.log, recording, kept,
      [&](const LogEvent& event, std::int64_t place, const AnyMessage& message, bool in_part) {
        if (in_part) begun.insert(event.channel);
        const bool between = begun.count(event.channel) != 0;
        if (!between || place > last[event.channel]) return;
        copy.Add(event, event.timestamp_us, message);
      });
  copy.Finish();
  std::printf("%s: %lld events\n", command.out.c_str(), static_cast<long long>(copy.events()));
  return StatusAfterReading(0);
}

int RunLogMerge(const LogMergeCommand& command) {
  if (command.logs.size() < 2) throw OperatorError("merge takes two logs or more");
  for (const std::string& path : command.logs) {
    const LogCheck check = CheckLog(path);
    RequireUndamaged(path, check.damage, kNoTick);
    // Messages that a logger has missed may be in another log.
    if (check.damaged()) throw OperatorError(path + ": " + LinesOf(check).front());
  }
  std::unordered_map<std::uint64_t, std::int64_t> first;  // time by message
  for (Source source(command.logs.front()); source.there; source.Take()) {
    if (source.in_keyframe) continue;
    first.try_emplace(KeyOf(source.event, source.message), source.event.timestamp_us);
  }
  LogCopy copy(command.out, command.force, command.logs);
  std::vector<std::unique_ptr<Source>> sources;
  for (const std::string& path : command.logs) {
    sources.push_back(std::make_unique<Source>(path));
    Source& source = *sources.back();
    if (sources.size() > 1) source.ahead_us = ClockAhead(first, path);
    source.at_us = source.event.timestamp_us - source.ahead_us;
  }
  std::unordered_set<std::uint64_t> written;
  std::unordered_map<std::int64_t, const Source*> begun;  // the log that a session's room is from
  std::int64_t twice = 0;
  for (;;) {
    Source* next = nullptr;
    for (const std::unique_ptr<Source>& source : sources) {
      if (source->there && (next == nullptr || source->at_us < next->at_us)) next = source.get();
    }
    if (next == nullptr) break;
    const std::int64_t session = SessionOf(next->event.data).value_or(0);
    const bool room = std::holds_alternative<Room>(next->message);
    const auto of = room ? begun.try_emplace(session, next).first : begun.find(session);
    const bool known = next->in_keyframe && of != begun.end() && of->second != next;
    if (!known && written.insert(next->Key()).second) {
      copy.Add(next->event, next->at_us, next->message);
    } else {
      ++twice;
    }
    next->Take();
  }
  copy.Finish();
  std::printf("%s: %lld events, %lld that came twice\n", command.out.c_str(),
              static_cast<long long>(copy.events()), static_cast<long long>(twice));
  return 0;
}

}  // namespace seam
