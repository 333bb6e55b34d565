#include "render/export/mcap_writer.h"

#include <algorithm>
#include <array>

#include "common/base/check.h"
#include "common/base/compress.h"

namespace seam {
namespace {

constexpr char kMagic[] = {'\x89', 'M', 'C', 'A', 'P', '0', '\r', '\n'};
/// Size beyond which a chunk ends, bytes: readers keep a chunk in memory.
constexpr std::size_t kMcapChunkBytes = 4 << 20;

enum Opcode : std::uint8_t {
  kHeader = 1,
  kFooter = 2,
  kSchema = 3,
  kChannel = 4,
  kMessage = 5,
  kChunk = 6,
  kMessageIndex = 7,
  kChunkIndex = 8,
  kStatistics = 0x0b,
  kSummaryOffset = 0x0e,
  kDataEnd = 0x0f
};

/// Returns an integer in little-endian order.
template <class T>
std::string Le(T value) {
  std::string bytes;
  for (std::size_t i = 0; i < sizeof value; ++i) {
    bytes += static_cast<char>((static_cast<std::uint64_t>(value) >> (8 * i)) & 0xff);
  }
  return bytes;
}

std::uint32_t Size32(const std::string& bytes) {
  SEAM_ASSERT(bytes.size() <= 0xffffffffu);
  return static_cast<std::uint32_t>(bytes.size());
}

std::string Text(const std::string& text) { return Le(Size32(text)) + text; }

std::string Record(Opcode opcode, const std::string& content) {
  return static_cast<char>(opcode) + Le(std::uint64_t{content.size()}) + content;
}

std::string Compressed(const std::string& bytes) {
  const Bytes packed = Compress(TextBytes(bytes));
  return std::string(packed.begin(), packed.end());
}

std::array<std::uint32_t, 256> CrcTable() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t c = i;
    for (int bit = 0; bit < 8; ++bit) c = (c & 1) != 0 ? 0xedb88320u ^ (c >> 1) : c >> 1;
    table[i] = c;
  }
  return table;
}

}  // namespace

std::uint32_t Crc32(std::string_view bytes, std::uint32_t crc) {
  static const std::array<std::uint32_t, 256> table = CrcTable();
  crc = ~crc;
  for (const char c : bytes) {
    crc = table[(crc ^ static_cast<unsigned char>(c)) & 0xff] ^ (crc >> 8);
  }
  return ~crc;
}

McapWriter::McapWriter(OutputFile* out, const std::string& library) : out_(out) {
  Write(std::string(kMagic, sizeof kMagic));
  Write(Record(kHeader, Text("") + Text(library)));
}

void McapWriter::Write(const std::string& bytes) {
  data_crc_ = Crc32(bytes, data_crc_);
  out_->Write(bytes);
}

std::uint16_t McapWriter::AddSchema(const std::string& name, const std::string& set) {
  const auto number = static_cast<std::uint16_t>(schemas_.size() + 1);
  schemas_.push_back(Record(kSchema, Le(number) + Text(name) + Text("protobuf") + Text(set)));
  chunk_ += schemas_.back();
  return number;
}

std::uint16_t McapWriter::AddChannel(std::uint16_t schema, const std::string& topic) {
  const auto number = static_cast<std::uint16_t>(channels_.size() + 1);
  const std::string metadata = Text("");  // none
  Channel channel;
  channel.record =
      Record(kChannel, Le(number) + Le(schema) + Text(topic) + Text("protobuf") + metadata);
  chunk_ += channel.record;
  channels_.push_back(std::move(channel));
  return number;
}

void McapWriter::AddMessage(std::uint16_t channel, std::uint64_t time_ns,
                            const std::string& message) {
  SEAM_ASSERT(channel >= 1 && channel <= channels_.size());
  Channel& its = channels_[channel - 1u];
  its.index += Le(time_ns) + Le(std::uint64_t{chunk_.size()});
  const auto sequence = static_cast<std::uint32_t>(its.messages++);
  chunk_ += Record(kMessage, Le(channel) + Le(sequence) + Le(time_ns) + Le(time_ns) + message);
  chunk_first_ns_ = chunk_messages_ == 0 ? time_ns : std::min(chunk_first_ns_, time_ns);
  chunk_last_ns_ = std::max(chunk_last_ns_, time_ns);
  first_ns_ = messages_ == 0 ? time_ns : std::min(first_ns_, time_ns);
  last_ns_ = std::max(last_ns_, time_ns);
  ++chunk_messages_;
  ++messages_;
  if (chunk_.size() > kMcapChunkBytes) EndChunk();
}

void McapWriter::EndChunk() {
  if (chunk_.empty()) return;
  const std::string span = Le(chunk_first_ns_) + Le(chunk_last_ns_);
  const std::uint64_t size = chunk_.size(), start = out_->bytes();
  const std::string compression = Text("zstd"), packed = Compressed(chunk_);
  const std::uint64_t packed_size = packed.size();
  Write(
      Record(kChunk, span + Le(size) + Le(Crc32(chunk_)) + compression + Le(packed_size) + packed));
  const std::uint64_t chunk_length = out_->bytes() - start;
  std::string offsets;
  const std::uint64_t indexes_start = out_->bytes();
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    std::string& index = channels_[i].index;
    if (index.empty()) continue;
    const auto number = static_cast<std::uint16_t>(i + 1);
    offsets += Le(number) + Le(out_->bytes());
    Write(Record(kMessageIndex, Le(number) + Text(index)));
    index.clear();
  }
  const std::uint64_t indexes_length = out_->bytes() - indexes_start;
  chunk_indexes_.push_back(Record(kChunkIndex, span + Le(start) + Le(chunk_length) + Text(offsets) +
                                                   Le(indexes_length) + compression +
                                                   Le(packed_size) + Le(size)));
  chunk_.clear();
  chunk_first_ns_ = chunk_last_ns_ = chunk_messages_ = 0;
}

void McapWriter::WriteSummary() {
  const std::uint64_t start = out_->bytes();
  std::string summary, offsets;
  const auto add_group = [&](Opcode opcode, const std::string& records) {
    if (records.empty()) return;
    offsets += Record(kSummaryOffset, static_cast<char>(opcode) + Le(start + summary.size()) +
                                          Le(std::uint64_t{records.size()}));
    summary += records;
  };
  std::string schemas, channels, counts, chunks;
  for (const std::string& record : schemas_) schemas += record;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    channels += channels_[i].record;
    counts += Le(static_cast<std::uint16_t>(i + 1)) + Le(channels_[i].messages);
  }
  for (const std::string& record : chunk_indexes_) chunks += record;
  add_group(kSchema, schemas);
  add_group(kChannel, channels);
  add_group(kStatistics,
            Record(kStatistics, Le(messages_) + Le(static_cast<std::uint16_t>(schemas_.size())) +
                                    Le(static_cast<std::uint32_t>(channels_.size())) +
                                    Le(std::uint32_t{0}) + Le(std::uint32_t{0}) +
                                    Le(static_cast<std::uint32_t>(chunk_indexes_.size())) +
                                    Le(first_ns_) + Le(last_ns_) + Text(counts)));
  add_group(kChunkIndex, chunks);
  const std::uint64_t offsets_start = start + summary.size();
  // The checksum covers the summary and the footer up to the checksum itself.
  const std::string footer = Le(start) + Le(offsets_start);
  const std::uint64_t footer_bytes = footer.size() + sizeof(std::uint32_t);
  summary += offsets + static_cast<char>(kFooter) + Le(footer_bytes) + footer;
  out_->Write(summary + Le(Crc32(summary)) + std::string(kMagic, sizeof kMagic));
}

void McapWriter::Finish() {
  EndChunk();
  out_->Write(Record(kDataEnd, Le(data_crc_)));
  WriteSummary();
}

}  // namespace seam
