#include "render/options.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "common/base/check.h"
#include "common/base/command_line.h"
#include "common/record/log_sessions.h"
#include "render/canvas/font.h"
#include "render/frame.h"
#include "render/scene_recording.h"

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
  if (std::sscanf(text.c_str(), "%d%c", &peer, &rest) != 1) {
    o->view_name = text;  // checked later: the recording has the players
    return;
  }
  if (peer < 0 || peer > 127)
    throw OperatorError("--view " + text + ": must be a peer's number, a player's name or all");
  o->peer = peer;
}

/// Checks the options of --page. Requires logs.
void CheckPage(const RenderOptions& o) {
  const bool picture = o.sheet > 0 || !o.around.empty() || o.speed != 1 || o.peer_given ||
                       o.every_ticks != 0 || !o.video.empty() || !o.camera_text.empty() ||
                       !o.layers_text.empty() || !o.view_name.empty();
  if (o.compare || o.strobe || o.live || picture)
    throw OperatorError("--page has all views of all logs: it goes with no other kind of picture");
  if (!std::isnan(o.from_s) || !std::isnan(o.to_s))
    throw OperatorError("--page has the whole recording: it takes no --from and --to");
  if (!o.room.empty() && o.logs.size() > 1)
    throw OperatorError("--room does not go with several logs");
  if (o.logs.size() > 10) throw OperatorError("at most 10 logs fit on a page");
}

/// Parses "X,Y,HEIGHT", "fit" or "scene".
void ParseCamera(const std::string& text, CameraWish* camera) {
  if (text == "fit") return;
  if (text == "scene") {
    camera->kind = CameraWish::Kind::kScene;
    return;
  }
  float x = 0, y = 0, height = 0;
  char rest = 0;
  const int read = std::sscanf(text.c_str(), "%f,%f,%f%c", &x, &y, &height, &rest);
  const bool sane = std::abs(x) <= 1e6f && std::abs(y) <= 1e6f && height >= 0.01f && height <= 1e6f;
  if (read != 3 || !sane)
    throw OperatorError("--camera " + text + ": must be fit, scene or X,Y,HEIGHT in m");
  camera->kind = CameraWish::Kind::kFixed;
  camera->centre = {x, y};
  camera->height = height;
}

void ParseLayers(const std::string& text, WorldLook* look) {
  const std::pair<const char*, bool*> layers[] = {
      {"trails", &look->trails},         {"ghosts", &look->ghosts},
      {"vectors", &look->vectors},       {"heat", &look->heat},
      {"names", &look->names},           {"parts", &look->parts},
      {"divergence", &look->divergence}, {"doubts", &look->doubts}};
  for (const auto& [name, on] : layers) *on = false;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    const auto known = std::find_if(std::begin(layers), std::end(layers),
                                    [&](const auto& layer) { return word == layer.first; });
    if (word == "none") continue;
    if (known == std::end(layers))
      throw OperatorError(
          "--layers " + word +
          ": there are trails, parts, ghosts, vectors, heat, names, divergence, doubts and none");
    *known->second = true;
  }
  look->trails |= look->parts;
}

bool IsTick(const std::string& text) {
  return !text.empty() && text.size() <= 10 &&
         text.find_first_not_of("0123456789") == std::string::npos;
}

/// Checks combinations of the flags for the camera and for moments.
void CheckShots(const RenderOptions& o) {
  if (!o.around.empty() && o.around != "contact" && o.around != "worst" &&
      o.around != "hand-over" && !IsTick(o.around))
    throw OperatorError("--around " + o.around + ": must be contact, worst, hand-over or a tick");
  if (!o.around.empty() && (!std::isnan(o.from_s) || !std::isnan(o.to_s)))
    throw OperatorError("--around chooses the moments itself: not with --from and --to");
  if (!(o.camera.zoom >= 0.01f && o.camera.zoom <= 1000))
    throw OperatorError("--zoom must be 0.01 to 1000");
  if (!(o.speed >= 0.001 && o.speed <= 1000)) throw OperatorError("--speed must be 0.001 to 1000");
  if (o.sheet > 0 && (o.strobe || !o.video.empty()))
    throw OperatorError("--sheet is one picture: not with --strobe or --video");
  const bool shots = o.sheet > 0 || !o.around.empty() || o.speed != 1;
  if (o.live && shots) throw OperatorError("--sheet, --around and --speed do not go with --live");
  if (o.strobe && (!o.around.empty() || o.speed != 1))
    throw OperatorError("--around and --speed do not go with --strobe");
}

void Check(const RenderOptions& o) {
  CheckSessions(o.sessions, o.logs.size());
  if (o.list) {
    if (o.logs.empty()) throw OperatorError("--list: no log given");
    return;
  }
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
  const bool scenes = std::any_of(o.logs.begin(), o.logs.end(), IsSceneFile);
  if (scenes && (o.logs.size() > 1 || o.page || o.strobe || !o.video.empty() || !o.around.empty()))
    throw OperatorError("a scene is drawn by itself, as it begins, into one PNG");
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
  CheckShots(o);
  if (!o.video.empty() && (o.width_px % 2 != 0 || o.height_px % 2 != 0))
    throw OperatorError("--video needs an even width and height");
}

}  // namespace

const char* const kRenderExamples =
    "examples:\n"
    "  seam-render session.lcm -o frames/                      one peer's view\n"
    "  seam-render session.lcm -o frames/ --view all           all peers side by side\n"
    "  seam-render --compare a.lcm b.lcm c.lcm -o frames/      runs in step\n"
    "  seam-render --difference a.lcm b.lcm -o frames/         where two runs part\n"
    "  seam-render a.lcm -o hit.png --sheet 12 --around contact    moments in one picture\n"
    "  seam-render a.lcm -o slow/ --around worst --speed 0.1   where it was most wrong, slowly\n"
    "  seam-render --strobe a.lcm -o hit.png                   one collision in one picture\n"
    "  seam-render --strobe --compare a.lcm b.lcm -o hits.png  a row for each run\n"
    "  seam-render --page a.lcm b.lcm -o review.html           a page to look through in a "
    "browser\n"
    "  seam-render scene.toml -o scene.png                     a scene as it begins\n"
    "  seam-render --list session.lcm                          what is in a log\n"
    "  seam-render --live -o frames/                           what the LCM bus brings";

void DefineRenderOptions(Command* app, RenderOptions* options) {
  RenderOptions& o = *options;
  o.fonts = kFontFolder;
  app->Option("logs", o.logs, "LCM logs of sessions, or one scene (.toml) as it begins");
  app->Option("-o,--out", o.out, "folder for frames, or the .png of --strobe, the .html of --page");
  app->Switch("--compare", o.compare, "several logs in one picture, in step by tick");
  app->Switch("--difference", o.difference,
              "two logs in one panel: the second over the first, by how far they are apart");
  app->Switch("--strobe", o.strobe, "many exposures of one collision in one picture");
  app->Switch("--page", o.page, "one HTML file of all views, to look through in a browser");
  app->Switch("--list", o.list, "say what is in the logs, and draw nothing");
  app->Switch("--live", o.live, "draw what the LCM bus brings");
  app->Switch("--force", o.force, "replace the file, or frames in a folder that holds files");
  app->Option("--fps", o.fps, "frames per second of the session (30)");
  app->Option("--size", o.size_text, "WIDTHxHEIGHT in pixels (1280x720)");
  app->Option("--from", o.from_s, "first moment, s");
  app->Option("--to", o.to_s, "last moment, s");
  app->Option("--view", o.view_text,
              "whose view: a player's name, a peer's number, or all (server)");
  app->Option("--oracle", o.oracle, "log of the same scene made in mode oracle (computed)");
  app->Option("--threads", o.threads, "frames drawn at a time (number of cores)");
  app->Option("--camera", o.camera_text, "fit (default: what moves), scene, or X,Y,HEIGHT in m");
  app->Option("--follow", o.camera.part, "a part, or a player's vehicle, stays in the middle");
  app->Option("--zoom", o.camera.zoom, "so many times larger (1)");
  app->Option("--around", o.around,
              "0.5 s before to 1 s after: contact, worst, hand-over or a tick");
  app->Option("--layers", o.layers_text,
              "trails,parts,ghosts,vectors,heat,names,divergence,doubts or none (trails,ghosts)");
  app->Option("--speed", o.speed, "of the sequence: 0.1 is slow motion (1)");
  app->Option("--sheet", o.sheet, "so many moments in one picture: -o is a .png file")
      .Range(1, 100);
  app->Option("--every", o.every_ticks, "--strobe: ticks between exposures");
  app->Option("--lcm-url", o.lcm_url, "--live: the bus (LCM_DEFAULT_URL)");
  app->Option("--room", o.room, "which room, if there are several");
  app->Option("--session", o.sessions,
              "which session of each log, if it has several: its number, or its id (the last)")
      .CommaSeparated()
      .OneValueEach();
  app->Option("--seconds", o.seconds, "--live: stop after so long (when quiet for 2 s)");
  app->Option("--video", o.video, "also make this .mp4, .webm or .gif of the frames, by ffmpeg");
  app->Option("--fonts", o.fonts, "folder of DejaVuSans.ttf and DejaVuSans-Bold.ttf");
}

void CheckRenderOptions(RenderOptions* options) {
  if (options->difference) {
    if (options->logs.size() != 2 || options->strobe || options->live || options->page)
      throw OperatorError("--difference draws frames or a sheet of two logs");
    options->compare = true;
  }
  if (!options->size_text.empty()) ParseSize(options->size_text, options);
  if (!options->view_text.empty()) ParseView(options->view_text, options);
  if (!options->camera.part.empty()) {
    if (!options->camera_text.empty())
      throw OperatorError("--follow does not go with --camera: which is it?");
    options->camera.kind = CameraWish::Kind::kFollow;
  }
  if (!options->camera_text.empty()) ParseCamera(options->camera_text, &options->camera);
  if (!options->layers_text.empty()) ParseLayers(options->layers_text, &options->look);
  Check(*options);
  if (!options->list && !options->logs.empty() && IsSceneFile(options->logs.front())) {
    options->sheet = 1;
  }
}

}  // namespace seam
