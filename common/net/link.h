#pragma once
/// One connection over Net: sequence numbers, acks, unreliable messages, and a few reliable ordered
/// ones.
///
/// Each datagram is sealed (datagram.h); what the other end did not seal changes nothing.
/// docs/protocol.md is the reference.

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "common/base/bytes.h"
#include "common/base/limits.h"
#include "common/net/line_rate.h"
#include "common/net/net.h"
#include "common/net/seal.h"
#include "common/net/sent_record.h"

namespace seam {

/// Most reliable messages in flight, and their bytes; more wait in a queue. Under loss the slowest
/// message of a window limits the rate: at 25 % loss, 64 small ones were too few for a client's
/// hand-overs.
constexpr int kReliableWindow = 256;
constexpr std::size_t kReliableWindowBytes = 64 * kMessageBytesMax;

/// Number of receipt slots, one for each player's inputs: Link reports the newest arrival per slot.
constexpr int kReceiptSlots = kPlayersMax;
/// The slot for which every arrival is listed (Link::TakeAckedNumbers).
constexpr int kListedSlot = kReceiptSlots;

class Link {
 public:
  /// The other end must have the keys mirrored.
  explicit Link(const SealKeys& keys);
  ~Link();
  Link(Link&&) noexcept;
  Link& operator=(Link&&) noexcept;

  /// Queues a message that is sent once, with the next Flush. Requires 1..kMessageBytesMax bytes.
  /// Beyond 1024 queued messages the oldest is dropped. Receipts: once the datagram that carried
  /// the message is acknowledged, acked(slot) is at least the `number` of each. Requires slots
  /// below kReceiptSlots, or kListedSlot.
  void SendUnreliable(ByteView message, std::vector<Receipt> receipts = {});
  /// Queues a message that is resent until acknowledged and delivered once and in order. Requires
  /// 1..kMessageBytesMax bytes. False when 4096 are queued: the peer is gone or hostile, drop it.
  bool SendReliable(ByteView message);
  /// Like SendReliable, with one speculative duplicate before the retransmission timeout; all
  /// duplicates together take at most 32 kB/s.
  bool SendUrgent(ByteView message);

  /// Tells the link that nothing moves in the room. It is then silent for up to 1.5 s unless a
  /// reliable message needs an ack. Round trips are not sampled, because the peer waits as well.
  void SetQuiet(bool quiet);

  using Sink = std::function<void(ByteView)>;
  /// Packs queued messages into datagrams of at most kDatagramBytesMax and passes them to `send`.
  /// Unacknowledged reliable messages come first, about 9 kB per call, and are resent at intervals
  /// of the round trip so that they do not fill the path. Sends a datagram without messages (acks
  /// only) if nothing was sent for 100 ms or a reliable message has arrived since the last one.
  /// `reliable_bytes`: most bytes of reliable messages, besides one message.
  void Flush(std::int64_t now_us, const Sink& send,
             std::size_t reliable_bytes = std::numeric_limits<std::size_t>::max());

  /// Called for each good new datagram before it has any effect, with its number of messages. If it
  /// returns false, the datagram counts as lost.
  using Gate = std::function<bool(std::size_t messages)>;
  /// Reads a datagram and calls `deliver` for each new message in it, with no bytes for one that is
  /// no short form of a message (short_form.h). Returns false, counts it and
  /// delivers nothing when it does not open, is a duplicate, too old or malformed. `deliver`
  /// may send on this link, but must neither destroy it nor call Receive.
  bool Receive(std::int64_t now_us, ByteView datagram, const Sink& deliver) {
    return Receive(
        now_us, datagram, [](std::size_t) { return true; }, deliver);
  }
  bool Receive(std::int64_t now_us, ByteView datagram, const Gate& gate, const Sink& deliver);

  /// Returns the largest acknowledged `number` of the slot; -1 if none.
  std::int64_t acked(int slot) const;
  /// Returns the numbers of kListedSlot that were acknowledged since the last call.
  std::vector<std::int64_t> TakeAckedNumbers();
  /// Returns true if Flush would send anything now. Costs one comparison while nothing is due: a
  /// server asks all its links at each call.
  bool Sends(std::int64_t now_us) const { return now_us >= idle_until_us_ && SendsNow(now_us); }

  /// Called with each datagram that is sent (`out`) or accepted, as it is without its seal.
  using Watch = std::function<void(ByteView plain, bool out)>;
  void SetWatch(Watch watch);

  std::uint64_t session() const;         ///< number of the session in its datagrams
  std::int64_t sent() const;             ///< number of the newest datagram sent; 0: none
  std::int64_t acknowledged() const;     ///< number of the newest one acknowledged; 0: none
  /// Returns the time at which that one was sent, us: the peer knows what we sent until then, as
  /// far as is known. -1: none.
  std::int64_t known_until_us() const;
  bool received_newest() const;          ///< the last accepted datagram was later than all before
  std::int64_t last_receive_us() const;  ///< -1 before the first
  /// Returns the smoothed round trip (RFC 6298), including the peer's wait for its next datagram;
  /// -1 before the first sample.
  std::int64_t rtt_us() const;
  /// Returns the rate that the path to the peer carries; the owner keeps to it (SendCredit).
  const LineRate& rate() const;
  std::int64_t loss_ppm() const;  ///< share missing of the last 256 incoming sequence numbers
  bool loss_known() const;        ///< true once so many have passed
  std::int64_t rejected() const;  ///< datagrams for which Receive returned false
  /// Returns the time of the last call before which all reliable messages queued have been sent
  /// once, us; on a thin line they wait for their turn. Call it at each tick.
  std::int64_t SentUntilUs(std::int64_t now_us);
  bool reliable_pending() const;  ///< true if a reliable message is not acknowledged yet
  std::size_t waiting() const;    ///< reliable messages not yet acknowledged, at most 4096

 private:
  struct Impl;
  bool SendsNow(std::int64_t now_us) const;
  /// Cancels the idle period: after traffic in or out, the next due time must be computed again.
  void Wake() { idle_until_us_ = std::numeric_limits<std::int64_t>::min(); }

  std::unique_ptr<Impl> impl_;
  /// Nothing is due before this time unless Wake is called.
  mutable std::int64_t idle_until_us_ = std::numeric_limits<std::int64_t>::min();
};

}  // namespace seam
