#pragma once
/// Writes and reads the bytes of one sealed datagram of a Link; keeps no state between datagrams.
///
///   0      4         12         14    16         20            n - 16
///   magic  session   sequence   ack   ack_bits   messages...   tag
///   u32    u64       u16        u16   u32                      16 bytes
///
///   message:   header u16 (bit 15: reliable, bits 0..14: bytes) | [reliable id u16] | short form
///
/// All big-endian; everything from `ack` on is encrypted, everything authenticated (seal.h).
/// docs/protocol.md is the reference.

#include <cstdint>
#include <vector>

#include "common/base/bytes.h"
#include "common/net/net.h"
#include "common/net/seal.h"

namespace seam {

/// "SEA2". A change of the framing needs another number.
constexpr std::uint32_t kDatagramMagic = 0x53454132u;
constexpr std::size_t kDatagramHeaderBytes = 20;
/// Bytes of a datagram without messages.
constexpr std::size_t kDatagramOverheadBytes = kDatagramHeaderBytes + Seal::kTagBytes;

struct DatagramHeader {
  std::int64_t sequence = 0;   ///< number in its direction, from 1; 16 bits are sent
  std::uint16_t ack = 0;       ///< a sequence number that has arrived
  std::uint32_t ack_bits = 0;  ///< bit i: ack - 1 - i has arrived too
};

struct DatagramMessage {
  bool reliable = false;
  std::uint16_t id = 0;  ///< reliable messages only
  ByteView bytes;        ///< into the datagram: the short form (common/codec/short_form.h)
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
  /// Bytes of the datagram with its tag.
  std::size_t bytes() const { return data_.size() + Seal::kTagBytes; }
  bool empty() const { return data_.size() == kDatagramHeaderBytes; }
  /// Returns the datagram as it is before it is sealed, its header not yet filled in.
  ByteView plain() const { return data_; }
  /// Fills in the header and seals. The result is valid until the next call; then Clear.
  const Bytes& Finish(const DatagramHeader& header, const Seal& seal);
  /// Begins another datagram in the same memory.
  void Clear() { data_.resize(kDatagramHeaderBytes); }

 private:
  Bytes data_;
};

/// Returns the number of the session of a datagram, unchecked; 0: it is no sealed datagram.
std::uint64_t SessionOfDatagram(ByteView datagram);
/// Returns the 16 bits of the sequence number of a datagram for which SessionOfDatagram is not 0.
std::uint16_t SequenceOfDatagram(ByteView datagram);

/// Opens a datagram of this session and sequence number into `plain`, which ReadMessages reads, and
/// `header`. False if the other end did not write it.
bool OpenDatagram(ByteView datagram, const Seal& seal, std::int64_t sequence, Bytes* plain,
                  DatagramHeader* header);

/// Splits the bytes after the header of an opened datagram into messages. False when a length is 0,
/// too large or beyond the end; `messages` is then undefined.
bool ReadMessages(ByteView plain, std::vector<DatagramMessage>* messages);

}  // namespace seam
