#pragma once
/// Reads an MCAP file record by record, with its checks, and the protocol buffers in it.

#include <gtest/gtest.h>
#include <zstd.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "render/export/mcap_writer.h"

namespace seam {

struct McapRecord {
  std::uint8_t opcode = 0;
  std::string content;
  std::size_t at = 0;  ///< of the opcode
};

/// Takes fields from a record, least byte first.
class McapFields {
 public:
  explicit McapFields(const std::string& bytes) : bytes_(bytes) {}
  template <class T>
  T Take() {
    T value = 0;
    if (at_ + sizeof value > bytes_.size()) throw std::runtime_error("a record is too short");
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  std::string Text() { return Bytes(Take<std::uint32_t>()); }
  std::string Bytes(std::uint64_t count) {
    if (count > bytes_.size() - at_) throw std::runtime_error("a text is too short");
    at_ += count;
    return bytes_.substr(at_ - count, count);
  }
  std::string Rest() { return Bytes(bytes_.size() - at_); }
  bool done() const { return at_ == bytes_.size(); }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

inline std::vector<McapRecord> RecordsOf(const std::string& bytes, std::size_t from,
                                         std::size_t to) {
  std::vector<McapRecord> records;
  while (from < to) {
    McapFields head(bytes.substr(from, 9));
    McapRecord record;
    record.at = from;
    record.opcode = head.Take<std::uint8_t>();
    const auto length = head.Take<std::uint64_t>();
    if (length > to - from - 9) throw std::runtime_error("a record is cut");
    record.content = bytes.substr(from + 9, length);
    from += 9 + length;
    records.push_back(record);
  }
  return records;
}

inline const std::string kMagicText("\x89MCAP0\r\n", 8);
constexpr std::uint8_t kFooter = 2, kSchema = 3, kChannel = 4, kMessage = 5, kChunk = 6, kIndex = 7,
                       kChunkIndex = 8, kStatistics = 11, kDataEnd = 15;

struct McapFile {
  std::map<int, std::string> schema, topic;
  std::map<std::string, std::vector<std::pair<std::uint64_t, std::string>>> messages;  // by topic
  std::uint64_t counted = 0;  // by the statistics
  std::size_t chunks = 0;
};

/// Returns the records of a chunk, checked against its sizes and checksum.
inline std::string UnpackedChunk(const McapRecord& record) {
  McapFields chunk(record.content);
  chunk.Take<std::uint64_t>();
  chunk.Take<std::uint64_t>();
  const auto size = chunk.Take<std::uint64_t>();
  const auto crc = chunk.Take<std::uint32_t>();
  EXPECT_EQ(chunk.Text(), "zstd");
  const auto packed_size = chunk.Take<std::uint64_t>();
  const std::string packed = chunk.Rest();
  EXPECT_EQ(packed.size(), packed_size);
  std::string records(size, '\0');
  EXPECT_EQ(ZSTD_decompress(records.data(), size, packed.data(), packed.size()), size);
  EXPECT_EQ(Crc32(records), crc);
  return records;
}

inline void ReadChunk(const McapRecord& record, McapFile* file) {
  McapFields chunk(record.content);
  const auto first = chunk.Take<std::uint64_t>(), last = chunk.Take<std::uint64_t>();
  const std::string records = UnpackedChunk(record);
  for (const McapRecord& inner : RecordsOf(records, 0, records.size())) {
    McapFields fields(inner.content);
    const int number = fields.Take<std::uint16_t>();
    if (inner.opcode == kSchema) {
      file->schema[number] = fields.Text();
      EXPECT_EQ(fields.Text(), "protobuf");
    }
    if (inner.opcode == kChannel) {
      EXPECT_EQ(file->schema.count(fields.Take<std::uint16_t>()), 1u);
      file->topic[number] = fields.Text();
      EXPECT_EQ(fields.Text(), "protobuf");
    }
    if (inner.opcode != kMessage) continue;
    auto& messages = file->messages[file->topic.at(number)];
    EXPECT_EQ(fields.Take<std::uint32_t>(), messages.size());
    const auto time_ns = fields.Take<std::uint64_t>();
    EXPECT_GE(time_ns, first);
    EXPECT_LE(time_ns, last);
    EXPECT_EQ(fields.Take<std::uint64_t>(), time_ns);
    messages.emplace_back(time_ns, fields.Rest());
  }
}

/// Checks that a chunk and its messages are at the places in the chunk's index.
inline void CheckChunkIndex(const std::string& bytes, const McapRecord& record) {
  McapFields index(record.content);
  index.Take<std::uint64_t>();
  index.Take<std::uint64_t>();
  const auto start = index.Take<std::uint64_t>(), length = index.Take<std::uint64_t>();
  EXPECT_EQ(bytes.at(start), char{kChunk});
  const std::string records = UnpackedChunk(RecordsOf(bytes, start, start + length).front());
  McapFields offsets(index.Text());
  while (!offsets.done()) {
    const auto channel = offsets.Take<std::uint16_t>();
    const auto at = offsets.Take<std::uint64_t>();
    ASSERT_EQ(bytes.at(at), char{kIndex});
    EXPECT_GE(at, start + length);
    McapFields of_channel(RecordsOf(bytes, at, bytes.size() - kMagicText.size()).front().content);
    EXPECT_EQ(of_channel.Take<std::uint16_t>(), channel);
    McapFields messages(of_channel.Text());
    while (!messages.done()) {
      messages.Take<std::uint64_t>();
      // From the first record of the chunk, as it is without compression.
      const auto within = messages.Take<std::uint64_t>();
      EXPECT_EQ(records.at(within), char{kMessage});
      EXPECT_EQ(static_cast<std::uint8_t>(records.at(within + 9)), channel);
    }
  }
}

inline McapFile ReadMcap(const std::string& bytes) {
  McapFile file;
  EXPECT_EQ(bytes.substr(0, 8), kMagicText);
  EXPECT_EQ(bytes.substr(bytes.size() - 8), kMagicText);
  const auto records = RecordsOf(bytes, 8, bytes.size() - 8);
  EXPECT_EQ(records.back().opcode, kFooter);
  McapFields footer(records.back().content);
  const auto summary = footer.Take<std::uint64_t>(), offsets = footer.Take<std::uint64_t>();
  const std::size_t crc_at = bytes.size() - 8 - 4;
  EXPECT_EQ(Crc32(bytes.substr(summary, crc_at - summary)), footer.Take<std::uint32_t>());
  EXPECT_GT(offsets, summary);
  std::size_t chunks = 0, indexes = 0;
  for (const McapRecord& record : records) {
    McapFields fields(record.content);
    if (record.opcode == kChunk) ReadChunk(record, &file);
    if (record.opcode == kChunk) ++chunks;
    if (record.opcode == kChunkIndex) ++indexes;
    if (record.opcode == kChunkIndex) CheckChunkIndex(bytes, record);
    if (record.opcode == kStatistics) file.counted = fields.Take<std::uint64_t>();
    if (record.opcode == kDataEnd) {
      EXPECT_EQ(fields.Take<std::uint32_t>(), Crc32(bytes.substr(0, record.at)));
    }
  }
  EXPECT_EQ(chunks, indexes);
  file.chunks = chunks;
  return file;
}

/// A decoded protocol buffer: bytes of strings and messages, or a number's, by field.
using Proto = std::multimap<int, std::string>;

inline Proto ReadProto(const std::string& bytes) {
  Proto fields;
  std::size_t at = 0;
  const auto varint = [&] {
    std::uint64_t value = 0;
    for (int shift = 0;; shift += 7) {
      const auto byte = static_cast<std::uint8_t>(bytes.at(at++));
      value |= std::uint64_t{byte & 0x7fu} << shift;
      if (byte < 0x80) return value;
    }
  };
  while (at < bytes.size()) {
    const std::uint64_t key = varint();
    std::string value;
    if (key % 8 == 0) {
      value = std::to_string(varint());
    } else {
      const std::uint64_t size = key % 8 == 1 ? 8 : key % 8 == 5 ? 4 : varint();
      if (size > bytes.size() - at) throw std::runtime_error("a field is cut");
      value = bytes.substr(at, size);
      at += size;
    }
    fields.emplace(static_cast<int>(key / 8), value);
  }
  return fields;
}

/// The only field of that number; "" if it is absent.
inline std::string Only(const Proto& proto, int field) {
  EXPECT_LE(proto.count(field), 1u);
  const auto found = proto.find(field);
  return found == proto.end() ? "" : found->second;
}

inline double DoubleOf(const Proto& proto, int field) {
  const std::string bytes = Only(proto, field);
  double value = 0;
  if (bytes.size() == sizeof value) std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

inline float FloatOf(const Proto& proto, int field) {
  const std::string bytes = Only(proto, field);
  float value = 0;
  if (bytes.size() == sizeof value) std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

/// A foxglove.FrameTransform.
struct FrameRead {
  std::string name;
  double x = 0, y = 0, angle = 0;
};

inline std::vector<FrameRead> FramesIn(const std::string& message) {
  std::vector<FrameRead> frames;
  for (const auto& [field, bytes] : ReadProto(message)) {
    const Proto frame = ReadProto(bytes);
    EXPECT_EQ(Only(frame, 2), "world");
    const Proto place = ReadProto(Only(frame, 4)), turn = ReadProto(Only(frame, 5));
    frames.push_back({Only(frame, 3), DoubleOf(place, 1), DoubleOf(place, 2),
                      2 * std::atan2(DoubleOf(turn, 3), DoubleOf(turn, 4))});
  }
  return frames;
}

}  // namespace seam
