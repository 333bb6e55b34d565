#include "common/net/datagram.h"

#include "common/base/check.h"
#include "common/codec/short_form.h"
#include "common/net/link.h"
#include "common/net/wire_number.h"

namespace seam {
namespace {

constexpr std::size_t kSessionAt = 4, kSequenceAt = 12, kAckAt = 14, kAckBitsAt = 16;
constexpr std::uint16_t kReliableBit = 0x8000;

}  // namespace

DatagramWriter::DatagramWriter() : data_(kDatagramHeaderBytes) { data_.reserve(kDatagramBytesMax); }

void DatagramWriter::Append(const DatagramMessage& message) {
  SEAM_ASSERT(message.bytes.size >= 1 && message.bytes.size <= kShortFormBytesMax);
  SEAM_ASSERT(bytes() + FramedBytes(message.bytes.size, message.reliable) <= kDatagramBytesMax);
  std::uint8_t header[4];
  PutNumber(header, message.bytes.size | (message.reliable ? kReliableBit : 0u), 2);
  PutNumber(header + 2, message.id, 2);
  data_.insert(data_.end(), header, header + (message.reliable ? 4 : 2));
  data_.insert(data_.end(), message.bytes.begin(), message.bytes.end());
}

const Bytes& DatagramWriter::Finish(const DatagramHeader& header, const Seal& seal) {
  PutNumber(data_.data(), kDatagramMagic, 4);
  PutNumber(data_.data() + kSessionAt, seal.session(), 8);
  PutNumber(data_.data() + kSequenceAt, static_cast<std::uint64_t>(header.sequence), 2);
  PutNumber(data_.data() + kAckAt, header.ack, 2);
  PutNumber(data_.data() + kAckBitsAt, header.ack_bits, 4);
  seal.Close(header.sequence, kAckAt, &data_);
  return data_;
}

std::uint64_t SessionOfDatagram(ByteView datagram) {
  if (datagram.size < kDatagramOverheadBytes || datagram.size > kDatagramBytesMax) return 0;
  if (GetNumber(datagram.data, 4) != kDatagramMagic) return 0;
  return GetNumber(datagram.data + kSessionAt, 8);
}

std::uint16_t SequenceOfDatagram(ByteView datagram) {
  return static_cast<std::uint16_t>(GetNumber(datagram.data + kSequenceAt, 2));
}

bool OpenDatagram(ByteView datagram, const Seal& seal, std::int64_t sequence, Bytes* plain,
                  DatagramHeader* header) {
  if (SessionOfDatagram(datagram) != seal.session()) return false;
  if (!seal.Open(sequence, kAckAt, datagram, plain)) return false;
  header->sequence = sequence;
  header->ack = static_cast<std::uint16_t>(GetNumber(plain->data() + kAckAt, 2));
  header->ack_bits = static_cast<std::uint32_t>(GetNumber(plain->data() + kAckBitsAt, 4));
  return true;
}

bool ReadMessages(ByteView plain, std::vector<DatagramMessage>* messages) {
  messages->clear();
  std::size_t at = kDatagramHeaderBytes;
  while (at < plain.size) {
    if (plain.size - at < 2) return false;
    const auto word = static_cast<std::uint16_t>(GetNumber(plain.data + at, 2));
    DatagramMessage message;
    message.reliable = (word & kReliableBit) != 0;
    const std::size_t bytes = word & (kReliableBit - 1u);
    if (bytes < 1 || bytes > kShortFormBytesMax) return false;
    if (plain.size - at < FramedBytes(bytes, message.reliable)) return false;
    if (message.reliable) {
      message.id = static_cast<std::uint16_t>(GetNumber(plain.data + at + 2, 2));
    }
    at += FramedBytes(bytes, message.reliable);
    message.bytes = {plain.data + at - bytes, bytes};
    messages->push_back(message);
  }
  return true;
}

}  // namespace seam
