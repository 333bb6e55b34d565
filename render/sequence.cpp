#include "render/sequence.h"

#include <memory>

#include "common/base/check.h"
#include "render/canvas/canvas.h"
#include "render/canvas/palette.h"
#include "render/canvas/png_writer.h"
#include "render/drawing_processes.h"

namespace seam {

std::vector<double> FrameTimes(double from_s, double to_s, double fps) {
  if ((to_s - from_s) * fps > kFramesMax)
    throw OperatorError("more than " + std::to_string(kFramesMax) +
                        " frames: choose a part with --from and --to");
  std::vector<double> times;
  for (int i = 0;; ++i) {
    const double s = from_s + i / fps;
    if (s > to_s + 1e-9) break;
    times.push_back(s);
  }
  return times;
}

void WriteSequence(const Page& page, const Font& font, const std::vector<double>& times_s,
                   int processes, const OutputFolder& folder, const Progress& progress) {
  const std::unique_ptr<Canvas> canvas = MakeCanvas(font);
  DrawList list(font);
  Image still, image;
  DrawStill(list, page);
  canvas->Draw(list, kPaper, &still);
  const auto draw = [&](int frame) {
    DrawMoving(list, page, times_s[static_cast<std::size_t>(frame)]);
    canvas->Draw(list, still, &image);
    WritePng(folder.FramePath(frame), image, PngEffort::kFast, page.about);
  };
  const int count = static_cast<int>(times_s.size());
  // Draws the first frame in this process, so that the shaders are compiled once.
  const int here = processes > 1 ? 1 : count;
  for (int i = 0; i < here; ++i) {
    draw(i);
    progress(i + 1);
  }
  if (here == count) return;
  DrawInProcesses(
      count - here, processes, [&](int i) { draw(here + i); },
      [&](int done) { progress(here + done); });
}

}  // namespace seam
