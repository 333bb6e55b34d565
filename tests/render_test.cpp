#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "common/base/check.h"
#include "render/commands.h"
#include "render/png_writer.h"
#include "render/sequence.h"
#include "tests/render_fixture.h"

namespace seam {
namespace {

namespace fs = std::filesystem;

/// Runs seam-render; what it says on stderr goes to `said`.
int SeamRender(const std::vector<std::string>& arguments, std::string* said = nullptr) {
  std::vector<const char*> argv{"seam-render"};
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  ::testing::internal::CaptureStderr();
  const int status = RenderMain(static_cast<int>(argv.size()), argv.data());
  const std::string text = ::testing::internal::GetCapturedStderr();
  if (said != nullptr) *said = text;
  return status;
}

TEST(Sequence, WritesTheSameBytesInEveryRunAndWithAnyNumberOfThreads) {
  const Playback playback = MakePlayback();
  Page page = MakePage(playback, kViewAll);
  page.width_px = 640;
  page.height_px = 360;
  const Font font(ScaleOf(640, 360));
  const std::vector<double> times = FrameTimes(1, 1.5, 30);
  std::vector<std::vector<std::string>> runs;
  for (int threads : {1, 1, 2, 5}) {
    Folder folder;
    const OutputFolder output(folder / "frames", false);
    output.Prepare();
    int done = 0;
    WriteSequence(page, font, times, threads, output, [&done](int) { ++done; });
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
  for (std::size_t i = 0; i < times.size(); ++i)   // 30 frames/s of 60 ticks/s: every other tick
    EXPECT_EQ(playback.TickAt(times[i]), 30 + 2 * static_cast<double>(i));
}

TEST(Sequence, AFrameIsThePageAtItsMoment) {
  Folder folder;
  const Playback playback = MakePlayback();
  const Page page = MakePage(playback, 1);
  const OutputFolder output(folder / "frames", false);
  output.Prepare();
  WriteSequence(page, TestFont(), FrameTimes(1.2, 1.3, 10), 2, output, [](int) {});
  EXPECT_EQ(ReadPng(output.FramePath(0)).rgb, RenderedPage(page, 1.2).rgb);
  EXPECT_EQ(ReadPng(output.FramePath(1)).rgb, RenderedPage(page, 1.3).rgb);
}

TEST(Sequence, AFrameThatCannotBeWrittenStopsItWithAnError) {
  Folder folder;
  const Playback playback = MakePlayback();
  const OutputFolder output(folder / "never-prepared", false);
  EXPECT_THROW(WriteSequence(MakePage(playback, 1), TestFont(), FrameTimes(0, 1, 10), 2, output,
                             [](int) {}),
               OperatorError);
}

TEST(OutputFolder, RefusesOtherPeoplesFilesAndReplacesItsOwnFrames) {
  Folder folder;
  const std::string path = folder / "frames";
  OutputFolder(path, false).Prepare();
  for (const char* name : {"/frame_00000.png", "/frame_00007.png"}) std::ofstream(path + name) << 1;
  OutputFolder(path, false).Prepare();
  EXPECT_TRUE(fs::is_empty(path));
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

}  // namespace
}  // namespace seam
