#include "common/net/link.h"

#include <algorithm>
#include <array>
#include <deque>
#include <utility>
#include <vector>

#include "common/base/check.h"
#include "common/codec/short_form.h"
#include "common/net/datagram.h"
#include "common/net/reliable_inbox.h"
#include "common/net/reliable_queue.h"
#include "common/net/sent_record.h"
#include "common/net/sequence_window.h"

namespace seam {
namespace {

/// Most unreliable messages queued for a Flush.
constexpr std::size_t kUnreliableQueueMax = 1024;
/// Datagrams remembered until their ack: 600 ms at 1700 a second. A later ack is ignored.
constexpr std::size_t kSentRecords = 1024;
/// Silence after which a datagram with acks only is sent, us; the second in a quiet room.
constexpr std::int64_t kIdleUs = 100'000;
constexpr std::int64_t kIdleQuietUs = 1'500'000;
/// Minimum retransmission timeout, us; normally it is 1.25 round trips.
constexpr std::int64_t kTimeoutUsMin = 50'000;
/// Sequence numbers that one ack field and its 32 bits cover.
constexpr std::int64_t kAckSpan = 33;
/// Acknowledged records kept for reuse of their memory.
constexpr std::size_t kSpareRecords = 16;

}  // namespace

struct Link::Impl {
  const Seal seal;

  std::int64_t sequence = 0;         // number of the newest datagram sent; the first is 1
  std::int64_t acknowledged = 0;     // number of the newest datagram known to have arrived
  std::int64_t known_until_us = -1;  // when that was sent
  std::int64_t last_send_us = -1;
  std::deque<Passing> unreliable;
  std::array<std::int64_t, kReceiptSlots + 1> arrived;  // by slot, the largest acknowledged number
  std::vector<std::int64_t> listed;                     // acknowledged numbers of kListedSlot
  ReliableQueue reliable;
  std::deque<SentRecord> sent;  // for successive sequence numbers up to the newest
  std::vector<SentRecord> spare;
  std::int64_t srtt_us = -1;
  LineRate rate;
  bool ever_acked = false;
  std::int64_t acks_newest = 0;  // largest acknowledged sequence number
  std::uint64_t acks_seen = 0;   // bit i: acks_newest - i is acknowledged
  bool quiet = false;
  const SentRecord* sampled = nullptr;  // in ReadAcks: the newest that it acknowledges

  SequenceWindow window;
  std::int64_t flushed_newest = -1;  // window.newest() at the last Flush
  bool ack_pending = false;          // a reliable message came since the last datagram sent
  bool newest = false;               // the last accepted datagram was later than all before it
  ReliableInbox inbox;
  std::int64_t last_receive_us = -1;
  std::int64_t rejected = 0;

  // Scratch of one Flush or Receive, kept for their memory.
  DatagramWriter writer;
  SentRecord carried;  // contents of the datagram in the writer
  std::vector<std::int64_t> acks;
  Bytes plain;  // the datagram being received, opened
  Bytes whole;  // the message being delivered
  std::vector<DatagramMessage> messages;
  Watch watch;

  explicit Impl(const SealKeys& keys) : seal(keys) { arrived.fill(-1); }

  // ---- sending

  /// Progress of one Flush; `writer` is the datagram being filled, `carried` its record.
  struct Packing {
    std::int64_t now_us;
    const Sink& send;
    std::size_t datagrams = 0;
  };

  /// Finds the ack fields, newest first, that together cover all arrivals since the last Flush.
  /// Usually one; more if over 33 datagrams have come.
  void FindAckPoints() {
    acks.clear();
    std::int64_t at = window.newest();
    const std::int64_t oldest = window.newest() - SequenceWindow::kSize;
    while (!window.empty() && at > oldest && (acks.empty() || at > flushed_newest)) {
      if (window.Has(at)) {
        acks.push_back(at);
        at -= kAckSpan;
      } else {
        --at;
      }
    }
  }

  /// Records the contents of the datagram in the writer.
  void RecordSent(std::int64_t now_us) {
    if (sent.size() >= kSentRecords) sent.pop_front();
    carried.sent_us = now_us;
    sent.push_back(std::exchange(carried, {}));
    if (spare.empty()) return;
    carried = std::move(spare.back());
    spare.pop_back();
  }

  /// Sends the datagram in the writer, which may be empty.
  void Emit(Packing& packing) {
    DatagramHeader header;
    header.sequence = ++sequence;
    if (!acks.empty()) {
      const std::int64_t ack = acks[std::min(packing.datagrams, acks.size() - 1)];
      header.ack = static_cast<std::uint16_t>(ack);
      header.ack_bits = window.BitsBefore(ack);
    }
    carried.bytes = writer.bytes();
    carried.total = rate.NoteSent(packing.now_us, carried.bytes);
    RecordSent(packing.now_us);
    if (watch) watch(writer.plain(), true);
    packing.send(writer.Finish(header, seal));
    ++packing.datagrams;
    writer.Clear();
    last_send_us = packing.now_us;
    ack_pending = false;
  }

  void Pack(Packing& packing, const DatagramMessage& message) {
    const std::size_t bytes = FramedBytes(message.bytes.size, message.reliable);
    if (writer.bytes() + bytes > kDatagramBytesMax) Emit(packing);
    writer.Append(message);
  }

  /// Returns true if a datagram must be sent even without messages.
  bool MustSendDatagram(std::int64_t now_us) const {
    return ack_pending || last_send_us < 0 ||
           now_us - last_send_us >= (quiet ? kIdleQuietUs : kIdleUs);
  }

  bool Sends(std::int64_t now_us) const {
    if (!unreliable.empty() || MustSendDatagram(now_us)) return true;
    return reliable.Due(now_us);
  }

  /// Returns the time until which nothing is due, provided that nothing is due now.
  std::int64_t IdleUntilUs() const {
    return std::min(last_send_us + (quiet ? kIdleQuietUs : kIdleUs), reliable.DueUs());
  }

  void Flush(std::int64_t now_us, const Sink& send, std::size_t reliable_bytes) {
    FindAckPoints();
    Packing packing{now_us, send};
    const bool rides = !unreliable.empty() || MustSendDatagram(now_us);
    reliable.Take(now_us, rides, reliable_bytes, [&](std::int64_t id, ByteView message) {
      Pack(packing, {true, static_cast<std::uint16_t>(id), message});
      carried.ids.push_back(id);
    });
    for (const Passing& message : unreliable) {
      Pack(packing, {false, 0, message.bytes});
      for (const Receipt& receipt : message.receipts) carried.receipts.push_back(receipt);
    }
    unreliable.clear();
    if (!writer.empty() || MustSendDatagram(now_us)) Emit(packing);
    while (packing.datagrams > 0 && packing.datagrams < acks.size()) Emit(packing);
    if (packing.datagrams > 0) flushed_newest = window.newest();
  }

  // ---- receiving

  void SampleRtt(std::int64_t sample_us) {
    if (sample_us < 0) return;
    srtt_us = srtt_us < 0 ? sample_us : srtt_us + (sample_us - srtt_us) / 8;
    reliable.SetRetransmissionTimeout(std::max(srtt_us + srtt_us / 4, kTimeoutUsMin));
  }

  /// Marks datagram `number` as arrived. Karn's rule (never time a retransmission) holds by itself:
  /// a resent message travels in a new datagram with a new number.
  void Acknowledge(std::int64_t number, std::int64_t now_us, bool sample) {
    const auto age = static_cast<std::size_t>(sequence - number);
    if (age >= sent.size()) return;  // no longer recorded
    SentRecord& record = sent[sent.size() - 1 - age];
    if (record.acked) return;
    record.acked = ever_acked = true;
    if (number > acknowledged) acknowledged = number, known_until_us = record.sent_us;
    rate.NoteArrived(now_us, record.bytes);
    if (sample && !quiet) {
      SampleRtt(now_us - record.sent_us);
      sampled = &record;
    }
    for (const Receipt& receipt : record.receipts) {
      std::int64_t& largest = arrived[static_cast<std::size_t>(receipt.slot)];
      largest = std::max(largest, receipt.number);
      if (receipt.slot == kListedSlot) listed.push_back(receipt.number);
    }
    for (const std::int64_t id : record.ids) reliable.MarkAcked(id);
    Spare(&record);
  }

  /// Clears an acknowledged record and keeps its memory for reuse.
  void Spare(SentRecord* record) {
    record->ids.clear();
    record->receipts.clear();
    const bool worth = record->ids.capacity() + record->receipts.capacity() > 0;
    if (!worth || spare.size() >= kSpareRecords) return;
    spare.emplace_back();
    spare.back().ids.swap(record->ids);
    spare.back().receipts.swap(record->receipts);
  }

  /// Returns true if the datagram is known to be acknowledged, and marks it so. Each datagram is
  /// acknowledged by up to 33 others; this saves all but the first look at its record.
  bool Seen(std::int64_t number) {
    if (number > acks_newest) {
      const std::int64_t by = number - acks_newest;
      acks_seen = by < 64 ? acks_seen << by : 0;
      acks_newest = number;
    }
    const std::int64_t age = acks_newest - number;
    if (age >= 64) return false;
    const std::uint64_t bit = std::uint64_t{1} << age;
    const bool seen = (acks_seen & bit) != 0;
    acks_seen |= bit;
    return seen;
  }

  void ReadAcks(std::int64_t ack, std::uint32_t bits, std::int64_t now_us) {
    // All zeros mean "nothing has arrived" until the first real ack.
    if (!ever_acked && static_cast<std::uint16_t>(ack) == 0 && bits == 0) return;
    sampled = nullptr;
    if (!Seen(ack)) Acknowledge(ack, now_us, true);
    for (int i = 0; i < 32; ++i) {
      const bool arrived_too = ((bits >> i) & 1u) != 0;
      if (arrived_too && !Seen(ack - 1 - i)) Acknowledge(ack - 1 - i, now_us, false);
    }
    if (sampled == nullptr) return;
    rate.NoteRoundTrip(now_us, now_us - sampled->sent_us, sampled->total);
  }

  void DeliverReliable(std::int64_t now_us, const DatagramMessage& message, const Sink& deliver) {
    const bool repeated = inbox.Has(message.id);
    // A repeated message was acknowledged before, but that ack may have been lost.
    ack_pending = ack_pending || !repeated || now_us - last_send_us >= kTimeoutUsMin;
    if (!repeated) inbox.Take(message, deliver);
  }

  bool Receive(std::int64_t now_us, ByteView datagram, const Gate& gate, const Sink& deliver) {
    if (SessionOfDatagram(datagram) != seal.session()) return false;
    const std::int64_t number = window.Full(SequenceOfDatagram(datagram));
    DatagramHeader header;
    // Nothing of this link changes before the datagram has opened.
    if (!window.IsNew(number) || !OpenDatagram(datagram, seal, number, &plain, &header)) {
      return false;
    }
    const std::int64_t ack = Unwrap(header.ack, sequence);
    if (ack > sequence) return false;
    if (!ReadMessages(plain, &messages) || !inbox.InWindow(messages)) return false;
    if (!gate(messages.size())) return false;
    if (watch) watch(plain, false);
    newest = window.empty() || number > window.newest();
    window.Insert(number);
    last_receive_us = now_us;
    ReadAcks(ack, header.ack_bits, now_us);
    const Sink deliver_whole = [&](ByteView bytes) {
      if (!ReadShortForm(bytes, &whole)) whole.clear();  // of no type: the owner counts it
      deliver(whole);
    };
    for (const DatagramMessage& message : messages) {
      if (message.reliable) {
        DeliverReliable(now_us, message, deliver_whole);
      } else {
        deliver_whole(message.bytes);
      }
    }
    return true;
  }
};

Link::Link(const SealKeys& keys) : impl_(std::make_unique<Impl>(keys)) {}
Link::~Link() = default;
Link::Link(Link&&) noexcept = default;
Link& Link::operator=(Link&&) noexcept = default;

void Link::SendUnreliable(ByteView message, std::vector<Receipt> receipts) {
  for (const Receipt& receipt : receipts) {
    SEAM_ASSERT(receipt.slot >= 0 && receipt.slot <= kListedSlot);
  }
  Wake();
  if (impl_->unreliable.size() >= kUnreliableQueueMax) impl_->unreliable.pop_front();
  impl_->unreliable.push_back({ShortForm(message), std::move(receipts)});
}

bool Link::SendReliable(ByteView message) {
  Wake();
  return impl_->reliable.Push(ShortForm(message), false);
}

bool Link::SendUrgent(ByteView message) {
  Wake();
  return impl_->reliable.Push(ShortForm(message), true);
}

void Link::Flush(std::int64_t now_us, const Sink& send, std::size_t reliable_bytes) {
  if (!Sends(now_us)) return;
  Wake();
  impl_->Flush(now_us, send, reliable_bytes);
}

bool Link::Receive(std::int64_t now_us, ByteView datagram, const Gate& gate, const Sink& deliver) {
  Wake();
  const bool accepted = impl_->Receive(now_us, datagram, gate, deliver);
  if (!accepted) ++impl_->rejected;
  return accepted;
}

void Link::SetQuiet(bool quiet) {
  if (impl_->quiet == quiet) return;
  impl_->quiet = quiet;
  Wake();
}
std::int64_t Link::acked(int slot) const {
  SEAM_ASSERT(slot >= 0 && slot < kReceiptSlots);
  return impl_->arrived[static_cast<std::size_t>(slot)];
}
std::vector<std::int64_t> Link::TakeAckedNumbers() { return std::exchange(impl_->listed, {}); }
bool Link::SendsNow(std::int64_t now_us) const {
  if (impl_->Sends(now_us)) return true;
  idle_until_us_ = impl_->IdleUntilUs();
  return false;
}
void Link::SetWatch(Watch watch) { impl_->watch = std::move(watch); }
std::int64_t Link::sent() const { return impl_->sequence; }
std::int64_t Link::acknowledged() const { return impl_->acknowledged; }
bool Link::received_newest() const { return impl_->newest; }
std::uint64_t Link::session() const { return impl_->seal.session(); }
std::int64_t Link::last_receive_us() const { return impl_->last_receive_us; }
std::int64_t Link::known_until_us() const { return impl_->known_until_us; }
std::int64_t Link::rtt_us() const { return impl_->srtt_us; }
const LineRate& Link::rate() const { return impl_->rate; }
std::int64_t Link::loss_ppm() const { return impl_->window.loss_ppm(); }
bool Link::loss_known() const { return impl_->window.full(); }
std::int64_t Link::rejected() const { return impl_->rejected; }
std::int64_t Link::SentUntilUs(std::int64_t now_us) { return impl_->reliable.SentUntilUs(now_us); }
bool Link::reliable_pending() const { return !impl_->reliable.empty(); }
std::size_t Link::waiting() const { return impl_->reliable.size(); }

}  // namespace seam
