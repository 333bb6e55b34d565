/// The rate of a path: found without a standing queue, and not throttled by jitter or losses.

#include "common/net/line_rate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <random>
#include <string>
#include <vector>

#include "common/net/send_credit.h"

namespace seam {
namespace line_rate_test {

/// A path of 33 ms each way with a queue of half a second; the peer acknowledges every 17 ms.
struct Path {
  double bits_per_s = 1e9;
  double jitter_ms = 0, loss = 0;  // exponential, each way; share
  double needs = 0;                // bytes/s that the sender has to send
};

struct Outcome {
  double sent = 0;      // bytes/s
  double queue_ms = 0;  // longest
  double mean_ms = 0;   // queue, over the datagrams
  int datagrams = 0;
  double lost = 0;  // bytes that the full queue lost
};

class Sender {
 public:
  explicit Sender(const Path& path) : path_(path) {}

  /// Runs for some seconds; returns what happened in them.
  Outcome Run(double seconds) {
    outcome_ = {};
    for (const double end = now_ms_ + 1000 * seconds; now_ms_ < end; ++now_ms_) {
      if (static_cast<int>(now_ms_) % 17 == 0) Send();
      if (static_cast<int>(now_ms_) % 17 == 5) Acknowledge();
      TakeAcks();
    }
    outcome_.sent /= seconds;
    outcome_.mean_ms /= std::max(1, outcome_.datagrams);
    return outcome_;
  }
  Path& path() { return path_; }
  const LineRate& rate() const { return rate_; }

 private:
  struct Datagram {
    double sent_ms, arrives_ms;
    std::size_t bytes;
    std::int64_t total;
  };
  struct Acks {
    double at_ms;
    std::vector<Datagram> of;
  };
  std::int64_t now_us() const { return 1000000 + static_cast<std::int64_t>(1000 * now_ms_); }
  double Jitter() {
    if (path_.jitter_ms <= 0) return 0;
    return std::exponential_distribution<>(1 / path_.jitter_ms)(random_);
  }
  void Send() {
    waiting_ = std::min(waiting_ + 0.017 * path_.needs, 0.1 * path_.needs);
    credit_.Fill(now_us(), rate_.bytes_per_s());
    if (!credit_.Ready()) return;
    for (double may = std::min(waiting_, credit_.bytes()); may > 20;) {
      const double part = std::min(may, 1100.0);
      may -= part;
      waiting_ -= part;
      SendOne(static_cast<std::size_t>(part) + 24);
    }
  }
  void SendOne(std::size_t bytes) {
    credit_.Spend(bytes);
    outcome_.sent += static_cast<double>(bytes);
    const std::int64_t total = rate_.NoteSent(now_us(), bytes);
    const double begins = std::max(free_ms_, now_ms_);
    if (begins - now_ms_ > 500) {
      outcome_.lost += static_cast<double>(bytes);
      return;
    }
    free_ms_ = begins + 8000 * static_cast<double>(bytes + 28) / path_.bits_per_s;
    outcome_.queue_ms = std::max(outcome_.queue_ms, begins - now_ms_);
    outcome_.mean_ms += begins - now_ms_;
    ++outcome_.datagrams;
    last_ms_ = std::max(last_ms_, free_ms_ + 33 + Jitter());
    if (std::uniform_real_distribution<>()(random_) < path_.loss) return;
    on_way_.push_back({now_ms_, last_ms_, bytes, total});
  }
  void Acknowledge() {
    Acks acks;
    for (; !on_way_.empty() && on_way_.front().arrives_ms <= now_ms_; on_way_.pop_front()) {
      acks.of.push_back(on_way_.front());
    }
    if (acks.of.empty()) return;
    back_ms_ = std::max(back_ms_, now_ms_ + 33 + Jitter());
    acks.at_ms = back_ms_;
    acks_.push_back(acks);
  }
  void TakeAcks() {
    for (; !acks_.empty() && acks_.front().at_ms <= now_ms_; acks_.pop_front()) {
      for (const Datagram& one : acks_.front().of) rate_.NoteArrived(now_us(), one.bytes);
      const Datagram& newest = acks_.front().of.back();
      rate_.NoteRoundTrip(now_us(), static_cast<std::int64_t>(1000 * (now_ms_ - newest.sent_ms)),
                          newest.total);
    }
  }

  Path path_;
  LineRate rate_;
  SendCredit credit_;
  std::mt19937 random_{1};
  std::deque<Datagram> on_way_;
  std::deque<Acks> acks_;
  Outcome outcome_;
  double now_ms_ = 0, waiting_ = 0, free_ms_ = 0, last_ms_ = 0, back_ms_ = 0;
};

TEST(LineRate, FillsAThinLineWithoutAStandingQueue) {
  for (const double kb : {40, 64, 128, 256, 1000}) {
    SCOPED_TRACE(std::to_string(kb) + " kb/s");
    Sender sender({1000 * kb, 0, 0, 300 * kb});
    sender.Run(6);
    const Outcome outcome = sender.Run(20);
    EXPECT_TRUE(sender.rate().full());
    EXPECT_GT(outcome.sent, 0.6 * 125 * kb) << "of which a third may be headers";
    EXPECT_LT(outcome.sent, 125 * kb);
    EXPECT_LT(outcome.mean_ms, 60);
    EXPECT_LT(outcome.queue_ms, 250);
    EXPECT_EQ(outcome.lost, 0);
  }
}

TEST(LineRate, FollowsALineThatBecomesThinAndWideAgain) {
  Sender sender({5e6, 0, 0, 20000});
  EXPECT_NEAR(sender.Run(4).sent, 20000, 2500);
  sender.path().bits_per_s = 64000;
  sender.Run(4);
  EXPECT_LT(sender.Run(10).mean_ms, 60);
  sender.path().bits_per_s = 5e6;
  sender.Run(12);
  EXPECT_NEAR(sender.Run(4).sent, 20000, 2500);
}

TEST(LineRate, JitterAndLossesOfWideLinesThrottleNothing) {
  for (const Path& path : {Path{5e6, 20, 0.04, 30000}, Path{5e6, 10, 0.01, 60000},
                           Path{5e6, 0, 0.2, 20000}, Path{2e6, 30, 0.07, 20000}}) {
    SCOPED_TRACE(std::to_string(path.jitter_ms) + " ms, loss " + std::to_string(path.loss));
    Sender sender(path);
    sender.Run(2);
    EXPECT_GT(sender.Run(30).sent, 0.93 * path.needs);
  }
}

/// The losses are there while little is sent, so that more does not cause them.
TEST(LineRate, TheRateOfALossyLineGrowsWithTheNeed) {
  for (const Path& path : {Path{5e6, 0, 0.3, 30000}, Path{5e6, 20, 0.3, 20000},
                           Path{5e6, 10, 0.2, 60000}, Path{2e6, 20, 0.4, 20000}}) {
    SCOPED_TRACE(std::to_string(path.jitter_ms) + " ms, loss " + std::to_string(path.loss));
    Sender sender(path);
    for (const int seconds : {4, 20}) {  // the rate falls to the need, or nearly so
      sender.path().needs = 2500;
      sender.Run(seconds);
      sender.path().needs = path.needs;
      sender.Run(4);
      EXPECT_GT(sender.Run(20).sent, 0.85 * path.needs);
    }
  }
}

TEST(LineRate, AQueueThatIsNotOursIsTakenForThePath) {
  Sender sender({5e6, 0, 0, 20000});
  sender.Run(4);
  LineRate rate = sender.rate();
  std::int64_t now_us = 100'000'000, total = 1'000'000;
  for (int i = 0; i < 1200; ++i) {  // 20 s of 200 ms instead of 66, whatever is sent
    now_us += 16667;
    total = rate.NoteSent(now_us, static_cast<std::size_t>(rate.bytes_per_s() / 60));
    rate.NoteArrived(now_us, static_cast<std::size_t>(rate.bytes_per_s() / 60));
    rate.NoteRoundTrip(now_us, 200000, total);
  }
  EXPECT_GT(rate.bytes_per_s(), 20000);
}

/// A peer at rest answers late: its round trips are not sampled (Link::SetQuiet).
TEST(LineRate, ArrivalsWithoutRoundTripsDoNotLowerIt) {
  LineRate rate;
  std::int64_t now_us = 1'000'000;
  for (int i = 0; i < 600; ++i) {
    now_us += 16667;
    const auto bytes = static_cast<std::size_t>(rate.bytes_per_s() / 60) + 1;
    rate.NoteSent(now_us, bytes);
    if (i % 6 == 0) rate.NoteArrived(now_us, bytes);
  }
  EXPECT_EQ(rate.bytes_per_s(), LineRate::kStart);
}

TEST(LineRate, ALineThatCarriesNothingIsLeftAlone) {
  LineRate rate;
  std::int64_t now_us = 1'000'000;
  for (int i = 0; i < 600; ++i) {
    now_us += 16667;
    rate.NoteSent(now_us, static_cast<std::size_t>(rate.bytes_per_s() / 60) + 1);
  }
  EXPECT_EQ(rate.bytes_per_s(), LineRate::kLeast);
}

}  // namespace line_rate_test
}  // namespace seam
