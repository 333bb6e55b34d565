#pragma once
/// Congestion control of one direction of a link by delay, in the manner of LEDBAT (RFC 6817) and
/// TCP Vegas: the rate at which the path carries datagrams without a queue.
///
///   queue  = least round trip of a look - least round trip of the last 10 to 20 s
///   rate   grows while it is used and the queue is short;
///          falls below the rate at which datagrams arrive when the queue is long
///
/// Loss alone changes nothing: radio links lose datagrams without being full, and do so while the
/// rate is hardly used, which tells their share. A full path without a queue of its own loses all
/// that is too much, so the rate never exceeds kArrivingShare of the bytes that would arrive
/// without that share.

#include <cstddef>
#include <cstdint>

namespace seam {

class LineRate {
 public:
  /// Records that a datagram is sent. Returns the bytes sent so far, with it.
  std::int64_t NoteSent(std::int64_t now_us, std::size_t bytes);
  /// Records that a datagram has arrived.
  void NoteArrived(std::int64_t now_us, std::size_t bytes) {
    heard_us_ = now_us;
    arrived_ += static_cast<double>(bytes);
    ++datagrams_;
  }
  /// Records the round trip of the newest datagram that has arrived. `total`: its result of
  /// NoteSent. Call after NoteArrived of all datagrams of one ack.
  void NoteRoundTrip(std::int64_t now_us, std::int64_t rtt_us, std::int64_t total);

  /// Returns the rate, bytes/s of UDP payload.
  double bytes_per_s() const { return rate_; }
  /// True if the path was full once: the rate is the path's, and not only the need.
  bool full() const { return full_ > 0; }
  /// Returns the delay that traffic adds to the round trip, us, as of the last look.
  std::int64_t queue_us() const { return queue_us_; }

  /// Rate of a new link, bytes/s. It doubles with each look until the path is full.
  static constexpr double kStart = 32000;
  /// Least rate, bytes/s: acks, pings and inputs.
  static constexpr double kLeast = 1500;
  /// Greatest rate, bytes/s: more than any path of a session carries.
  static constexpr double kFastest = 1.25e9;
  /// Time between two looks, us; at least a round trip. Shorter ones mistake jitter for a queue.
  static constexpr std::int64_t kRateLookUs = 200000;
  /// Queue that is left standing, us, besides the jitter and the time between two datagrams.
  static constexpr std::int64_t kQueueUs = 18000;
  static constexpr double kArrivingShare = 1.5;

 private:
  void Look(std::int64_t now_us);
  void Cut(double arriving, bool deep);

  double rate_ = kStart;
  double growth_ = 5;  // of the rate in a second, share of it
  double full_ = 0;    // rate that filled the path at the last cut; 0: none did
  double arrives_ = 1;  // share of the bytes that arrives while the path is not full
  std::int64_t queue_us_ = 0;
  // Least round trip of this epoch of 10 s and of the one before, us; -1: none.
  std::int64_t least_us_ = -1, least_before_us_ = -1, epoch_us_ = 0;
  // Since the last look.
  std::int64_t looked_us_ = -1;  // from which the next look is due; later while a queue drains
  std::int64_t begun_us_ = 0;
  std::int64_t heard_us_ = 0, halved_us_ = 0;  // last arrival, and cut for silence
  std::int64_t rtt_least_us_ = -1, rtt_sum_us_ = 0, rtts_ = 0;
  double sent_ = 0, arrived_ = 0;
  int datagrams_ = 0;       // that have arrived
  std::int64_t total_ = 0;  // bytes sent so far
  std::int64_t newest_ = 0,
               newest_looked_ = 0;  // of them up to the newest arrival; at the last look
  // Cuts in a row, and the queue at the first of them: a queue that does not shrink is not ours.
  int cuts_ = 0;
  std::int64_t cut_queue_us_ = 0;
};

}  // namespace seam
