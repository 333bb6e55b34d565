#include "server/sessions/traffic_budget.h"

#include <algorithm>
#include <string>

#include "common/codec/codec.h"
#include "common/net/datagram.h"
#include "common/sync/limits.h"
#include "common/sync/send_scheduler.h"

namespace seam {
namespace {

/// Ticks of input in one Inputs message, at most, as clients send them (client.h).
constexpr std::size_t kInputsUsual = 16;
/// Pings a second while the clock settles, and their bytes.
constexpr double kPingsPerSecond = 20;
/// Eight bytes of LCM's hash, and the fields of ping_t.
constexpr std::size_t kPingBytes = 8 + 8 + 4 + 8 + 8 + 2 + 2 + 4 + 2;
/// Most messages per send of States in our scenes: one for each 120 m that the bodies extend, and
/// one for each kStatesBodiesMax bodies. (Bodies a send: kBodiesPerSend.)
constexpr std::size_t kStatesPerSend = 12;
/// Reliable messages a second (proposals, releases; a whole window), and bytes of each.
constexpr double kReliablePerSecond = 64;
constexpr std::size_t kReliableBytes = 128;

double Framed(std::size_t bytes, bool reliable = false) {
  return static_cast<double>(FramedBytes(bytes, reliable));
}

/// Messages of states for each send: a path may hold back kKindBurstS of them and release them at
/// once. Bodies of a datagram, at least: a holder of more sends several each time.
constexpr double kStatesMargin = 3;
constexpr std::size_t kBodiesPerDatagram = 64;
/// Edits that a client's physics finds, and reports of impacts or touches, a second. A house that
/// falls breaks a hundred bonds at once: kProposalsBurst.
constexpr double kProposalsPerSecond = 20, kReportsPerSecond = 60;
constexpr double kProposalsBurst = 256;
constexpr double kKindBurstS = 4;

}  // namespace

KindBudget::KindBudget(int send_hz, std::size_t parts) {
  const double datagrams = 1 + static_cast<double>(parts / kBodiesPerDatagram);
  states_.per_second = kStatesMargin * send_hz * datagrams;
  proposals_.per_second = kProposalsPerSecond;
  reports_.per_second = kReportsPerSecond;
  for (Bucket* bucket : {&states_, &proposals_, &reports_}) {
    bucket->most = bucket->left = kKindBurstS * bucket->per_second;
  }
  proposals_.most = proposals_.left = kProposalsBurst;
}

KindBudget::Bucket* KindBudget::BucketOf(ByteView message) {
  const MessageType* const type = FindType(message);
  const std::string name = type == nullptr ? "" : type->name;
  if (name == "states_t" || name == "packed_states_t") return &states_;
  if (name == "edit_t") return &proposals_;
  return name == "impact_report_t" || name == "touch_report_t" ? &reports_ : nullptr;
}

bool KindBudget::Take(std::int64_t now_us, ByteView message) {
  Bucket* const bucket = BucketOf(message);
  if (bucket == nullptr) return true;
  const double passed =
      bucket->filled_us < 0
          ? 0
          : static_cast<double>(std::max<std::int64_t>(0, now_us - bucket->filled_us)) / 1e6;
  bucket->filled_us = now_us;
  bucket->left = std::min(bucket->most, bucket->left + passed * bucket->per_second);
  if (bucket->left < 1) return false;
  bucket->left -= 1;
  return true;
}

TrafficRate HonestTraffic(int tick_hz, int send_hz) {
  TrafficRate rate;
  const double per_send = static_cast<double>(kStatesPerSend);
  // One datagram a tick, and one for the acknowledgement of each reliable message.
  const double datagrams = tick_hz + kReliablePerSecond;
  rate.messages = datagrams + tick_hz + kPingsPerSecond + send_hz * per_send + kReliablePerSecond;
  rate.bytes = datagrams * static_cast<double>(kDatagramOverheadBytes) +
               tick_hz * Framed(Largest(kInputsBytes, kInputsUsual)) +
               kPingsPerSecond * Framed(kPingBytes) +
               send_hz * (per_send * Framed(kStatesBytes.empty) +
                          static_cast<double>(kStatesBytes.each * kBodiesPerSend)) +
               kReliablePerSecond * Framed(kReliableBytes, true);
  return rate;
}

TrafficRate AllowedTraffic(int tick_hz, int send_hz) {
  const TrafficRate honest = HonestTraffic(tick_hz, send_hz);
  return {honest.bytes * kBudgetMargin, honest.messages * kBudgetMargin};
}

TrafficBudget::TrafficBudget(const TrafficRate& allowed)
    : allowed_(allowed), left_{allowed.bytes * kBudgetBurst, allowed.messages * kBudgetBurst} {}

bool TrafficBudget::Take(std::int64_t now_us, std::size_t bytes, std::size_t messages) {
  const double passed =
      filled_us_ < 0 ? 0
                     : static_cast<double>(std::max<std::int64_t>(0, now_us - filled_us_)) / 1e6;
  filled_us_ = now_us;
  left_.bytes = std::min(allowed_.bytes * kBudgetBurst, left_.bytes + passed * allowed_.bytes);
  left_.messages =
      std::min(allowed_.messages * kBudgetBurst, left_.messages + passed * allowed_.messages);
  const auto weight = static_cast<double>(messages + 1);
  if (static_cast<double>(bytes) <= left_.bytes && weight <= left_.messages) {
    left_.bytes -= static_cast<double>(bytes);
    left_.messages -= weight;
    return true;
  }
  if (over_us(now_us) == 0) over_since_us_ = now_us;
  refused_us_ = now_us;
  return false;
}

std::int64_t TrafficBudget::over_us(std::int64_t now_us) const {
  const bool over = refused_us_ >= 0 && now_us - refused_us_ < kBudgetCalmUs;
  return over ? std::max<std::int64_t>(1, now_us - over_since_us_) : 0;
}

}  // namespace seam
