#pragma once
/// Shared by the renderer's tests: pages and worlds of the synthetic session, and their pixels.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "render/canvas/canvas.h"
#include "render/canvas/palette.h"
#include "render/canvas/png_writer.h"
#include "render/draw/draw_world.h"
#include "render/frame.h"
#include "tests/support/render_synthetic.h"

namespace seam {

/// A temporary folder of one test.
class Folder {
 public:
  Folder() {
    path_ = ::testing::TempDir() + "seam-render-XXXXXX";
    EXPECT_NE(mkdtemp(path_.data()), nullptr);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }
  /// Returns the file names in the folder, sorted.
  std::vector<std::string> List() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path_))
      names.insert(entry.path().filename());
    return {names.begin(), names.end()};
  }

 private:
  std::string path_;
};

inline std::string Content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline Playback MakePlayback(int late_ticks = 6) {
  return Playback(synthetic::MakeRecording(late_ticks), synthetic::MakeScene(),
                  synthetic::MakeOracle());
}

inline const Font& TestFont() {
  static const Font font(1);
  return font;
}

inline Image Rendered(const DrawList& list) {
  Image image;
  MakeCanvas(TestFont())->Draw(list, kPaper, &image);
  return image;
}

inline Image RenderedPage(const Page& page, double now_s) {
  DrawList list(TestFont());
  DrawPage(list, page, now_s);
  return Rendered(list);
}

/// Draws the world of peer 1 at a tick on a page of its own.
inline Image RenderedWorld(const Playback& playback, double tick, Viewport* viewport,
                           bool cull = true) {
  DrawList list(TestFont());
  list.Begin(800, 400);
  *viewport = SceneViewport({0, 0, 800, 400}, playback, 1, tick);
  WorldLook look;
  look.peer = 1;
  look.tick = tick;
  look.cull = cull;
  DrawWorld(list, *viewport, playback, look);
  return Rendered(list);
}

inline Colour PixelAt(const Image& image, const Vec2& px) {
  const std::uint8_t* p = image.At(static_cast<int>(px.x()), static_cast<int>(px.y()));
  return {p[0], p[1], p[2], 255};
}

/// Counts the pixels of the rectangle that differ.
inline int Differences(const Image& a, const Image& b, int x0, int y0, int x1, int y1) {
  int count = 0;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x)
      if (!std::equal(a.At(x, y), a.At(x, y) + 3, b.At(x, y))) ++count;
  return count;
}

inline int Differences(const Image& a, const Image& b) {
  return Differences(a, b, 0, 0, a.width_px, a.height_px);
}

/// A folder with the synthetic session's log and its oracle's.
class RenderLog : public ::testing::Test {
 protected:
  RenderLog() {
    synthetic::WriteLog(log_, synthetic::MakeRecording(6));
    synthetic::WriteLog(strict_, synthetic::MakeRecording(20, "strict", ""));
    synthetic::WriteLog(oracle_, synthetic::MakeOracleRecording());
  }

  /// Returns the frames of a folder, in order.
  static std::vector<std::string> Frames(const std::string& folder) {
    std::set<std::string> paths;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().extension() == ".png") paths.insert(entry.path());
    }
    std::vector<std::string> frames;
    for (const std::string& path : paths) frames.push_back(Content(path));
    return frames;
  }

  Folder folder_;
  const std::string log_ = folder_ / "log.lcm", strict_ = folder_ / "strict.lcm";
  const std::string oracle_ = folder_ / "oracle.lcm";
  const std::vector<std::string> untouched_{"log.lcm", "oracle.lcm", "strict.lcm"};
};

}  // namespace seam
