#include "server/saved/log_tail.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <variant>

#include "common/base/check.h"
#include "common/codec/codec.h"
#include "common/record/damage.h"
#include "common/record/log_file.h"

namespace seam {
namespace {

/// Keeps the newest sum of the newest session.
void NoteSum(const AnyMessage& any, std::optional<Summary>* newest) {
  if (const auto* room = std::get_if<Room>(&any)) {
    if (*newest && (*newest)->session != room->session) newest->reset();
  } else if (const auto* summary = std::get_if<Summary>(&any)) {
    if (summary->of == summary->session) *newest = *summary;
  }
}

/// Returns the seal, if the message is one of the log's bytes.
const LogSeal* AsSeal(const AnyMessage& any) {
  const auto* seal = std::get_if<LogSeal>(&any);
  return seal != nullptr && seal->log_events > 0 ? seal : nullptr;
}

}  // namespace

LogFollower::LogFollower(std::string path, std::string room, const LogPlace& from,
                         std::int64_t tick, const Secret* key)
    : path_(std::move(path)),
      room_(std::move(room)),
      key_(key),
      tick_(tick),
      kept_(from),
      splitter_(tick) {}

std::vector<AnyMessage> LogFollower::Begun(const TickSplitter& splitter) const {
  std::vector<AnyMessage> all = late_;
  for (AnyMessage& any : splitter.begun()) all.push_back(std::move(any));
  return all;
}

Status LogFollower::Read(LogTail* tail) {
  *tail = LogTail();
  tail->end = kept_;
  tail->begun = Begun(splitter_);
  tail->damaged_segment = kept_.segment;
  std::unique_ptr<LogReader> log;
  try {
    log = std::make_unique<LogReader>(path_, kept_, key_);
  } catch (const OperatorError& error) {
    return Status::Error(error.what());
  }
  const auto damaged = [&](const std::string& what) {
    tail->damage = SegmentPath(path_, log->segment()) + ": " + what;
    tail->damaged_segment = log->segment();
    return Status::Ok();
  };
  TickSplitter splitter = splitter_;
  LogEvent event;
  bool sealed = false;  // the event before was a seal, at tail->end
  while (log->Next(&event)) {
    const bool good = log->intact() && log->skipped_bytes() == 0;
    const bool ours = RoomOfChannel(event.channel) == room_;
    AnyMessage any = ours ? Decode(event.data) : AnyMessage();
    const LogSeal* const seal = AsSeal(any);
    if (!good) {
      if (seal == nullptr) continue;
      const std::vector<DamagedRange> parts = log->damage();
      const bool forged = !parts.empty() && parts.back().forged;
      return damaged("is damaged after tick " + std::to_string(tick_) +
                     (forged ? kForgedWords : ""));
    }
    if (std::exchange(sealed, seal != nullptr)) {  // it is followed by another: it was kept
      kept_ = tail->end;
      splitter_ = splitter;
    }
    if (seal == nullptr) {
      if (ours && PublisherOfChannel(event.channel) == 0) splitter.Add(std::move(any));
      continue;
    }
    if (seal->peer == 0) {
      for (TickMessages& next : splitter.End(*seal)) {
        if (next.tick == tick_ && next.after.size() > after_) {
          late_.assign(next.after.begin() + static_cast<std::ptrdiff_t>(after_), next.after.end());
        }
        if (next.tick <= tick_) continue;  // of an earlier call
        if (next.tick != tick_ + 1) {
          return damaged("tick " + std::to_string(tick_ + 1) + " is missing");
        }
        tick_ = next.tick;
        after_ = next.after.size();
        late_.clear();
        tail->ticks.push_back(std::move(next));
      }
      tail->begun = Begun(splitter);
    }
    tail->end = {
        log->place_bytes(), event.number + 1, static_cast<std::uint32_t>(seal->log_crc), {}, tick_,
        log->segment()};
    std::copy(seal->log_keyed.begin(), seal->log_keyed.end(), tail->end.keyed.begin());
  }
  for (const TickMessages& each : tail->ticks) {
    for (const AnyMessage& any : each.before) NoteSum(any, &tail->summary);
    for (const AnyMessage& any : each.after) NoteSum(any, &tail->summary);
  }
  for (const AnyMessage& any : tail->begun) NoteSum(any, &tail->summary);
  return Status::Ok();
}

Status ReadLogTail(const std::string& path, const std::string& room, const LogPlace& from,
                   std::int64_t tick, const Secret* key, LogTail* tail) {
  return LogFollower(path, room, from, tick, key).Read(tail);
}

}  // namespace seam
