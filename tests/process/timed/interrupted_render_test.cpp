/// A picture is written whole or not at all, even if seam-render is interrupted.

#include <gtest/gtest.h>
#include <signal.h>

#include <filesystem>
#include <fstream>

#include "render/canvas/png_writer.h"
#include "tests/support/program.h"

namespace seam {
namespace interrupted_render_test {

namespace fs = std::filesystem;

/// A recording of `seconds` in `folder`.
std::string MakeLog(const Workspace& folder, const std::string& seconds) {
  Program lab({BuiltProgram("seam-lab"), "run", "scenes/crossing.toml", "-o", folder / "run.lcm",
               "--no-floor", "--duration", seconds});
  EXPECT_TRUE(lab.Wait(60) && lab.status() == 0) << lab.Story();
  return folder / "run.lcm";
}

/// The pictures of a folder, each of which must be whole.
int WholePictures(const std::string& folder) {
  int pictures = 0;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() != ".png") continue;
    EXPECT_NO_THROW(ReadPng(entry.path().string())) << entry.path();
    ++pictures;
  }
  return pictures;
}

TEST(InterruptedRender, LeavesWholePicturesAndTheNextRunGoesIntoTheSameFolder) {
  const Workspace folder;
  const std::string log = MakeLog(folder, "6"), frames = folder / "frames";
  Program render({BuiltProgram("seam-render"), log, "-o", frames, "--size", "1920x1080"});
  for (int i = 0; i < 6000 && !fs::exists(frames + "/frame_00004.png"); ++i) {
    if (render.Wait(0.01)) break;
  }
  render.Signal(SIGINT);
  ASSERT_TRUE(render.Wait(30));
  EXPECT_EQ(render.status(), 128 + SIGINT) << render.Story();
  EXPECT_GE(WholePictures(frames), 1);
  std::ofstream(frames + "/frame_00099.png.tmp") << "half of one";
  Program again({BuiltProgram("seam-render"), log, "-o", frames, "--size", "320x240", "--to", "0",
                 "--force"});
  ASSERT_TRUE(again.Wait(60));
  EXPECT_EQ(again.status(), 0) << again.Story();
  EXPECT_EQ(WholePictures(frames), 1);
  EXPECT_FALSE(fs::exists(frames + "/frame_00099.png.tmp"));
}

TEST(InterruptedRender, AFullDiskLeavesTheOldPictureAndNothingElse) {
  const Workspace folder;
  const std::string log = MakeLog(folder, "6");
  folder.Write("old.png", "the old picture");
  // GCOV_PREFIX: under coverage its counters go elsewhere, not half into everybody's files.
  Program render({"env", "GCOV_PREFIX=" + folder.path(), "sh", "-c",
                  "trap '' XFSZ; ulimit -f 1; exec \"$@\"", "sh", BuiltProgram("seam-render"),
                  "--strobe", log, "-o", folder / "old.png", "--force"});
  ASSERT_TRUE(render.Wait(60));
  EXPECT_EQ(render.status(), 2) << render.Story();
  std::ifstream old(folder / "old.png");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(old), {}), "the old picture");
  EXPECT_FALSE(fs::exists(folder / "old.png.tmp"));
}

}  // namespace interrupted_render_test
}  // namespace seam
