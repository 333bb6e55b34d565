#pragma once
/// Receives other programs' messages on LCM channels: refuses what is wrong or too much.

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "common/base/status.h"
#include "common/record/bus.h"

namespace seam {

class LcmInbox {
 public:
  /// Takes the bytes of a message; returns one line if it is refused.
  using Take = std::function<Status(const std::string& channel, ByteView message)>;
  /// Each channel may have `per_s` messages a second, and `at_once` together.
  LcmInbox(double per_s, double at_once, Take take)
      : per_s_(per_s), at_once_(at_once), take_(std::move(take)) {}
  LcmInbox(const LcmInbox&) = delete;
  LcmInbox& operator=(const LcmInbox&) = delete;

  /// Listens on a channel of `bus`, which must not be polled after the end of this inbox.
  void Subscribe(Bus& bus, const std::string& channel);
  /// Sets the time by which messages are counted, on any clock.
  void SetTime(std::int64_t now_us) { now_us_ = now_us; }
  /// Handles a message as if it had come on the bus.
  void Receive(const std::string& channel, ByteView message);

  /// Returns lines about refusals since the last call: one at the first message that a channel has
  /// refused for a reason, and at the tenth, the hundredth and so on.
  std::vector<std::string> TakeReports() { return std::exchange(reports_, {}); }
  std::int64_t refused() const { return refused_; }

 private:
  struct Credit {
    double messages = 0;
    std::int64_t since_us = 0;
  };
  bool MayCome(const std::string& channel);

  const double per_s_, at_once_;
  const Take take_;
  std::int64_t now_us_ = 0;
  std::map<std::string, Credit> credits_;
  std::map<std::string, std::int64_t> refused_for_;  // by channel and reason
  std::vector<std::string> reports_;
  std::int64_t refused_ = 0;
};

}  // namespace seam
