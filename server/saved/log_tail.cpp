#include "server/saved/log_tail.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <variant>

#include "common/base/check.h"
#include "common/codec/codec.h"
#include "common/record/log_file.h"
#include "common/record/tick_splitter.h"

namespace seam {
namespace {

/// Adds what a tick's messages say.
void AddTick(TickMessages* of, LogTail* tail) {
  const std::int64_t tick = of->tick;
  for (std::vector<AnyMessage>* messages : {&of->before, &of->after}) {
    for (AnyMessage& any : *messages) {
      if (auto* inputs = std::get_if<Inputs>(&any)) {
        const std::int64_t acts = std::min(tick, inputs->first_tick);
        tail->ticks[acts].inputs.push_back(std::move(*inputs));
      } else if (auto* states = std::get_if<States>(&any)) {
        if (states->peer != 0) tail->ticks[tick].states.push_back(std::move(*states));
      } else if (auto* grants = std::get_if<Grants>(&any)) {
        tail->ticks[tick].grants.push_back(std::move(*grants));
      } else if (auto* edit = std::get_if<EditOrder>(&any)) {
        tail->ticks[tick].edits.push_back(std::move(*edit));
      } else if (auto* meta = std::get_if<Meta>(&any)) {
        tail->ticks[tick].values.push_back(std::move(*meta));
      } else if (auto* event = std::get_if<Event>(&any)) {
        const auto kind = static_cast<EventKind>(event->kind);
        const bool came = kind == EventKind::kJoined || kind == EventKind::kRejoined;
        if (came || kind == EventKind::kLeft) tail->here[event->player] = came;
        for (int p = 0; kind == EventKind::kResumed && p < kPlayersMax; ++p) tail->here[p] = false;
      } else if (auto* room = std::get_if<Room>(&any)) {
        const bool another = tail->summary && tail->summary->session != room->session;
        if (another) tail->summary.reset();
      } else if (auto* summary = std::get_if<Summary>(&any)) {
        if (summary->of == summary->session) tail->summary = std::move(*summary);
      }
    }
  }
  tail->last_tick = std::max(tail->last_tick, tick);
}

/// A seal, as a log ends with one.
struct LogEnd {
  std::uint32_t crc = 0;
  Bytes keyed;
  std::vector<TickMessages> ticks;
};

/// Returns the end that a message is, if it is one, with the server's ticks that it ends.
std::optional<LogEnd> EndOf(const AnyMessage& any, TickSplitter* splitter) {
  const auto read = [&](const auto* seal, Bytes keyed) {
    LogEnd end{static_cast<std::uint32_t>(seal->log_crc), std::move(keyed), {}};
    if (seal->peer == 0) end.ticks = splitter->End(*seal);
    return end;
  };
  const auto* seal = std::get_if<LogSeal>(&any);
  const auto* chain = std::get_if<TickChain>(&any);
  if (seal != nullptr && seal->log_events > 0) return read(seal, seal->log_keyed);
  if (chain != nullptr && chain->log_events > 0) return read(chain, {});
  return std::nullopt;
}

}  // namespace

Status ReadLogTail(const std::string& path, const std::string& room, const LogPlace& from,
                   const Secret* key, LogTail* tail) {
  *tail = LogTail();
  tail->end = from;
  std::unique_ptr<LogReader> log;
  try {
    log = std::make_unique<LogReader>(path, from, key);
  } catch (const OperatorError& error) {
    return Status::Error(error.what());
  }
  TickSplitter splitter;
  LogEvent event;
  while (log->Next(&event)) {
    const bool good = log->intact() && log->skipped_bytes() == 0;
    const bool ours = RoomOfChannel(event.channel) == room;
    AnyMessage any = ours ? Decode(event.data) : AnyMessage();
    std::optional<LogEnd> end = EndOf(any, &splitter);
    if (!good) {
      if (!end) continue;
      tail->damage = path + ": is damaged after tick " + std::to_string(tail->last_tick);
      return Status::Ok();
    }
    if (end) {
      for (TickMessages& tick : end->ticks) AddTick(&tick, tail);
      tail->end = {log->place_bytes(), event.number + 1, end->crc, {}};
      std::copy(end->keyed.begin(), end->keyed.end(), tail->end.keyed.begin());
    } else if (ours && PublisherOfChannel(event.channel) == 0) {
      splitter.Add(std::move(any));
    }
  }
  return Status::Ok();
}

}  // namespace seam
