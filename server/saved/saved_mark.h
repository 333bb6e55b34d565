#pragma once
/// The mark in a room's log that the room was saved between two ticks. Saving makes the tick before
/// a barrier, also where the mode has none there, so who does the log again makes it one too.

#include <algorithm>
#include <cstdint>
#include <variant>

#include "common/codec/codec.h"
#include "server/saved/log_tail.h"

namespace seam {

/// Returns the message that the log holds, as accepted of the server itself. `tick`: the last one.
inline LogSeal SavedMark(std::int64_t tick) {
  LogSeal mark;
  mark.session = 1;  // of no session: it only has to be valid
  mark.tick = tick;
  return mark;
}

inline bool IsSavedMark(const Accepted& accepted) {
  return accepted.peer == 0 && std::holds_alternative<LogSeal>(Decode(accepted.data));
}

/// True if the room was saved after the last tick of the log.
inline bool EndsWithSavedMark(const LogTail& tail) {
  return std::any_of(tail.begun.begin(), tail.begun.end(), [](const AnyMessage& message) {
    const auto* accepted = std::get_if<Accepted>(&message);
    return accepted != nullptr && IsSavedMark(*accepted);
  });
}

}  // namespace seam
