/// seam-export --mcap: the container is read back record by record, and by Foxglove's own reader
/// where it is installed.

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <memory>

#include "common/base/geometry.h"
#include "common/measure/oracle.h"
#include "common/record/recording.h"
#include "render/export/mcap_writer.h"
#include "tests/render/mcap_reader.h"
#include "tests/support/lab_workspace.h"
#include "tests/support/program.h"
#include "tests/support/source_tree.h"

namespace seam {
namespace export_mcap_test {

class ExportMcap : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    files_ = std::make_unique<LabWorkspace>();
    const std::string scene = (Root() / "scenes/wall.toml").string();
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{LabProgram(), "run", scene, "--duration", "8", "--no-floor",
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
      const std::vector<FrameRead> frames = FramesIn(message->second);
      ASSERT_EQ(frames.size(), view.id.size());
      for (std::size_t i = 0; i < frames.size(); ++i) {
        EXPECT_NEAR(frames[i].x, double{view.x[i]}, 0.5 / 4096);
        EXPECT_NEAR(frames[i].y, double{view.y[i]}, 0.5 / 4096);
        EXPECT_NEAR(std::remainder(frames[i].angle - double{view.angle[i]}, 2 * kPi), 0, 1e-4);
      }
      ++message;
    }
  }
  EXPECT_EQ(file.messages.at("/ground").size(), 1u);
  EXPECT_FALSE(file.messages.at("/inputs/ann").empty());
  EXPECT_FALSE(file.messages.at("/events").empty());
}

TEST_F(ExportMcap, TheOracleIsASecondScene) {
  const McapFile file = ReadMcap(files_->Read("a.mcap"));
  const Recording recording = ReadRecording(*files_ / "run.lcm");
  const Oracle oracle = ComputeOracle(recording, JudgeOf(recording.room));
  const auto& truths = file.messages.at("/oracle/poses");
  const auto& views = recording.views.at(0);
  ASSERT_EQ(truths.size(), views.size());
  auto message = truths.begin();
  for (const auto& [tick, view] : views) {
    const std::vector<FrameRead> frames = FramesIn((message++)->second);
    ASSERT_EQ(frames.size(), view.id.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const auto state = oracle.At(tick, view.id[i]);
      ASSERT_TRUE(state.has_value());
      EXPECT_EQ(frames[i].name.rfind("oracle/", 0), 0u);
      EXPECT_NEAR(frames[i].x, double{state->position.x()}, 0.5 / 4096);
      EXPECT_NEAR(frames[i].y, double{state->position.y()}, 0.5 / 4096);
    }
  }
  EXPECT_EQ(file.messages.at("/oracle/shapes").size(), 1u);
}

TEST_F(ExportMcap, IsAtMostAFifthLargerThanTheGzipOfItsLog) {
  const std::string log = files_->Read("run.lcm");
  uLongf packed = compressBound(log.size());
  std::string bytes(packed, '\0');
  ASSERT_EQ(compress(reinterpret_cast<Bytef*>(bytes.data()), &packed,
                     reinterpret_cast<const Bytef*>(log.data()), log.size()),
            Z_OK);
  EXPECT_LE(static_cast<double>(files_->Read("a.mcap").size()), 1.2 * static_cast<double>(packed));
}

TEST_F(ExportMcap, FoxglovesOwnReaderReadsIt) {
  const std::string probe =
      "for (const name of ['@mcap/core', 'protobufjs', 'fzstd']) "
      "require.resolve(name)";
  Program node({"node", "-e", probe});
  ASSERT_TRUE(node.Wait(60));
  if (node.status() != 0) {
    GTEST_SKIP() << "node with its packages is not there (npm install @mcap/core protobufjs fzstd "
                    "in some folder, and NODE_PATH=FOLDER/node_modules)";
  }
  files_->Write("read.js", R"js(
const {McapIndexedReader, McapStreamReader} = require('@mcap/core');
const protobuf = require('protobufjs');
const descriptor = require('protobufjs/ext/descriptor');
const fzstd = require('fzstd');
const decompressHandlers = {
  zstd: (packed, size) => fzstd.decompress(packed, new Uint8Array(Number(size)))};
const bytes = require('fs').readFileSync(process.argv[2]);
const readable = {size: async () => BigInt(bytes.length), read: async (offset, length) =>
  new Uint8Array(bytes.buffer, bytes.byteOffset + Number(offset), Number(length))};
(async () => {
  const stream = new McapStreamReader({validateCrcs: true, decompressHandlers});
  stream.append(bytes);
  while (stream.nextRecord());
  if (!stream.done()) throw Error('the stream does not end');
  const file = await McapIndexedReader.Initialize({readable, decompressHandlers});
  let count = 0n, last = 0n, points = 0;
  const types = new Map();
  for (const schema of file.schemasById.values()) {
    const root = protobuf.Root.fromDescriptor(descriptor.FileDescriptorSet.decode(schema.data));
    types.set(schema.id, root.resolveAll().lookupType(schema.name));
  }
  for await (const message of file.readMessages({validateCrcs: true})) {
    const schema = file.channelsById.get(message.channelId).schemaId;
    const value = types.get(schema).decode(message.data);
    for (const entity of value.entities || [])
      for (const line of entity.lines) points += line.points.length;
    if (message.logTime < last) throw Error('time runs backwards');
    last = message.logTime;
    ++count;
  }
  if (points === 0) throw Error('no outlines');
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
