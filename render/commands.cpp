#include "render/commands.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <thread>

#include "common/base/check.h"
#include "common/base/command_line.h"
#include "common/base/process.h"
#include "common/base/progress_count.h"
#include "common/codec/version_line.h"
#include "common/measure/contents/contents.h"
#include "common/record/damage.h"
#include "common/scene/assembly.h"
#include "render/canvas/canvas.h"
#include "render/canvas/palette.h"
#include "render/canvas/png_writer.h"
#include "render/load.h"
#include "render/manifest.h"
#include "render/panel_note.h"
#include "render/playback/moments.h"
#include "render/scene_recording.h"
#include "render/sequence.h"
#include "render/strobe.h"
#include "render/strobe_layout.h"

namespace seam {
namespace {

/// Shows the progress of a sequence, and at the end its speed.
class FrameCount {
 public:
  FrameCount(int total, const std::string& path)
      : total_(total), path_(path), count_("drawing", "frames", total) {}
  void operator()(int done) { count_(done); }
  void Finish(int fps) {
    count_.End();
    const double rate = total_ / std::max(count_.elapsed_s(), 1e-3);
    std::fprintf(stderr, "%d frames in %s, %.0f frames/s, %.1f x real time at %d fps\n", total_,
                 path_.c_str(), rate, rate / fps, fps);
  }

 private:
  int total_;
  std::string path_;
  ProgressCount count_;
};

int ThreadsOf(const RenderOptions& options) {
  if (options.threads > 0) return options.threads;
  return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, 64);
}

constexpr double kBeforeMoment_s = 0.5, kAfterMoment_s = 1;  ///< of --around

/// Returns the moment that --around names, with its bodies.
ShownMoment AroundWhat(const std::string& around, const std::vector<Playback>& playbacks) {
  std::optional<ShownMoment> moment;
  if (around == "contact") {
    moment = ContactMoment(playbacks);
  } else if (around == "worst") {
    moment = WorstMoment(playbacks);
  } else if (around == "hand-over") {
    moment = HandOverMoment(playbacks);
  } else {
    moment = ShownMoment{std::stod(around) / playbacks.front().tick_hz(), {}};
  }
  if (moment) return *moment;
  throw OperatorError("--around " + around + ": nothing of that kind was recorded");
}

/// Sets the requested time range of the page. Throws OperatorError when it is empty.
void ChooseTimes(const RenderOptions& options, const std::vector<Playback>& playbacks, Page* page,
                 CameraWish* wish) {
  double from_s = std::isnan(options.from_s) ? page->from_s : options.from_s;
  double to_s = std::isnan(options.to_s) ? page->to_s : std::min(options.to_s, page->to_s);
  if (!options.around.empty()) {
    const ShownMoment moment = AroundWhat(options.around, playbacks);
    if (moment.s < page->from_s || moment.s > page->to_s)
      throw OperatorError(fmt::format("--around {} is not in the recording, {:.2f} to {:.2f} s",
                                      options.around, page->from_s, page->to_s));
    from_s = std::max(page->from_s, moment.s - kBeforeMoment_s);
    to_s = std::min(page->to_s, moment.s + kAfterMoment_s);
    if (wish->kind == CameraWish::Kind::kFit) wish->bodies = moment.bodies;
  }
  if (from_s < page->from_s || from_s > to_s)
    throw OperatorError(fmt::format("--from and --to must lie in the recording, {:.2f} to {:.2f} s",
                                    page->from_s, page->to_s));
  page->from_s = from_s;
  page->to_s = to_s;
}

/// Shows a scene at its start: fits all movable bodies, with a summary of the scene as subtitle.
void ShowScene(const Scene& scene, Page* page, CameraWish* wish) {
  page->subtitle =
      fmt::format("as it begins  ·  {} parts, {} joints, {} players  ·  {} Hz", scene.parts.size(),
                  scene.joints.size(), scene.players.size(), scene.solver.tick_hz);
  for (const Assembly& assembly : Compose(scene).assemblies)
    if (!assembly.anchored) wish->bodies.insert(assembly.id);
}

/// Makes the requested page, with its camera.
Page PageOf(const RenderOptions& options, const std::vector<Playback>& playbacks) {
  const int peer =
      options.view_name.empty() ? options.peer : PeerNamed(playbacks.front(), options.view_name);
  if (options.peer_given && peer >= 0)
    for (const Playback& playback : playbacks) RequirePeer(playback, peer);
  Page page = options.compare ? MakeComparison(playbacks, peer) : MakePage(playbacks.front(), peer);
  if (options.difference) {
    page = MakeDifference(playbacks, peer);
  }
  page.width_px = options.width_px;
  page.height_px = options.height_px;
  page.look = options.look;
  if (options.difference) {
    page.look.pale = true;
    page.look.ghosts = page.look.trails = false;
  }
  CameraWish wish = options.camera;
  ChooseTimes(options, playbacks, &page, &wish);
  if (IsSceneFile(options.logs.front())) ShowScene(playbacks.front().scene(), &page, &wish);
  SetCamera(wish, playbacks, &page);
  FindCorrections(&page);
  page.about = AboutPictures(options, page);
  return page;
}

}  // namespace

void RenderSequence(const RenderOptions& options) {
  const OutputFolder folder(options.out, options.force);
  if (!options.video.empty()) {
    RequireFfmpeg();
    CheckOutputFile(options.video, VideoEnding(options.video), options.force, {});
  }
  const std::vector<Playback> playbacks = LoadPlaybacks(options);
  const Font font(ScaleOf(options.width_px, options.height_px), TextsOf(playbacks), options.fonts);
  const Page page = PageOf(options, playbacks);
  const std::vector<double> times = FrameTimes(page.from_s, page.to_s, options.fps / options.speed);
  folder.Prepare();
  FrameCount count(static_cast<int>(times.size()), folder.path());
  WriteSequence(page, font, times, std::min(ThreadsOf(options), static_cast<int>(times.size())),
                folder, [&count](int done) { count(done); });
  WriteManifest(options, page, times, folder);
  count.Finish(options.fps);
  if (!options.video.empty()) EncodeVideo(folder, options.fps, options.video);
}

void RenderSheet(const RenderOptions& options) {
  CheckOutputFile(options.out, ".png", options.force, ReadBy(options));
  const std::vector<Playback> playbacks = LoadPlaybacks(options);
  const Page page = PageOf(options, playbacks);
  const Font font(ScaleOf(options.width_px, options.height_px), TextsOf(playbacks), options.fonts);
  DrawList list(font);
  DrawSheet(list, page, options.sheet);
  Image image;
  MakeCanvas(font)->Draw(list, kPaper, &image);
  WritePng(options.out, image, PngEffort::kSmall, page.about);
  if (IsSceneFile(options.logs.front())) {
    std::fprintf(stderr, "%s: %s\n", options.out.c_str(), page.title.c_str());
    return;
  }
  std::fprintf(stderr, "%s: %d moments, %.2f s to %.2f s\n", options.out.c_str(), options.sheet,
               page.from_s, page.to_s);
}

void RenderStrobe(const RenderOptions& options) {
  CheckOutputFile(options.out, ".png", options.force, ReadBy(options));
  const std::vector<Playback> playbacks = LoadPlaybacks(options);
  StrobeOptions strobe;
  strobe.from_s = options.from_s;
  strobe.to_s = options.to_s;
  strobe.every_ticks = options.every_ticks;
  if (options.peer_given) {
    strobe.peer =
        options.view_name.empty() ? options.peer : PeerNamed(playbacks.front(), options.view_name);
  }
  if (options.size_given) {
    strobe.width_px = options.width_px;
    strobe.height_px = options.height_px;
  }
  const StrobePlan plan = PlanStrobe(playbacks, strobe);
  const Font font(StrobeScale(plan.width_px), TextsOf(playbacks), options.fonts);
  DrawList list(font);
  DrawStrobe(list, playbacks, plan);
  Image image;
  MakeCanvas(font)->Draw(list, kPaper, &image);
  WritePng(options.out, image, PngEffort::kSmall);
  std::fprintf(stderr, "%s: %dx%d, %.2f s to %.2f s\n", options.out.c_str(), image.width_px,
               image.height_px, plan.from_s, plan.to_s);
}

int RenderMain(int argc, const char* const* argv) {
  RenderOptions options;
  const ProgramText text{"seam-render",
                         "Draws recordings of Seam2D sessions as PNG pictures, without a display.",
                         VersionLine("seam-render"), kRenderExamples};
  return RunCommandLine(
      text, argc, argv, [&](Command& app) { DefineRenderOptions(&app, &options); },
      [&] {
        CheckRenderOptions(&options);
        if (options.list) {
          for (std::size_t i = 0; i < options.logs.size(); ++i) {
            std::fputs(FormatContents(options.logs[i], ReadLog(options, i)).c_str(), stdout);
          }
        } else if (options.live) {
          RenderLive(options);
        } else if (options.page) {
          RenderReviewPage(options);
        } else if (options.strobe) {
          RenderStrobe(options);
        } else if (options.sheet > 0) {
          RenderSheet(options);
        } else {
          RenderSequence(options);
        }
        return StatusAfterReading(0);
      });
}

}  // namespace seam
