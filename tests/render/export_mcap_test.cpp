/// seam-export --mcap: the container is read back record by record, and by Foxglove's own reader
/// where it is installed.

#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <memory>
#include <stdexcept>

#include "common/record/recording.h"
#include "render/export/mcap_writer.h"
#include "tests/support/lab_workspace.h"
#include "tests/support/program.h"
#include "tests/support/source_tree.h"

namespace seam {
namespace export_mcap_test {

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

std::vector<McapRecord> RecordsOf(const std::string& bytes, std::size_t from, std::size_t to) {
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

const std::string kMagicText("\x89MCAP0\r\n", 8);
constexpr std::uint8_t kFooter = 2, kSchema = 3, kChannel = 4, kMessage = 5, kChunk = 6, kIndex = 7,
                       kChunkIndex = 8, kStatistics = 11, kDataEnd = 15;

struct McapFile {
  std::map<int, std::string> schema, topic;
  std::map<std::string, std::vector<std::pair<std::uint64_t, std::string>>> messages;  // by topic
  std::uint64_t counted = 0;  // by the statistics
};

void ReadChunk(const McapRecord& record, McapFile* file) {
  McapFields chunk(record.content);
  const auto first = chunk.Take<std::uint64_t>(), last = chunk.Take<std::uint64_t>();
  const auto size = chunk.Take<std::uint64_t>();
  const auto crc = chunk.Take<std::uint32_t>();
  EXPECT_EQ(chunk.Text(), "");  // no compression
  EXPECT_EQ(chunk.Take<std::uint64_t>(), size);
  const std::string records = chunk.Rest();
  EXPECT_EQ(records.size(), size);
  EXPECT_EQ(Crc32(records), crc);
  for (const McapRecord& inner : RecordsOf(records, 0, records.size())) {
    McapFields fields(inner.content);
    const int number = fields.Take<std::uint16_t>();
    if (inner.opcode == kSchema) file->schema[number] = fields.Text();
    if (inner.opcode == kChannel) {
      EXPECT_EQ(file->schema.count(fields.Take<std::uint16_t>()), 1u);
      file->topic[number] = fields.Text();
      EXPECT_EQ(fields.Text(), "json");
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
void CheckChunkIndex(const std::string& bytes, const McapRecord& record) {
  McapFields index(record.content);
  index.Take<std::uint64_t>();
  index.Take<std::uint64_t>();
  const auto start = index.Take<std::uint64_t>(), length = index.Take<std::uint64_t>();
  EXPECT_EQ(bytes.at(start), char{kChunk});
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
      // From the first record of the chunk: after opcode, length and the fields before it.
      const auto within = start + 9 + 40 + messages.Take<std::uint64_t>();
      EXPECT_EQ(bytes.at(within), char{kMessage});
      EXPECT_EQ(static_cast<std::uint8_t>(bytes.at(within + 9)), channel);
    }
  }
}

McapFile ReadMcap(const std::string& bytes) {
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
  EXPECT_GT(chunks, 1u);
  return file;
}

class ExportMcap : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    files_ = std::make_unique<LabWorkspace>();
    const std::string scene = (Root() / "scenes/crossing.toml").string();
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{LabProgram(), "run", scene, "--duration", "6", "--no-floor",
                                   "--impair", "4g", "-o", *files_ / "run.lcm"},
          {BuiltProgram("seam-export"), *files_ / "run.lcm", "--mcap", "-o", *files_ / "a.mcap"}}) {
      Program program(words);
      ASSERT_TRUE(program.Wait(120));
      ASSERT_EQ(program.status(), 0) << program.Story();
    }
  }
  static void TearDownTestSuite() { files_.reset(); }
  static std::unique_ptr<LabWorkspace> files_;
};
std::unique_ptr<LabWorkspace> ExportMcap::files_;

/// The numbers that follow `key` in a text of JSON.
std::vector<double> NumbersAfter(const std::string& json, const std::string& key) {
  std::vector<double> numbers;
  for (std::size_t at = json.find(key); at != std::string::npos; at = json.find(key, at + 1)) {
    numbers.push_back(std::stod(json.substr(at + key.size(), 30)));
  }
  return numbers;
}

TEST_F(ExportMcap, TheContainerHoldsTheRecordingsPosesAndItsOwnChecksums) {
  const McapFile file = ReadMcap(files_->Read("a.mcap"));
  const Recording recording = ReadRecording(*files_ / "run.lcm");
  std::uint64_t messages = 0;
  for (const auto& [topic, of_topic] : file.messages) messages += of_topic.size();
  EXPECT_EQ(file.counted, messages);
  const char* const names[] = {"server", "ann", "bob"};
  for (const auto& [peer, views] : recording.views) {
    const auto& poses = file.messages.at(std::string("/") + names[peer] + "/poses");
    ASSERT_EQ(poses.size(), views.size());
    auto message = poses.begin();
    for (const auto& [tick, view] : views) {
      const double seconds = static_cast<double>(tick) / recording.room.tick_hz;
      EXPECT_NEAR(static_cast<double>(message->first) * 1e-9, seconds, 1e-8);
      const std::vector<double> xs = NumbersAfter(message->second, "\"translation\":{\"x\":");
      ASSERT_EQ(xs.size(), view.id.size());
      for (std::size_t i = 0; i < xs.size(); ++i) {
        EXPECT_EQ(static_cast<float>(xs[i]), view.x[i]);
      }
      ++message;
    }
  }
  EXPECT_EQ(file.messages.at("/ground").size(), 1u);
  EXPECT_FALSE(file.messages.at("/inputs/ann").empty());
  EXPECT_FALSE(file.messages.at("/events").empty());
}

TEST_F(ExportMcap, FoxglovesOwnReaderReadsIt) {
  const std::string probe = "require.resolve('@mcap/core')";
  Program node({"node", "-e", probe});
  ASSERT_TRUE(node.Wait(60));
  if (node.status() != 0) {
    GTEST_SKIP() << "node with the npm package @mcap/core is not there (npm install @mcap/core in "
                    "some folder, and NODE_PATH=FOLDER/node_modules)";
  }
  files_->Write("read.js", R"js(
const {McapIndexedReader, McapStreamReader} = require('@mcap/core');
const bytes = require('fs').readFileSync(process.argv[2]);
const readable = {size: async () => BigInt(bytes.length), read: async (offset, length) =>
  new Uint8Array(bytes.buffer, bytes.byteOffset + Number(offset), Number(length))};
(async () => {
  const stream = new McapStreamReader({validateCrcs: true});
  stream.append(bytes);
  while (stream.nextRecord());
  if (!stream.done()) throw Error('the stream does not end');
  const file = await McapIndexedReader.Initialize({readable});
  let count = 0n, last = 0n;
  for await (const message of file.readMessages({validateCrcs: true})) {
    JSON.parse(Buffer.from(message.data).toString());
    if (message.logTime < last) throw Error('time runs backwards');
    last = message.logTime;
    ++count;
  }
  for (const schema of file.schemasById.values()) JSON.parse(Buffer.from(schema.data).toString());
  if (count !== file.statistics.messageCount) throw Error('the statistics are wrong');
  console.log(String(count));
})().catch((error) => { console.error(error); process.exit(1); });
)js");
  Program read({"node", *files_ / "read.js", *files_ / "a.mcap"});
  ASSERT_TRUE(read.Wait(60));
  EXPECT_EQ(read.status(), 0) << read.Story();
  EXPECT_EQ(read.output(), std::to_string(ReadMcap(files_->Read("a.mcap")).counted) + "\n");
}

TEST(Crc32OfMcap, EqualsTheCrcOfZip) {
  EXPECT_EQ(Crc32("123456789"), 0xcbf43926u);  // the check value of the catalogue of CRCs
  EXPECT_EQ(Crc32("6789", Crc32("12345")), Crc32("123456789"));
}

}  // namespace export_mcap_test
}  // namespace seam
