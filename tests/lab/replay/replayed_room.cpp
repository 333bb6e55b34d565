#include "tests/lab/replay/replayed_room.h"

#include <utility>
#include <variant>

#include "common/base/check.h"
#include "common/codec/codec.h"
#include "common/record/log_file.h"
#include "server/saved/trial_load.h"

namespace seam {
class ReplayedRoom::Silence : public Recorder {
 public:
  void Publish(const std::string&, std::int64_t, ByteView) override {}
  bool listening() const override { return false; }
};

LoggedRoom ReadLoggedRoom(const std::string& path, const std::string& session) {
  LoggedRoom logged;
  logged.recording = ReadRecording(path, "", session);
  const Room& room = logged.recording.room;
  LogReader reader(path);
  TickSplitter splitter;
  std::int64_t reading = 0;  // a session
  bool accepts = false;      // as servers of 0.26 and later say
  for (LogEvent event; reader.Next(&event);) {
    const std::int64_t of = SessionOf(event.data).value_or(0);
    const bool ours = RoomOfChannel(event.channel) == room.room &&
                      PublisherOfChannel(event.channel) == 0 &&
                      (session.empty() || of == room.session);
    if (!ours) continue;
    if (std::exchange(reading, of) != of) splitter = TickSplitter();
    AnyMessage any = Decode(event.data);
    const auto* seal = std::get_if<LogSeal>(&any);
    accepts = accepts || std::holds_alternative<Accepted>(any);
    if (seal == nullptr) {
      splitter.Add(std::move(any));
      continue;
    }
    for (TickMessages& tick : splitter.End(*seal)) {
      // A server that goes on with a room begins a session with the next tick; another room,
      // with 1.
      if (tick.tick == 1) logged.ticks.clear();
      logged.ticks.push_back(std::move(tick));
    }
  }
  if (reading != room.session) logged.ticks.clear();
  const std::string why =
      logged.ticks.empty()
          ? accepts ? "is cut off before the first hash of a tick"
                    : "has no hashes of its ticks: record it with --record, --state or "
                      "seam-lab run, of version 0.26 or later"
      : logged.ticks.front().tick != 1
          ? "begins with tick " + std::to_string(logged.ticks.front().tick) +
                " of the room: a room is done again from its first tick on"
          : "";
  if (!why.empty()) throw OperatorError(path + ": " + why);
  for (std::size_t i = 1; i < logged.ticks.size(); ++i) {
    if (logged.ticks[i].tick == logged.ticks[i - 1].tick + 1) continue;
    throw OperatorError(path + ": tick " + std::to_string(logged.ticks[i - 1].tick + 1) +
                        " is missing");
  }
  return logged;
}

ReplayedRoom::ReplayedRoom(const LoggedRoom& logged, Recorder* out)
    : logged_(logged),
      out_(out),
      net_(network_.Attach({1, 7777})),
      silence_(std::make_unique<Silence>()) {
  const Room& room = logged.recording.room;
  ServerConfig config = ConfigOf(room);
  config.publish = out != nullptr ? Publish::kAll : Publish::kNone;
  Recorder& recorder = out != nullptr ? *out : *silence_;
  server_ = std::make_unique<Server>(ParseScene(room.scene_text, room.scene_name), config, *net_,
                                     recorder, entropy_);
}

ReplayedRoom::~ReplayedRoom() = default;

ReplayedRoom::Tick ReplayedRoom::Step() {
  const TickMessages& tick = logged_.ticks[next_++];
  const bool same_values = server_->Replay(0, tick);
  if (out_ != nullptr) server_->Republish(tick);
  const auto hash = static_cast<std::uint16_t>(server_->replica().world().Hash());
  if (tick.hash && hash != *tick.hash) return Tick::kOtherWorld;
  return same_values ? Tick::kSame : Tick::kOtherValues;
}

}  // namespace seam
