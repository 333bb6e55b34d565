#include "common/net/datagram.h"

#include <algorithm>

#include "common/base/check.h"
#include "common/net/crc32c.h"
#include "common/net/link.h"

namespace seam {
namespace {

constexpr std::size_t kChecksumAt = 4;
constexpr std::size_t kSessionAt = 8;
constexpr std::uint16_t kReliableBit = 0x8000;

void Put(std::uint8_t* at, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) at[i] = static_cast<std::uint8_t>(value >> (8 * (bytes - 1 - i)));
}

std::uint64_t Get(const std::uint8_t* at, int bytes) {
  std::uint64_t value = 0;
  for (int i = 0; i < bytes; ++i) value = (value << 8) | at[i];
  return value;
}

/// Returns the checksum over the magic and everything after the checksum field.
std::uint32_t Checksum(ByteView datagram) {
  const std::uint32_t magic = Crc32c({datagram.data, kChecksumAt});
  return Crc32c({datagram.data + kSessionAt, datagram.size - kSessionAt}, magic);
}

}  // namespace

DatagramWriter::DatagramWriter() : data_(kDatagramHeaderBytes) { data_.reserve(kDatagramBytesMax); }

void DatagramWriter::Append(const DatagramMessage& message) {
  SEAM_ASSERT(message.bytes.size >= 1 && message.bytes.size <= kMessageBytesMax);
  SEAM_ASSERT(bytes() + FramedBytes(message.bytes.size, message.reliable) <= kDatagramBytesMax);
  std::uint8_t header[4];
  Put(header, message.bytes.size | (message.reliable ? kReliableBit : 0u), 2);
  Put(header + 2, message.id, 2);
  data_.insert(data_.end(), header, header + (message.reliable ? 4 : 2));
  data_.insert(data_.end(), message.bytes.begin(), message.bytes.end());
}

const Bytes& DatagramWriter::Finish(const DatagramHeader& header) {
  Put(data_.data(), kDatagramMagic, 4);
  Put(data_.data() + kSessionAt, header.session, 8);
  Put(data_.data() + 16, header.sequence, 2);
  Put(data_.data() + 18, header.ack, 2);
  Put(data_.data() + 20, header.ack_bits, 4);
  Put(data_.data() + kChecksumAt, Checksum(data_), 4);
  return data_;
}

bool PeekHeader(ByteView datagram, DatagramHeader* header) {
  if (datagram.size < kDatagramHeaderBytes) return false;
  header->session = Get(datagram.data + kSessionAt, 8);
  header->sequence = static_cast<std::uint16_t>(Get(datagram.data + 16, 2));
  header->ack = static_cast<std::uint16_t>(Get(datagram.data + 18, 2));
  header->ack_bits = static_cast<std::uint32_t>(Get(datagram.data + 20, 4));
  return true;
}

bool ReadHeader(ByteView datagram, DatagramHeader* header) {
  if (datagram.size < kDatagramHeaderBytes || datagram.size > kDatagramBytesMax) return false;
  if (Get(datagram.data, 4) != kDatagramMagic) return false;
  if (Get(datagram.data + kChecksumAt, 4) != Checksum(datagram)) return false;
  return PeekHeader(datagram, header) && header->session != 0;
}

ByteView FirstUnreliable(ByteView datagram) {
  constexpr std::size_t kAt = kDatagramHeaderBytes + 2;
  if (datagram.size <= kAt) return {};
  const auto bytes = static_cast<std::size_t>(Get(datagram.data + kDatagramHeaderBytes, 2));
  if (bytes > std::min(datagram.size - kAt, kMessageBytesMax)) return {};
  return {datagram.data + kAt, bytes};
}

Bytes LooseDatagram(std::uint64_t session, ByteView message) {
  DatagramWriter writer;
  writer.Append({false, 0, message});
  DatagramHeader header;
  header.session = session;
  return writer.Finish(header);
}

bool ReadMessages(ByteView datagram, std::vector<DatagramMessage>* messages) {
  messages->clear();
  std::size_t at = kDatagramHeaderBytes;
  while (at < datagram.size) {
    if (datagram.size - at < 2) return false;
    const auto word = static_cast<std::uint16_t>(Get(datagram.data + at, 2));
    DatagramMessage message;
    message.reliable = (word & kReliableBit) != 0;
    const std::size_t bytes = word & (kReliableBit - 1u);
    if (bytes < 1 || bytes > kMessageBytesMax) return false;
    if (datagram.size - at < FramedBytes(bytes, message.reliable)) return false;
    if (message.reliable) message.id = static_cast<std::uint16_t>(Get(datagram.data + at + 2, 2));
    at += FramedBytes(bytes, message.reliable);
    message.bytes = {datagram.data + at - bytes, bytes};
    messages->push_back(message);
  }
  return true;
}

}  // namespace seam
