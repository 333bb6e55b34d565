#pragma once
/// Writes and reads the bytes of one datagram of a Link; keeps no state between datagrams.
///
///   0      4          8         16         18    20         24
///   magic  checksum   session   sequence   ack   ack_bits   messages...
///   u32    u32        u64       u16        u16   u32
///
///   message:   header u16 (bit 15: reliable, bits 0..14: bytes) | [reliable id u16] | bytes
///
/// All big-endian. docs/protocol.md is the reference.

#include <cstdint>
#include <vector>

#include "common/base/bytes.h"
#include "common/net/net.h"

namespace seam {

/// "SEA1". A change of the framing needs another number.
constexpr std::uint32_t kDatagramMagic = 0x53454131u;
constexpr std::size_t kDatagramHeaderBytes = 24;

struct DatagramHeader {
  std::uint64_t session = 0;
  std::uint16_t sequence = 0;
  std::uint16_t ack = 0;       ///< a sequence number that has arrived
  std::uint32_t ack_bits = 0;  ///< bit i: ack - 1 - i has arrived too

  /// Returns true for a datagram outside any session: part of the handshake, or a refusal. A Link
  /// rejects it.
  bool loose() const { return sequence == 0 && ack == 0 && ack_bits == 0; }
};

struct DatagramMessage {
  bool reliable = false;
  std::uint16_t id = 0;  ///< reliable messages only
  ByteView bytes;        ///< into the datagram
};

/// Returns the bytes that a message and its header take in a datagram.
inline std::size_t FramedBytes(std::size_t message_bytes, bool reliable) {
  return message_bytes + (reliable ? 4 : 2);
}

/// Builds one datagram. Append only while bytes() + FramedBytes(...) <= kDatagramBytesMax.
class DatagramWriter {
 public:
  DatagramWriter();
  void Append(const DatagramMessage& message);
  std::size_t bytes() const { return data_.size(); }
  bool empty() const { return data_.size() == kDatagramHeaderBytes; }
  /// Fills in header and checksum. The result is valid until the next call.
  const Bytes& Finish(const DatagramHeader& header);
  /// Begins another datagram in the same memory.
  void Clear() { data_.resize(kDatagramHeaderBytes); }

 private:
  Bytes data_;
};

/// Reads the header fields of a datagram, unchecked; false if it is shorter than a header.
bool PeekHeader(ByteView datagram, DatagramHeader* header);

/// Reads and checks the 24 header bytes and the checksum of the whole; false if it is not ours.
bool ReadHeader(ByteView datagram, DatagramHeader* header);

/// Splits the bytes after the header into messages. False when a length is 0, too large or beyond
/// the end; `messages` is then undefined.
bool ReadMessages(ByteView datagram, std::vector<DatagramMessage>* messages);

/// Returns the first message of a datagram with a good header if that message is unreliable and
/// complete; else empty.
ByteView FirstUnreliable(ByteView datagram);

/// Returns a datagram of one unreliable message outside any session; see DatagramHeader::loose.
Bytes LooseDatagram(std::uint64_t session, ByteView message);

}  // namespace seam
