#include "server/saved/log_tail.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <variant>

#include "common/base/check.h"
#include "common/codec/codec.h"
#include "common/record/log_file.h"

namespace seam {
namespace {

/// Adds what a tick's events say.
void AddTick(std::int64_t tick, std::vector<AnyMessage>* messages, LogTail* tail) {
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
    }
  }
  messages->clear();
  tail->last_tick = std::max(tail->last_tick, tick);
}

}  // namespace

Status ReadLogTail(const std::string& path, const std::string& room, const LogPlace& from,
                   LogTail* tail) {
  *tail = LogTail();
  tail->end = from;
  std::unique_ptr<LogReader> log;
  try {
    log = std::make_unique<LogReader>(path, from);
  } catch (const OperatorError& error) {
    return Status::Error(error.what());
  }
  std::vector<AnyMessage> messages;  // since the last tick's end
  LogEvent event;
  while (log->Next(&event)) {
    const bool good = log->intact() && log->skipped_bytes() == 0;
    const bool ours = RoomOfChannel(event.channel) == room;
    AnyMessage any = ours ? Decode(event.data) : AnyMessage();
    const auto* chain = std::get_if<TickChain>(&any);
    const bool ends = chain != nullptr && chain->log_events > 0;
    if (!good) {
      if (!ends) continue;
      tail->damage = path + ": is damaged after tick " + std::to_string(tail->last_tick);
      return Status::Ok();
    }
    if (!ends) {
      messages.push_back(std::move(any));
      continue;
    }
    if (chain->peer == 0 && chain->messages >= 0) AddTick(chain->tick, &messages, tail);
    tail->end = {log->place_bytes(), event.number + 1, static_cast<std::uint32_t>(chain->log_crc)};
  }
  return Status::Ok();
}

}  // namespace seam
