/// Chooses the messages of a session for an MCAP file, and their times.

#include <algorithm>

#include "common/base/version.h"
#include "render/export/formats.h"
#include "render/export/foxglove.h"
#include "render/export/mcap_writer.h"

namespace seam {
namespace {

/// The channels of one view.
struct ViewChannels {
  std::uint16_t frames = 0, shapes = 0, errors = 0;
  int shapes_of = -1;  ///< RevisionHistory::Key of the shapes that were written last
};

/// An input or an event, to be written at its tick.
struct Timed {
  std::int64_t tick = 0;
  std::uint16_t channel = 0;
  std::string json;
};

std::uint16_t AddSchema(McapWriter* file, const FoxgloveSchema& schema) {
  return file->AddSchema(schema.name, schema.text);
}

std::string InputJson(std::int64_t tick, const Inputs& message, std::size_t i) {
  return "{\"tick\":" + std::to_string(tick) +
         ",\"drive\":" + std::to_string(message.drive[i] / 127.0) +
         ",\"lift\":" + std::to_string(message.lift[i] / 127.0) +
         ",\"buttons\":" + std::to_string(message.buttons[i]) + "}";
}

std::vector<Timed> InputsOf(const ExportSession& session, McapWriter* file) {
  std::vector<Timed> all;
  if (session.recording.inputs.empty()) return all;
  const std::uint16_t schema = AddSchema(file, InputSchema());
  for (const auto& [player, messages] : session.recording.inputs) {
    const std::uint16_t channel = file->AddChannel(schema, "/inputs/" + session.PlayerName(player));
    for (const auto& [first_tick, message] : messages) {
      for (std::size_t i = 0; i < message.drive.size(); ++i) {
        const std::int64_t tick = first_tick + static_cast<std::int64_t>(i);
        if (!session.range.Holds(tick, session.recording.room.tick_hz)) continue;
        all.push_back({tick, channel, InputJson(tick, message, i)});
      }
    }
  }
  return all;
}

std::vector<Timed> TimedOf(const ExportSession& session, McapWriter* file) {
  std::vector<Timed> all = InputsOf(session, file);
  const std::uint16_t log = file->AddChannel(AddSchema(file, LogSchema()), "/events");
  for (const Event& event : session.recording.events) {
    all.push_back({event.tick, log, LogOf(session, event)});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Timed& a, const Timed& b) { return a.tick < b.tick; });
  return all;
}

std::map<int, ViewChannels> AddViews(const ExportSession& session, McapWriter* file) {
  const std::uint16_t frames = AddSchema(file, FrameTransformsSchema());
  const std::uint16_t shapes = AddSchema(file, SceneUpdateSchema());
  const std::uint16_t errors = AddSchema(file, ErrorsSchema());
  file->AddMessage(file->AddChannel(shapes, "/ground"),
                   TimeNs(session, session.recording.first_tick), GroundOf(session));
  std::map<int, ViewChannels> channels;
  for (const auto& [peer, views] : session.recording.views) {
    const std::string name = "/" + session.ViewName(peer);
    channels[peer].frames = file->AddChannel(frames, name + "/poses");
    channels[peer].shapes = file->AddChannel(shapes, name + "/shapes");
    if (session.oracle) channels[peer].errors = file->AddChannel(errors, name + "/errors");
  }
  return channels;
}

}  // namespace

void WriteMcapExport(const ExportSession& session, OutputFile* out) {
  McapWriter file(out, std::string("seam-export ") + kVersion);
  std::map<int, ViewChannels> channels = AddViews(session, &file);
  const std::vector<Timed> timed = TimedOf(session, &file);
  auto next = timed.begin();
  const auto write_until = [&](std::int64_t tick) {
    for (; next != timed.end() && next->tick <= tick; ++next) {
      file.AddMessage(next->channel, TimeNs(session, next->tick), next->json);
    }
  };
  ForEachView(session, [&](const View& view) {
    write_until(view.tick);
    const std::vector<ExportRow> rows = RowsOf(session, view);
    const std::uint64_t time_ns = TimeNs(session, view.tick);
    ViewChannels& its = channels[view.peer];
    const int key = session.revisions->Key(view.revision);
    if (its.shapes_of != key) {
      its.shapes_of = key;
      file.AddMessage(its.shapes, time_ns, SceneUpdateOf(session, view, rows));
    }
    file.AddMessage(its.frames, time_ns, FramesOf(session, view, rows));
    if (session.oracle) file.AddMessage(its.errors, time_ns, ErrorsOf(session, view, rows));
  });
  write_until(std::numeric_limits<std::int64_t>::max());
  file.Finish();
}

}  // namespace seam
