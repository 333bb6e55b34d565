#include "common/record/lcm_inbox.h"

#include <algorithm>

namespace seam {
namespace {

bool IsPowerOfTen(std::int64_t n) {
  while (n % 10 == 0) n /= 10;
  return n == 1;
}

}  // namespace

void LcmInbox::Subscribe(Bus& bus, const std::string& channel) {
  std::string regex;
  for (const char c : channel) regex += c == '.' ? std::string("\\.") : std::string(1, c);
  bus.Subscribe(regex, [this](const std::string& from, std::int64_t, ByteView message) {
    Receive(from, message);
  });
}

bool LcmInbox::MayCome(const std::string& channel) {
  const auto [at, first] = credits_.emplace(channel, Credit{at_once_, now_us_});
  Credit& credit = at->second;
  const double passed_s = static_cast<double>(now_us_ - credit.since_us) * 1e-6;
  credit.messages = std::min(at_once_, credit.messages + passed_s * per_s_);
  credit.since_us = now_us_;
  if (credit.messages < 1) return false;
  credit.messages -= 1;
  return true;
}

void LcmInbox::Receive(const std::string& channel, ByteView message) {
  const Status taken =
      MayCome(channel) ? take_(channel, message) : Status::Error("comes too often");
  if (taken.ok()) return;
  ++refused_;
  const std::int64_t count = ++refused_for_[channel + " " + taken.why()];
  if (!IsPowerOfTen(count)) return;
  reports_.push_back("LCM channel " + channel + ": " + std::to_string(count) +
                     " refused: a message " + taken.why());
}

}  // namespace seam
