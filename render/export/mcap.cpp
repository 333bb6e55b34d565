/// Chooses the messages of a session for an MCAP file, and their times.

#include <algorithm>
#include <map>

#include "common/base/version.h"
#include "render/export/formats.h"
#include "render/export/foxglove.h"
#include "render/export/mcap_writer.h"

namespace seam {
namespace {

/// The channels of one view.
struct ViewChannels {
  std::uint16_t shapes = 0;
  std::map<std::string, std::uint16_t> clouds;  ///< by the body's name
  int shapes_of = -1;  ///< RevisionHistory::Key of the shapes that were written last
};

/// Most channels of points, one for each body in each view: beyond it a file has none. Normal 50;
/// MCAP has 65 535 channels.
constexpr std::size_t kCloudChannelsMax = 10000;

/// An input or an event, to be written at its tick.
struct Timed {
  std::int64_t tick = 0;
  std::uint16_t channel = 0;
  std::string message;
};

std::uint16_t AddSchema(McapWriter* file, const char* name) {
  return file->AddSchema(name, ExportSchema(name));
}

/// Tells whether an input is that of the tick before and of the tick after: a plot needs no point.
bool IsHeld(const std::map<std::int64_t, Input>& inputs, std::int64_t tick, const Input& input) {
  const auto same = [&](std::int64_t other) {
    const auto found = inputs.find(other);
    return found != inputs.end() && found->second == input;
  };
  return same(tick - 1) && same(tick + 1);
}

std::vector<Timed> InputsOf(const ExportSession& session, McapWriter* file) {
  std::vector<Timed> all;
  if (session.recording.inputs.empty()) return all;
  const std::uint16_t schema = AddSchema(file, kInputSchema);
  for (const auto& [player, messages] : session.recording.inputs) {
    const std::uint16_t channel = file->AddChannel(schema, "/inputs/" + session.PlayerName(player));
    std::map<std::int64_t, Input> inputs;
    for (const auto& [first_tick, message] : messages) {
      for (std::size_t i = 0; i < message.drive.size(); ++i) {
        const std::int64_t tick = first_tick + static_cast<std::int64_t>(i);
        if (!session.range.Holds(tick, session.recording.room.tick_hz)) continue;
        inputs.emplace(tick, Input{message.drive[i], message.lift[i], message.buttons[i]});
      }
    }
    for (const auto& [tick, input] : inputs) {
      if (!IsHeld(inputs, tick, input)) all.push_back({tick, channel, InputOf(tick, input)});
    }
  }
  return all;
}

std::vector<Timed> TimedOf(const ExportSession& session, McapWriter* file) {
  std::vector<Timed> all = InputsOf(session, file);
  const std::uint16_t log = file->AddChannel(AddSchema(file, kLogSchema), "/events");
  for (const Event& event : session.recording.events) {
    all.push_back({event.tick, log, LogOf(session, event)});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Timed& a, const Timed& b) { return a.tick < b.tick; });
  return all;
}

std::map<int, ViewChannels> AddViews(const ExportSession& session, McapWriter* file) {
  const std::uint16_t shapes = AddSchema(file, kSceneSchema);
  const std::uint16_t clouds = AddSchema(file, kCloudSchema);
  const std::uint64_t begin_ns = TimeNs(session, session.recording.first_tick);
  file->AddMessage(file->AddChannel(shapes, "/ground"), begin_ns, GroundOf(session));
  file->AddMessage(file->AddChannel(clouds, "/ground/points"), begin_ns, GroundCloudOf(session));
  std::vector<int> peers;
  for (const auto& [peer, views] : session.recording.views) peers.push_back(peer);
  if (session.oracle && !peers.empty()) peers.push_back(kOraclePeer);
  std::map<int, ViewChannels> channels;
  for (const int peer : peers) {
    const std::string name = "/" + ExportViewName(session, peer);
    channels[peer].shapes = file->AddChannel(shapes, name + "/shapes");
    if (peers.size() * session.bodies.size() <= kCloudChannelsMax) {
      for (const ExportBody& body : session.bodies) {
        channels[peer].clouds[body.name] = file->AddChannel(clouds, name + "/points/" + body.name);
      }
    }
  }
  return channels;
}

}  // namespace

void WriteMcapExport(const ExportSession& session, OutputFile* out) {
  McapWriter file(out, std::string("seam-export ") + kVersion);
  std::map<int, ViewChannels> channels = AddViews(session, &file);
  const std::uint16_t poses = file.AddChannel(AddSchema(&file, kFramesSchema), "/poses");
  const std::uint16_t errors = file.AddChannel(AddSchema(&file, kErrorsSchema), "/errors");
  const std::vector<Timed> timed = TimedOf(session, &file);
  auto next = timed.begin();
  std::int64_t tick = -1;                // of the newest view
  std::string frames;                    // of the views of that tick
  std::vector<std::string> view_errors;  // likewise
  // The index of messages is not compressed: so there is one for all views.
  const auto end_tick = [&](std::int64_t next_tick) {
    const std::uint64_t time_ns = TimeNs(session, tick);
    if (!frames.empty()) file.AddMessage(poses, time_ns, frames);
    if (!view_errors.empty()) file.AddMessage(errors, time_ns, ErrorsOf(tick, view_errors));
    frames.clear();
    view_errors.clear();
    for (; next != timed.end() && next->tick <= next_tick; ++next) {
      file.AddMessage(next->channel, TimeNs(session, next->tick), next->message);
    }
    tick = next_tick;
  };
  const auto write = [&](const View& view) {
    const std::vector<ExportRow> rows = RowsOf(session, view);
    const std::uint64_t time_ns = TimeNs(session, view.tick);
    ViewChannels& its = channels[view.peer];
    const int key = session.revisions->Key(view.revision);
    if (its.shapes_of != key) {
      its.shapes_of = key;
      file.AddMessage(its.shapes, time_ns, SceneUpdateOf(session, view, rows));
      if (!its.clouds.empty()) {
        for (const NamedMessage& cloud : CloudsOf(session, view, rows)) {
          file.AddMessage(its.clouds.at(cloud.name), time_ns, cloud.message);
        }
      }
    }
    frames += FramesOf(session, view, rows);
    if (session.oracle && view.peer != kOraclePeer) {
      view_errors.push_back(ErrorsOf(session, view, rows));
    }
  };
  ForEachView(session, [&](const View& view) {
    if (view.tick != tick) {
      end_tick(view.tick);
      if (session.oracle) write(OracleView(session, view));
    }
    write(view);
  });
  end_tick(std::numeric_limits<std::int64_t>::max());
  file.Finish();
}

}  // namespace seam
