#pragma once
/// The bytes of one datagram of a Link, written and read; nothing here remembers anything.
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

/// "SEA1". Another framing would be another number.
constexpr std::uint32_t kDatagramMagic = 0x53454131u;
constexpr std::size_t kDatagramHeaderBytes = 24;

struct DatagramHeader {
  std::uint64_t session = 0;
  std::uint16_t sequence = 0;
  std::uint16_t ack = 0;       ///< a sequence number that arrived
  std::uint32_t ack_bits = 0;  ///< bit i: ack - 1 - i arrived too

  /// Outside of any session: part of the handshake, or a refusal. No Link takes it.
  bool loose() const { return sequence == 0 && ack == 0 && ack_bits == 0; }
};

struct DatagramMessage {
  bool reliable = false;
  std::uint16_t id = 0;  ///< of a reliable one
  ByteView bytes;        ///< into the datagram
};

/// Bytes that a message takes in a datagram with its own header.
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
  /// Begins the next one, in the same memory.
  void Clear() { data_.resize(kDatagramHeaderBytes); }
  /// Fills in header and checksum.
  const Bytes& Finish(const DatagramHeader& header);

 private:
  Bytes data_;
};

/// Reads and checks the 24 bytes and the checksum over everything; false when they are not ours.
bool ReadHeader(ByteView datagram, DatagramHeader* header);

/// Splits what follows the header. False when a length is 0, too large or beyond the end; then
/// `messages` is of no use.
bool ReadMessages(ByteView datagram, std::vector<DatagramMessage>* messages);

/// The first message of a datagram whose header is good, if it is unreliable and whole; else empty.
ByteView FirstUnreliable(ByteView datagram);

/// A datagram of one unreliable message outside of any session; see DatagramHeader::loose.
Bytes LooseDatagram(std::uint64_t session, ByteView message);

}  // namespace seam
