/// seam-export --mcap: the container is read back record by record, and by Foxglove's own reader
/// where it is installed.

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <map>
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
    Export("wall", {"--duration", "8", "--no-floor"});
  }
  static void TearDownTestSuite() { files_.reset(); }
  /// Makes SCENE.lcm over 4g, and SCENE.mcap of it.
  static void Export(const std::string& name, const std::vector<std::string>& flags) {
    const std::string scene = (Root() / "scenes" / (name + ".toml")).string();
    const std::string log = *files_ / (name + ".lcm"), file = *files_ / (name + ".mcap");
    std::vector<std::string> run{LabProgram(), "run", scene, "--impair", "4g", "-o", log};
    run.insert(run.end(), flags.begin(), flags.end());
    for (const auto& words : {run, {BuiltProgram("seam-export"), log, "--mcap", "-o", file}}) {
      Program program(words);
      ASSERT_TRUE(program.Wait(120));
      ASSERT_EQ(program.status(), 0) << program.Story();
    }
  }
  static McapFile File() { return ReadMcap(files_->Read("wall.mcap")); }
  static Recording Log() { return ReadRecording(*files_ / "wall.lcm"); }
  static std::unique_ptr<LabWorkspace> files_;
};
std::unique_ptr<LabWorkspace> ExportMcap::files_;

/// The frames of a view, by tick.
std::map<std::int64_t, std::vector<FrameRead>> FramesOfView(const McapFile& file, double tick_hz,
                                                            const std::string& view) {
  std::map<std::int64_t, std::vector<FrameRead>> all;
  for (const auto& [time_ns, message] : file.messages.at("/poses")) {
    const std::int64_t tick = std::llround(static_cast<double>(time_ns) * 1e-9 * tick_hz);
    EXPECT_NEAR(static_cast<double>(time_ns) * 1e-9, static_cast<double>(tick) / tick_hz, 1e-8);
    for (const FrameRead& frame : FramesIn(message)) {
      if (frame.name.rfind(view + "/", 0) == 0) all[tick].push_back(frame);
    }
  }
  return all;
}

TEST_F(ExportMcap, TheContainerHoldsTheRecordingsPosesAndItsOwnChecksums) {
  const McapFile file = File();
  const Recording recording = Log();
  std::uint64_t messages = 0;
  for (const auto& [topic, of_topic] : file.messages) messages += of_topic.size();
  EXPECT_EQ(file.counted, messages);
  EXPECT_GT(file.chunks, 1u);
  const char* const names[] = {"server", "ann", "bob"};
  for (const auto& [peer, views] : recording.views) {
    const auto poses = FramesOfView(file, recording.room.tick_hz, names[peer]);
    ASSERT_EQ(poses.size(), views.size());
    for (const auto& [tick, view] : views) {
      const std::vector<FrameRead>& frames = poses.at(tick);
      ASSERT_EQ(frames.size(), view.id.size());
      for (std::size_t i = 0; i < frames.size(); ++i) {
        EXPECT_NEAR(frames[i].x, double{view.x[i]}, 0.5 / 4096);
        EXPECT_NEAR(frames[i].y, double{view.y[i]}, 0.5 / 4096);
        EXPECT_NEAR(std::remainder(frames[i].angle - double{view.angle[i]}, 2 * kPi), 0, 1e-4);
      }
    }
  }
  EXPECT_EQ(file.messages.at("/ground").size(), 1u);
  EXPECT_FALSE(file.messages.at("/events").empty());
}

TEST_F(ExportMcap, TheOracleIsASecondScene) {
  const McapFile file = File();
  const Recording recording = Log();
  const Oracle oracle = ComputeOracle(recording, JudgeOf(recording.room));
  const auto truths = FramesOfView(file, recording.room.tick_hz, "oracle");
  const auto& views = recording.views.at(0);
  ASSERT_GE(truths.size(), views.size());
  for (const auto& [tick, view] : views) {
    const std::vector<FrameRead>& frames = truths.at(tick);
    ASSERT_EQ(frames.size(), view.id.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const auto state = oracle.At(tick, view.id[i]);
      ASSERT_TRUE(state.has_value());
      EXPECT_NEAR(frames[i].x, double{state->position.x()}, 0.5 / 4096);
      EXPECT_NEAR(frames[i].y, double{state->position.y()}, 0.5 / 4096);
    }
  }
  EXPECT_EQ(file.messages.at("/oracle/shapes").size(), 1u);
}

TEST_F(ExportMcap, ErrorsAreThoseOfEachView) {
  const McapFile file = File();
  const Recording recording = Log();
  const Oracle oracle = ComputeOracle(recording, JudgeOf(recording.room));
  const std::map<std::string, int> peers{{"server", 0}, {"ann", 1}, {"bob", 2}};
  std::size_t compared = 0;
  for (const auto& [time_ns, message] : file.messages.at("/errors")) {
    const Proto errors = ReadProto(message);
    const std::int64_t tick = Only(errors, 1).empty() ? 0 : std::stoll(Only(errors, 1));
    const auto [from, to] = errors.equal_range(2);
    for (auto its = from; its != to; ++its) {
      const Proto of_view = ReadProto(its->second);
      const View& view = recording.views.at(peers.at(Only(of_view, 1))).at(tick);
      double largest = 0;
      for (std::size_t i = 0; i < view.id.size(); ++i) {
        const auto state = oracle.At(tick, view.id[i]);
        ASSERT_TRUE(state.has_value());
        largest = std::max<double>(largest, (Vec2(view.x[i], view.y[i]) - state->position).norm());
      }
      EXPECT_NEAR(FloatOf(of_view, 3), largest, 1e-4) << Only(of_view, 1) << " at " << tick;
      ++compared;
    }
  }
  std::size_t views = 0;
  for (const auto& [peer, of_peer] : recording.views) views += of_peer.size();
  EXPECT_EQ(compared, views);
}

TEST_F(ExportMcap, AnInputThatIsNotWrittenIsTheOneBeforeAndTheOneAfter) {
  Export("crossing", {"--drive", "bot", "--duration", "8"});
  const McapFile file = ReadMcap(files_->Read("crossing.mcap"));
  const Recording recording = ReadRecording(*files_ / "crossing.lcm");
  std::map<std::int64_t, float> written;
  for (const auto& [time_ns, message] : file.messages.at("/inputs/ann")) {
    const Proto input = ReadProto(message);
    written[Only(input, 1).empty() ? 0 : std::stoll(Only(input, 1))] = FloatOf(input, 2);
  }
  std::size_t inputs = 0;
  for (const auto& [first_tick, message] : recording.inputs.at(0)) {
    for (std::size_t i = 0; i < message.drive.size(); ++i, ++inputs) {
      const auto after = written.lower_bound(first_tick + static_cast<std::int64_t>(i));
      ASSERT_NE(after, written.end());
      EXPECT_EQ(after->second, static_cast<float>(message.drive[i]) / 127);
    }
  }
  EXPECT_LT(written.size(), inputs);
  EXPECT_GT(written.size(), 10u) << "the bot does drive";
}

TEST_F(ExportMcap, IsAtMostAFifthLargerThanTheGzipOfItsLog) {
  Export("stack", {"--duration", "8"});
  Export("relay", {"--duration", "8", "--mode", "central", "--predict", "own"});
  for (const std::string scene : {"wall", "crossing", "stack", "relay"}) {
    const std::string log = files_->Read(scene + ".lcm");
    uLongf packed = compressBound(log.size());
    std::string bytes(packed, '\0');
    ASSERT_EQ(compress(reinterpret_cast<Bytef*>(bytes.data()), &packed,
                       reinterpret_cast<const Bytef*>(log.data()), log.size()),
              Z_OK);
    const auto size = static_cast<double>(files_->Read(scene + ".mcap").size());
    EXPECT_LE(size, 1.2 * static_cast<double>(packed)) << scene;
  }
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
  Program read({"node", *files_ / "read.js", *files_ / "wall.mcap"});
  ASSERT_TRUE(read.Wait(60));
  EXPECT_EQ(read.status(), 0) << read.Story();
  EXPECT_EQ(read.output(), std::to_string(ReadMcap(files_->Read("wall.mcap")).counted) + "\n");
}

TEST(Crc32OfMcap, EqualsTheCrcOfZip) {
  EXPECT_EQ(Crc32("123456789"), 0xcbf43926u);  // the check value of the catalogue of CRCs
  EXPECT_EQ(Crc32("6789", Crc32("12345")), Crc32("123456789"));
}

}  // namespace export_mcap_test
}  // namespace seam
