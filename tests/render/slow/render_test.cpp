#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "common/base/check.h"
#include "render/commands.h"
#include "render/sequence.h"
#include "tests/support/render_fixture.h"

namespace seam {
namespace render_test {

namespace fs = std::filesystem;

/// Runs seam-render; its stderr goes to `said`.
int SeamRender(const std::vector<std::string>& arguments, std::string* said = nullptr) {
  std::vector<const char*> argv{"seam-render"};
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  ::testing::internal::CaptureStderr();
  const int status = RenderMain(static_cast<int>(argv.size()), argv.data());
  const std::string text = ::testing::internal::GetCapturedStderr();
  if (said != nullptr) *said = text;
  return status;
}

TEST(Sequence, WritesTheSameBytesInEveryRunAndWithAnyNumberOfProcesses) {
  const Playback playback = MakePlayback();
  Page page = MakePage(playback, kViewAll);
  page.width_px = 640;
  page.height_px = 360;
  const Font font(ScaleOf(640, 360));
  const std::vector<double> times = FrameTimes(1, 1.5, 30);
  std::vector<std::vector<std::string>> runs;
  for (int processes : {1, 1, 2, 5}) {
    Folder folder;
    const OutputFolder output(folder / "frames", false);
    output.Prepare();
    int done = 0;
    WriteSequence(page, font, times, processes, output, [&done](int) { ++done; });
    EXPECT_EQ(done, 16);
    runs.emplace_back();
    for (int i = 0; i < 16; ++i) runs.back().push_back(Content(output.FramePath(i)));
    EXPECT_FALSE(fs::exists(output.FramePath(16)));
  }
  for (const auto& run : runs) EXPECT_TRUE(run == runs[0]);
  EXPECT_NE(runs[0][0], runs[0][15]);
  for (const std::string& bytes : runs[0]) EXPECT_GT(bytes.size(), 2000u);
}

TEST(Sequence, FramesFollowTheWantedMoments) {
  EXPECT_EQ(FrameTimes(0, 3, 30).size(), 91u);
  EXPECT_EQ(FrameTimes(1, 1, 30).size(), 1u);
  const std::vector<double> times = FrameTimes(0.5, 1.5, 30);
  ASSERT_EQ(times.size(), 31u);
  const Playback playback = MakePlayback();
  for (std::size_t i = 0; i < times.size(); ++i)  // 30 frames/s of 60 ticks/s: every other tick
    EXPECT_EQ(playback.TickAt(times[i]), 30 + 2 * static_cast<double>(i));
}

TEST(Sequence, AFrameIsThePageAtItsMoment) {
  Folder folder;
  const Playback playback = MakePlayback();
  const Page page = MakePage(playback, 1);
  const OutputFolder output(folder / "frames", false);
  output.Prepare();
  WriteSequence(page, TestFont(), FrameTimes(1.2, 1.3, 10), 2, output, [](int) {});
  EXPECT_EQ(ReadPng(output.FramePath(0)).rgba, RenderedPage(page, 1.2).rgba);
  EXPECT_EQ(ReadPng(output.FramePath(1)).rgba, RenderedPage(page, 1.3).rgba);
}

TEST(Sequence, AFrameThatCannotBeWrittenStopsItWithAnError) {
  Folder folder;
  const Playback playback = MakePlayback();
  const OutputFolder output(folder / "never-prepared", false);
  EXPECT_THROW(
      WriteSequence(MakePage(playback, 1), TestFont(), FrameTimes(0, 1, 10), 2, output, [](int) {}),
      OperatorError);
}

TEST(OutputFolder, ReplacesFramesIfForcedAndNoOtherFiles) {
  Folder folder;
  const std::string path = folder / "frames";
  OutputFolder(path, false).Prepare();
  for (const char* name : {"/frame_00000.png", "/frame_00007.png"}) std::ofstream(path + name) << 1;
  EXPECT_THROW(OutputFolder(path, false), OperatorError);
  OutputFolder(path, true).Prepare();
  EXPECT_TRUE(fs::is_empty(path));
  OutputFolder(path, false).Prepare();
  std::ofstream(path + "/thesis.txt") << "mine";
  EXPECT_THROW(OutputFolder(path, false), OperatorError);
  OutputFolder(path, true).Prepare();
  EXPECT_EQ(Content(path + "/thesis.txt"), "mine");
  EXPECT_THROW(OutputFolder(path + "/thesis.txt", true), OperatorError);
}

TEST(RenderProgram, OperatorsMistakesAreOneLineStatus2AndWriteNothing) {
  Folder folder;
  std::ofstream(folder / "not.lcm") << "no log at all";
  const std::string out = folder / "out", log = folder / "not.lcm", none = folder / "none.lcm";
  const std::vector<std::vector<std::string>> mistakes{
      {},
      {"--frobnicate"},
      {log},
      {"-o", out},
      {none, "-o", out},
      {log, "-o", out},
      {log, log, "-o", out},
      {"--compare", log, none, "-o", out},
      {log, "-o", out, "--fps", "0"},
      {log, "-o", out, "--fps", "many"},
      {log, "-o", out, "--size", "10x10"},
      {log, "-o", out, "--size", "1280x720x3"},
      {log, "-o", out, "--view", "nobody"},
      {log, "-o", out, "--camera", "1,2"},
      {log, "-o", out, "--camera", "1,2,-3"},
      {log, "-o", out, "--camera", "fit", "--follow", "car"},
      {log, "-o", out, "--zoom", "0"},
      {log, "-o", out, "--around", "nothing"},
      {log, "-o", out, "--around", "contact", "--from", "1"},
      {log, "-o", out, "--layers", "onions"},
      {log, "-o", out, "--speed", "0"},
      {log, "-o", out, "--sheet", "101"},
      {log, "-o", out, "--video", "a.avi"},
      {log, "-o", out, "--from", "2", "--to", "1"},
      {log, "-o", out, "--every", "3"},
      {log, "-o", out, "--threads", "-1"},
      {"--strobe", log, "-o", out},
      {"--strobe", log, "-o", out + ".png"},
      {"--live", log, "-o", out},
      {"--live", "--strobe", "-o", out + ".png"},
  };
  for (const auto& mistake : mistakes) {
    std::string said, typed;
    for (const std::string& word : mistake) typed += " " + word;
    EXPECT_EQ(SeamRender(mistake, &said), 2) << typed;
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << typed << ": " << said;
    EXPECT_EQ(said.rfind("seam-render: ", 0), 0u) << typed << ": " << said;
    EXPECT_EQ(folder.List(), std::vector<std::string>{"not.lcm"}) << typed;
  }
}

TEST_F(RenderLog, GivesTheSameFilesInEveryRunAndWithAnyNumberOfProcesses) {
  std::vector<std::vector<std::string>> runs;
  for (const char* threads : {"1", "4", "3"}) {
    const std::string out = folder_ / (std::string("run") + threads);
    std::string said;
    ASSERT_EQ(SeamRender({log_, "-o", out, "--oracle", oracle_, "--threads", threads, "--size",
                          "480x270", "--fps", "10", "--view", "all"},
                         &said),
              0)
        << said;
    EXPECT_NE(said.find("31 frames in " + out), std::string::npos) << said;
    EXPECT_NE(said.find("x real time at 10 fps"), std::string::npos) << said;
    runs.push_back(Frames(out));
  }
  ASSERT_EQ(runs[0].size(), 31u);
  for (const auto& run : runs) EXPECT_TRUE(run == runs[0]);
}

TEST_F(RenderLog, FromAndToPickTheSameFramesAsTheWholeHas) {
  const std::vector<std::string> common{log_,      "--oracle", oracle_, "--size",
                                        "480x270", "--fps",    "10",    "-o"};
  auto whole = common, part = common;
  whole.push_back(folder_ / "whole");
  part.insert(part.end(), {folder_ / "part", "--from", "1", "--to", "1.55"});
  ASSERT_EQ(SeamRender(whole), 0);
  ASSERT_EQ(SeamRender(part), 0);
  const auto all = Frames(folder_ / "whole"), some = Frames(folder_ / "part");
  ASSERT_EQ(some.size(), 6u);  // 1.0, 1.1, ... 1.5
  for (std::size_t i = 0; i < some.size(); ++i) EXPECT_TRUE(some[i] == all[10 + i]) << i;
}

TEST_F(RenderLog, TheManifestNamesTheLogAndEachFramesMomentAndBox) {
  const std::string out = folder_ / "out";
  ASSERT_EQ(SeamRender({log_, "-o", out, "--oracle", oracle_, "--size", "320x240", "--fps", "2"}),
            0);
  const std::string manifest = Content(out + "/manifest.json");
  EXPECT_NE(manifest.find("\"name\": \"log.lcm\", \"hash\": \"fnv1a-64:"), std::string::npos);
  EXPECT_NE(manifest.find("{\"file\": \"frame_00001.png\", \"time_s\": 0.500000, \"tick\": 30.000"),
            std::string::npos)
      << manifest;
  // The page's notes on its view, by frame.
  for (const char* key : {"\"panels\": [{\"error_m\": 0, \"round_trip_ms\": null,",
                          "\"jitter_ms\": null,", "\"loss_percent\": null,", "\"view_age_ms\": ",
                          "\"corrections\": 0}"})
    EXPECT_NE(manifest.find(key), std::string::npos) << key << " in\n" << manifest;
  const std::string frame = Content(out + "/frame_00000.png");
  EXPECT_NE(frame.find("seam-render "), std::string::npos);
  EXPECT_NE(frame.find("log.lcm fnv1a-64:"), std::string::npos);
}

TEST_F(RenderLog, AViewIsNamedByItsPlayerAndAWrongNameListsThem) {
  std::string said;
  const std::vector<std::string> common{log_,     "--oracle", oracle_, "--size",
                                        "320x240", "--fps",    "1",     "-o"};
  std::vector<std::string> named = common, numbered = common, wrong = common;
  named.insert(named.end(), {folder_ / "a", "--view", "ann"});
  numbered.insert(numbered.end(), {folder_ / "b", "--view", "1"});
  wrong.insert(wrong.end(), {folder_ / "c", "--view", "nobody"});
  EXPECT_EQ(SeamRender(named), 0);
  EXPECT_EQ(SeamRender(numbered), 0);
  EXPECT_EQ(Frames(folder_ / "a"), Frames(folder_ / "b"));
  EXPECT_EQ(SeamRender(wrong, &said), 2);
  EXPECT_NE(said.find("the recording has views of server, ann, ben"), std::string::npos) << said;
}

TEST_F(RenderLog, ASheetIsOnePictureAndAroundChoosesItsMoments) {
  const std::string sheet = folder_ / "sheet.png";
  std::string said;
  EXPECT_EQ(SeamRender({log_, "-o", sheet, "--oracle", oracle_, "--sheet", "6", "--around",
                        "contact", "--layers", "vectors,heat", "--size", "640x360"},
                       &said),
            0)
      << said;
  EXPECT_NE(said.find("6 moments, 0.75 s to 2.25 s"), std::string::npos) << said;
  EXPECT_EQ(ReadPng(sheet).width_px, 640);
}

TEST_F(RenderLog, SlowMotionDrawsMoreMomentsOfTheSameTime) {
  const auto frames = [&](const char* name, const char* speed) {
    EXPECT_EQ(SeamRender({log_, "-o", folder_ / name, "--oracle", oracle_, "--size", "320x240",
                          "--fps", "10", "--from", "1", "--to", "1.5", "--speed", speed}),
              0);
    return Frames(folder_ / name);
  };
  const auto normal = frames("normal", "1"), slow = frames("slow", "0.5");
  ASSERT_EQ(normal.size(), 6u);
  ASSERT_EQ(slow.size(), 11u);
  for (std::size_t i = 0; i < normal.size(); ++i) EXPECT_EQ(normal[i], slow[2 * i]) << i;
}

TEST_F(RenderLog, DrawsWithTheOracleItComputesItself) {
  std::string said;
  ASSERT_EQ(SeamRender({log_, "-o", folder_ / "out", "--from", "1", "--to", "1"}, &said), 0)
      << said;
  EXPECT_EQ(Frames(folder_ / "out").size(), 1u);
}

TEST_F(RenderLog, ComparesRunsAndPicturesTheirCollision) {
  std::string said;
  ASSERT_EQ(SeamRender({"--compare", log_, strict_, "-o", folder_ / "out", "--oracle", oracle_,
                        "--from", "1", "--to", "1.2"},
                       &said),
            0)
      << said;
  EXPECT_EQ(Frames(folder_ / "out").size(), 7u);
  const std::string one = folder_ / "one.png", all = folder_ / "all.png";
  ASSERT_EQ(SeamRender({"--strobe", log_, "-o", one, "--oracle", oracle_}, &said), 0) << said;
  ASSERT_EQ(
      SeamRender({"--strobe", "--compare", oracle_, strict_, log_, "-o", all, "--oracle", oracle_},
                 &said),
      0)
      << said;
  const Image single = ReadPng(one), rows = ReadPng(all);
  EXPECT_EQ(single.width_px, 1280);
  EXPECT_GT(rows.height_px, single.height_px + 150);
  // Again gives the same, over the old file.
  const std::string before = Content(all);
  ASSERT_EQ(SeamRender({"--strobe", "--compare", oracle_, strict_, log_, "-o", all, "--oracle",
                        oracle_, "--force"}),
            0);
  EXPECT_EQ(Content(all), before);
}

TEST_F(RenderLog, DrawsADamagedLogAsFarAsItIsGood) {
  const std::string bytes = Content(log_), damaged = folder_ / "damaged.lcm";
  std::string torn = bytes.substr(0, bytes.size() / 2 + 13);
  for (std::size_t i = bytes.size() / 4; i < bytes.size() / 4 + 40; ++i) torn[i] = '\xee';
  std::ofstream(damaged, std::ios::binary) << torn;
  std::string said;
  ASSERT_EQ(SeamRender({damaged, "-o", folder_ / "out", "--fps", "5", "--oracle", oracle_}, &said),
            1)
      << said;
  const std::size_t frames = Frames(folder_ / "out").size();
  EXPECT_GE(frames, 7u);
  EXPECT_LE(frames, 9u);
}

TEST_F(RenderLog, AViewThatClaimsTheEndOfTimeIsLeftOut) {
  Recording recording = synthetic::MakeRecording(0);
  recording.views[1][synthetic::kTicks].tick = kTickMax - 1;
  const std::string log = folder_ / "wild.lcm";
  synthetic::WriteLog(log, recording);
  std::string said;
  EXPECT_EQ(SeamRender({log, "-o", folder_ / "out", "--fps", "5"}, &said), 1) << said;
  EXPECT_EQ(Frames(folder_ / "out").size(), 16u);
}

TEST_F(RenderLog, MistakesInTheRequestWriteNothing) {
  const std::string out = folder_ / "out";
  const std::vector<std::vector<std::string>> mistakes{
      {log_, "-o", out, "--view", "7"},
      {log_, "-o", out, "--from", "30"},
      {log_, "-o", out, "--to", "-1"},
      {log_, "-o", out, "--oracle", strict_},
      {log_, "-o", out, "--oracle", folder_ / "none"},
      {log_, "-o", out, "--room", "other"},
      {log_, "-o", out, "--fonts", "/nowhere"},
      {"--strobe", log_, "-o", out + ".png", "--from", "30"},
      {"--strobe", log_, "-o", out + ".png", "--fonts", "/nowhere"},
      {log_, "-o", out, "--video", out + ".avi"},
      {log_, "-o", log_},
  };
  for (const auto& mistake : mistakes) {
    std::string said, typed;
    for (const std::string& word : mistake) typed += " " + word;
    EXPECT_EQ(SeamRender(mistake, &said), 2) << typed;
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << typed << ": " << said;
    EXPECT_EQ(folder_.List(), untouched_) << typed;
  }
}

TEST_F(RenderLog, WithoutFfmpegAVideoIsRefusedBeforeAnythingIsDrawn) {
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  std::string said;
  const int status = SeamRender({log_, "-o", folder_ / "out", "--video", folder_ / "a.mp4"}, &said);
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(status, 2);
  EXPECT_NE(said.find("ffmpeg"), std::string::npos) << said;
  EXPECT_EQ(folder_.List(), untouched_);
}

}  // namespace render_test
}  // namespace seam
