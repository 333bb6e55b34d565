#include "render/sequence.h"

#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

#include "common/base/check.h"
#include "render/canvas/canvas.h"
#include "render/canvas/palette.h"
#include "render/canvas/png_writer.h"

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
                   int threads, const OutputFolder& folder, const Progress& progress) {
  std::atomic<std::size_t> next{0};
  std::mutex mutex;  // guards done, first_error and the callback
  int done = 0;
  std::exception_ptr first_error;
  const auto work = [&] {
    try {
      const std::unique_ptr<Canvas> canvas = MakeCanvas(font);
      DrawList list(font);
      Image still, image;
      DrawStill(list, page);
      canvas->Draw(list, kPaper, &still);
      for (std::size_t i = next++; i < times_s.size(); i = next++) {
        DrawMoving(list, page, times_s[i]);
        canvas->Draw(list, still, &image);
        WritePng(folder.FramePath(static_cast<int>(i)), image, PngEffort::kFast, page.about);
        const std::lock_guard<std::mutex> lock(mutex);
        progress(++done);
      }
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex);
      if (!first_error) first_error = std::current_exception();
      next = times_s.size();
    }
  };
  std::vector<std::thread> helpers;
  for (int i = 1; i < threads; ++i) helpers.emplace_back(work);
  work();
  for (std::thread& helper : helpers) helper.join();
  if (first_error) std::rethrow_exception(first_error);
}

}  // namespace seam
