#include "server/saved/log_begin.h"

#include <utility>
#include <variant>
#include <vector>

#include "common/base/check.h"
#include "common/codec/codec.h"
#include "common/record/log_file.h"
#include "common/record/room_log.h"
#include "common/record/scene_parts.h"
#include "common/record/tick_splitter.h"
#include "server/saved/trial_load.h"

namespace seam {
namespace {

/// Returns the description of a room that begins with tick 1 of its log, with its scene.
Room ReadRoomOfFirstTick(const std::string& log, const std::string& name) {
  LogReader reader(log);
  Room room;
  SceneParts parts;
  TickSplitter splitter;
  for (LogEvent event; reader.Next(&event);) {
    if (RoomOfChannel(event.channel) != name || PublisherOfChannel(event.channel) != 0) continue;
    AnyMessage any = Decode(event.data);
    const auto* seal = std::get_if<LogSeal>(&any);
    if (auto* part = std::get_if<ScenePart>(&any)) {
      parts.Take(*part);
    } else if (const auto* described = std::get_if<Room>(&any)) {
      std::string text = std::move(room.scene_text);
      room = *described;
      if (room.scene_text.empty()) room.scene_text = std::move(text);
    }
    if (parts.whole() && room.scene_text.empty()) room.scene_text = parts.TakeText();
    if (seal == nullptr) {
      splitter.Add(std::move(any));
      continue;
    }
    const std::vector<TickMessages> ticks = splitter.End(*seal);
    if (ticks.empty()) continue;
    if (ticks.front().tick != 1) {
      throw OperatorError(log + ": begins with tick " + std::to_string(ticks.front().tick));
    }
    if (room.scene_text.empty()) throw OperatorError(log + ": has no scene before its first tick");
    return room;
  }
  throw OperatorError(log + ": has no tick");
}

}  // namespace

std::unique_ptr<const SavedRoom> RoomAtLogBegin(const std::string& log, const std::string& room,
                                                Status* status) {
  try {
    const Bytes saved = SaveUnbegun(ReadRoomOfFirstTick(log, room));
    return SavedRoom::Read(saved, status);
  } catch (const OperatorError& error) {
    *status = Status::Error(error.what());
    return nullptr;
  }
}

}  // namespace seam
