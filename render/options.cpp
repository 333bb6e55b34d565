#include "render/options.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>

#include "common/base/check.h"
#include "render/canvas/font.h"
#include "render/frame.h"

namespace seam {
namespace {

void ParseSize(const std::string& text, RenderOptions* o) {
  int width = 0, height = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) != 2 || width < 320 ||
      width > 7680 || height < 240 || height > 7680)
    throw OperatorError("--size " + text + ": must be WIDTHxHEIGHT, 320x240 to 7680x7680");
  o->width_px = width;
  o->height_px = height;
  o->size_given = true;
}

void ParseView(const std::string& text, RenderOptions* o) {
  o->peer_given = true;
  if (text == "all") {
    o->peer = kViewAll;
    return;
  }
  int peer = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%d%c", &peer, &rest) != 1 || peer < 0 || peer > 127)
    throw OperatorError("--view " + text + ": must be a peer's number or all");
  o->peer = peer;
}

/// Requires logs.
void CheckPage(const RenderOptions& o) {
  if (o.compare || o.strobe || o.live || o.peer_given || o.every_ticks != 0 || !o.video.empty())
    throw OperatorError("--page has all views of all logs: it goes with no other kind of picture");
  if (!std::isnan(o.from_s) || !std::isnan(o.to_s))
    throw OperatorError("--page has the whole recording: it takes no --from and --to");
  if (!o.room.empty() && o.logs.size() > 1)
    throw OperatorError("--room does not go with several logs");
  if (o.logs.size() > 10) throw OperatorError("at most 10 logs fit on a page");
}

void Check(const RenderOptions& o) {
  if (o.out.empty()) throw OperatorError("-o is missing: where should the pictures go?");
  if (o.live) {
    if (!o.logs.empty()) throw OperatorError("--live listens to the bus: it takes no log");
    if (o.compare || o.strobe) throw OperatorError("--live draws frames of one session only");
    if (!std::isnan(o.from_s) || !std::isnan(o.to_s))
      throw OperatorError("--from and --to do not go with --live");
  } else if (o.logs.empty()) {
    throw OperatorError("no log given: seam-render session.lcm -o frames/");
  } else if (!o.room.empty() && o.compare) {
    throw OperatorError("--room does not go with --compare");
  }
  if (o.page) return CheckPage(o);
  if (o.logs.size() > 1 && !o.compare)
    throw OperatorError("several logs: add --compare to draw them in one picture");
  if (o.logs.size() > 9) throw OperatorError("at most 9 logs can be compared");
  if (o.compare && o.peer_given && o.peer == kViewAll)
    throw OperatorError("--view all does not go with --compare");
  if (o.strobe && o.peer_given && o.peer == kViewAll)
    throw OperatorError("--view all does not go with --strobe: it draws the clients' views");
  if (o.strobe && !o.video.empty()) throw OperatorError("--video does not go with --strobe");
  if (o.every_ticks != 0 && !o.strobe) throw OperatorError("--every goes with --strobe only");
  if (o.fps < 1 || o.fps > 240) throw OperatorError("--fps must be 1 to 240");
  if (o.threads < 0 || o.threads > 64) throw OperatorError("--threads must be 1 to 64");
  if (o.every_ticks < 0) throw OperatorError("--every must be at least 1 tick");
  if (!(o.seconds >= 0)) throw OperatorError("--seconds must be positive");
  if (!std::isnan(o.from_s) && !std::isnan(o.to_s) && o.from_s > o.to_s)
    throw OperatorError("--from must not be after --to");
  if (!o.video.empty() && (o.width_px % 2 != 0 || o.height_px % 2 != 0))
    throw OperatorError("--video needs an even width and height");
}

}  // namespace

const char* const kRenderExamples =
    "examples:\n"
    "  seam-render session.lcm -o frames/                      one peer's view\n"
    "  seam-render session.lcm -o frames/ --view all           all peers side by side\n"
    "  seam-render --compare a.lcm b.lcm c.lcm -o frames/      runs in step\n"
    "  seam-render --strobe a.lcm -o hit.png                   one collision in one picture\n"
    "  seam-render --strobe --compare a.lcm b.lcm -o hits.png  a row for each run\n"
    "  seam-render --page a.lcm b.lcm -o review.html           a page to look through in a "
    "browser\n"
    "  seam-render --live -o frames/                           what the LCM bus brings";

void DefineRenderOptions(CLI::App* app, RenderOptions* options) {
  RenderOptions& o = *options;
  o.fonts = kFontFolder;
  app->add_option("logs", o.logs, "LCM logs of sessions");
  app->add_option("-o,--out", o.out,
                  "folder for frames, or the .png of --strobe, the .html of --page");
  app->add_flag("--compare", o.compare, "several logs in one picture, in step by tick");
  app->add_flag("--strobe", o.strobe, "many exposures of one collision in one picture");
  app->add_flag("--page", o.page, "one HTML file of all views, to look through in a browser");
  app->add_flag("--live", o.live, "draw what the LCM bus brings");
  app->add_flag("--force", o.force, "write even where other files are");
  app->add_option("--fps", o.fps, "frames per second of the session (30)");
  app->add_option("--size", o.size_text, "WIDTHxHEIGHT in pixels (1280x720)");
  app->add_option("--from", o.from_s, "first moment, s");
  app->add_option("--to", o.to_s, "last moment, s");
  app->add_option("--view", o.view_text, "whose view: a peer's number, or all (0, the server)");
  app->add_option("--oracle", o.oracle, "log of the same scene made in mode oracle (computed)");
  app->add_option("--threads", o.threads, "frames drawn at a time (number of cores)");
  app->add_option("--every", o.every_ticks, "--strobe: ticks between exposures");
  app->add_option("--lcm-url", o.lcm_url, "--live: the bus (LCM_DEFAULT_URL)");
  app->add_option("--room", o.room, "which room, if there are several");
  app->add_option("--seconds", o.seconds, "--live: stop after so long (when quiet for 2 s)");
  app->add_option("--video", o.video, "also make this .mp4 of the frames, by ffmpeg");
  app->add_option("--fonts", o.fonts, "folder of DejaVuSans.ttf and DejaVuSans-Bold.ttf");
}

void CheckRenderOptions(RenderOptions* options) {
  if (!options->size_text.empty()) ParseSize(options->size_text, options);
  if (!options->view_text.empty()) ParseView(options->view_text, options);
  Check(*options);
}

}  // namespace seam
