#pragma once
/// Numbered datagrams through one impaired path, with the exact time at which each arrived.

#include <cstdint>
#include <limits>
#include <set>
#include <vector>

#include "common/net/impair.h"
#include "common/net/memory.h"

namespace seam {

inline const Address kHere{0x7f000001, 1}, kThere{0x7f000001, 2}, kOther{0x7f000001, 3};
constexpr std::int64_t kSecondUs = 1'000'000;

/// Makes a datagram that holds its number, padded to `bytes`.
inline Bytes Numbered(int number, std::size_t bytes = 4) {
  Bytes data(bytes, 0);
  for (std::size_t i = 0; i < 4; ++i) data[i] = static_cast<std::uint8_t>(number >> (8 * i));
  return data;
}

/// Reads the number that Numbered wrote.
inline int NumberOf(const Bytes& data) {
  int number = 0;
  for (std::size_t i = 0; i < 4; ++i) number |= data[i] << (8 * i);
  return number;
}

/// A datagram at its receiver.
struct Arrived {
  int number = 0;
  std::int64_t at_us = 0;
  Bytes data;
  bool operator==(const Arrived& o) const {
    return number == o.number && at_us == o.at_us && data == o.data;
  }
};

/// Parameters of a run; every field has a default.
struct Traffic {
  int count = 1000;  // datagrams sent here -> there
  std::int64_t period_us = 100'000;
  std::size_t bytes = 60;
  std::uint64_t seed = 1;
  bool incoming = false;  // impair at the receiver instead of the sender
  int others = 0;         // per datagram, number of further ones between other addresses
};

/// Sends Traffic::count datagrams through `profile`, and steps from due time to due time, so that
/// arrival times are exact.
inline std::vector<Arrived> Send(const ImpairProfile& profile, const Traffic& run) {
  MemoryNetwork network;
  auto a = network.Attach(kHere), b = network.Attach(kThere), c = network.Attach(kOther);
  Net& inner = run.incoming ? *b : *a;
  ImpairedNet impaired(inner, profile, profile, run.seed);
  Net& sender = run.incoming ? *a : static_cast<Net&>(impaired);
  Net& receiver = run.incoming ? static_cast<Net&>(impaired) : *b;
  std::vector<Arrived> arrived;
  const auto step = [&](std::int64_t now_us) {
    impaired.Advance(now_us);
    Address from;
    Bytes data;
    while (receiver.Receive(&from, &data)) {
      if (from == kHere) arrived.push_back({NumberOf(data), now_us, data});
    }
  };
  for (int i = 0; i < run.count; ++i) {
    const std::int64_t now_us = i * run.period_us;
    while (impaired.next_due_us() < now_us) step(impaired.next_due_us());
    step(now_us);
    for (int k = 0; k < run.others; ++k) {
      (run.incoming ? c.get() : &sender)->Send(run.incoming ? kThere : kOther, Numbered(-1, 900));
    }
    sender.Send(kThere, Numbered(i, run.bytes));
    step(now_us);
  }
  constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();
  while (impaired.next_due_us() < kNever) step(impaired.next_due_us());
  return arrived;
}

/// Returns the share of datagrams without any arrived copy.
inline double LossShare(const std::vector<Arrived>& arrived, const Traffic& run) {
  std::set<int> numbers;
  for (const Arrived& one : arrived) numbers.insert(one.number);
  return 1 - static_cast<double>(numbers.size()) / run.count;
}

/// Returns the mean delay over all arrivals, us.
inline double MeanDelayUs(const std::vector<Arrived>& arrived, const Traffic& run) {
  double sum_us = 0;
  for (const Arrived& one : arrived) {
    sum_us += static_cast<double>(one.at_us - one.number * run.period_us);
  }
  return sum_us / static_cast<double>(arrived.size());
}

}  // namespace seam
