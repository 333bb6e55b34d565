#pragma once
/// One conversation over Net: sequence, acks, unreliable messages and a few reliable ordered ones.
///
///   datagram:  magic u32 | checksum u32 | session u64 | sequence u16 | ack u16 | ack_bits u32 |
///              messages...
///   message:   header u16 (bit 15: reliable, bits 0..14: bytes) | [reliable id u16] | bytes
///
/// All big-endian; the checksum is CRC-32C over all other bytes. docs/protocol.md is the reference.

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "common/base/bytes.h"
#include "common/base/limits.h"
#include "common/net/net.h"
#include "common/net/sent_record.h"

namespace seam {

/// Reliable messages in flight, and their bytes; more wait in a queue. Of each window under loss
/// the slowest decides: 64 small ones were less than a holder's hand-overs at a quarter lost.
constexpr int kReliableWindow = 256;
constexpr std::size_t kReliableWindowBytes = 64 * kMessageBytesMax;

/// Kinds of unreliable messages whose arrival can be asked for: one for each player's inputs.
constexpr int kReceiptSlots = kPlayersMax;
/// The slot of messages of which each that arrives is told (Link::TakeArrived).
constexpr int kListedSlot = kReceiptSlots;

class Link {
 public:
  /// Both ends must have the same session number (not 0); the client draws it at random.
  explicit Link(std::uint64_t session);
  ~Link();
  Link(Link&&) noexcept;
  Link& operator=(Link&&) noexcept;

  /// Sent once with the next Flush. Requires 1..kMessageBytesMax bytes. Of more than 1024 without a
  /// Flush the oldest are forgotten. With receipts: once a datagram that carried it has been
  /// acknowledged, acked(slot) is at least the `number` of each. Requires slots below
  /// kReceiptSlots, or kListedSlot.
  void SendUnreliable(ByteView message, std::vector<Receipt> receipts = {});
  /// Repeated until acknowledged, delivered once and in order. Requires 1..kMessageBytesMax bytes.
  /// False when 4096 are waiting: the peer is gone or hostile, drop it.
  bool SendReliable(ByteView message);
  /// The same, for what somebody waits for: repeated once on the chance that it is lost, at most
  /// 32 kB/s, before its acknowledgement is late.
  bool SendUrgent(ByteView message);

  /// Nothing happens in the room: acks by themselves can wait for a second and a half, and what the
  /// peer then lets pass until its next datagram is no round trip.
  void SetQuiet(bool quiet);

  using Sink = std::function<void(ByteView)>;
  /// Packs what is queued into datagrams of at most kDatagramBytesMax and gives them to `send`.
  /// Unacknowledged reliable messages ride along first, spaced by the round trip so that they do
  /// not fill the path, about 9 kB of them in one call. Sends a datagram without messages (acks
  /// only) if nothing was sent for 100 ms, and when something reliable has arrived since the last.
  void Flush(std::int64_t now_us, const Sink& send);

  /// Takes a datagram; calls `deliver` for each message in it that is new. False (and counted)
  /// when it is malformed, of another session, a duplicate or too old; nothing is delivered then.
  /// `deliver` may send on this link, but must neither destroy it nor call Receive.
  bool Receive(std::int64_t now_us, ByteView datagram, const Sink& deliver);
  /// Asked for a datagram that is good and new, before anything follows from it: may so many
  /// messages come? If not, it is as if the datagram had been lost.
  using Gate = std::function<bool(std::size_t messages)>;
  bool Receive(std::int64_t now_us, ByteView datagram, const Gate& gate, const Sink& deliver);

  /// Largest number of the slot's messages that arrived, as far as we know; -1: none.
  std::int64_t acked(int slot) const;
  /// Numbers of the messages of kListedSlot that arrived, as far as we know, since the last call.
  std::vector<std::int64_t> TakeArrived();
  /// Whether Flush would send anything now. Costs a comparison as long as nothing is due: a server
  /// asks each of its links in every call.
  bool Sends(std::int64_t now_us) const { return now_us >= idle_until_us_ && SendsNow(now_us); }

  std::int64_t last_receive_us() const;  ///< -1 before the first
  /// Smoothed (RFC 6298), with the time the peer lets pass until its next datagram; -1 before the
  /// first sample.
  std::int64_t rtt_us() const;
  std::int64_t loss_ppm() const;  ///< missing of the last 256 incoming sequence numbers
  std::int64_t rejected() const;  ///< datagrams Receive returned false for
  bool reliable_pending() const;  ///< something sent reliably is not acknowledged yet
  std::size_t waiting() const;    ///< messages that do: of 4096 at most

 private:
  struct Impl;
  bool SendsNow(std::int64_t now_us) const;
  /// Something has come in or is to go out: what is due when has to be looked at anew.
  void Wake() { idle_until_us_ = std::numeric_limits<std::int64_t>::min(); }

  std::unique_ptr<Impl> impl_;
  /// Before that nothing is sent unless Wake is called.
  mutable std::int64_t idle_until_us_ = std::numeric_limits<std::int64_t>::min();
};

}  // namespace seam
