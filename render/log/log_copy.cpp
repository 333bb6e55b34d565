#include "render/log/log_copy.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <type_traits>
#include <variant>

#include "common/base/check.h"
#include "common/base/plain_file.h"

namespace seam {
namespace {

/// Most bytes of a copy without a seal, when the copied log has none: bounds a damaged part.
constexpr std::size_t kUnsealedBytesMax = 65536;

template <class Message, class = void>
struct HasTick : std::false_type {};
template <class Message>
struct HasTick<Message, std::void_t<decltype(std::declval<Message>().tick)>> : std::true_type {};

}  // namespace

std::optional<LogSeal> SealOf(const AnyMessage& message) {
  LogSeal seal;
  if (const auto* is = std::get_if<LogSeal>(&message)) {
    seal = *is;
  } else if (const auto* chain = std::get_if<TickChain>(&message)) {
    seal.utime = chain->utime;
    seal.session = chain->session;
    seal.sequence = static_cast<std::int32_t>(chain->sequence & INT32_MAX);
    seal.peer = chain->peer;
    seal.tick = chain->tick;
    seal.messages = chain->messages;
    seal.messages_crc = chain->messages_crc;
  } else {
    return std::nullopt;
  }
  seal.log_events = seal.log_crc = 0;
  seal.log_keyed.clear();
  return seal;
}

std::optional<std::int64_t> TickOfMessage(const AnyMessage& message) {
  return std::visit(
      [](const auto& m) -> std::optional<std::int64_t> {
        using M = std::decay_t<decltype(m)>;
        if constexpr (std::is_same_v<M, Inputs>) {
          return m.first_tick;
        } else if constexpr (HasTick<M>::value) {
          return m.tick;
        } else {
          return std::nullopt;
        }
      },
      message);
}

LogCopy::LogCopy(const std::string& path, bool force, const std::vector<std::string>& read)
    : path_(path), unfinished_(path + ".tmp") {
  RequireOutput(path, force, read);
  log_ = std::make_unique<RoomLog>(unfinished_, true, nullptr);
}

LogCopy::~LogCopy() {
  if (log_ != nullptr) std::remove(unfinished_.c_str());
}

void LogCopy::Add(const LogEvent& event, std::int64_t timestamp_us, const AnyMessage& message) {
  if (const std::optional<LogSeal> seal = SealOf(message)) {
    log_->EndTick(event.channel, *seal, true);
    unsealed_bytes_ = 0;
  } else {
    log_->Publish(event.channel, timestamp_us, event.data);
    unsealed_bytes_ += event.data.size();
  }
  if (unsealed_bytes_ < kUnsealedBytesMax) return;
  log_->Flush();
  unsealed_bytes_ = 0;
}

void LogCopy::Finish() {
  log_->Flush();
  events_ = log_->Pin().number;
  if (!log_->trouble().ok()) throw OperatorError(log_->trouble().why());
  if (std::rename(unfinished_.c_str(), path_.c_str()) != 0) {
    throw OperatorError(path_ + ": cannot be written: " + std::strerror(errno));
  }
  log_.reset();
}

}  // namespace seam
