#pragma once
/// Options of seam-render, checked as far as flags alone can be.

#include <limits>
#include <string>
#include <vector>

#include "render/draw/draw_world.h"
#include "render/playback/camera.h"

namespace seam {

class Command;

struct RenderOptions {
  std::vector<std::string> logs;
  std::string out;  ///< folder; a file for strobe and page
  bool compare = false, strobe = false, live = false, force = false;
  bool difference = false;  ///< two logs in one panel: then compare is set too
  bool page = false;        ///< one HTML file of all views
  bool list = false;        ///< prints the contents of the logs, and draws nothing
  int fps = 30;
  int width_px = 1280, height_px = 720;
  bool size_given = false;
  double from_s = std::numeric_limits<double>::quiet_NaN();  ///< NaN: the recording's own
  double to_s = std::numeric_limits<double>::quiet_NaN();
  bool peer_given = false;
  std::string view_name;  ///< a player's name, or "server"; "": use `peer`
  int peer = 0;           ///< kViewAll: all side by side
  std::string oracle;     ///< log made in mode oracle; "": computed
  int threads = 0;        ///< 0: as many as there are cores
  int every_ticks = 0;
  std::string lcm_url, room;
  std::vector<std::string> sessions;  ///< of each log, by number or id; empty: the last ones
  double seconds = 0;  ///< live: greatest duration; 0: until no messages come
  std::string video;
  int sheet = 0;       ///< number of moments in one picture; 0: a sequence
  double speed = 1;    ///< playing speed of the sequence: 0.1 is slow motion
  std::string around;  ///< "contact", "worst", "hand-over" or a tick; "": the whole recording
  CameraWish camera;
  WorldLook look;  ///< its layers
  /// Raw texts of flags, parsed by CheckRenderOptions.
  std::string size_text, view_text, camera_text, layers_text;
  std::string fonts;
};

/// The last lines of --help.
extern const char* const kRenderExamples;

/// Defines the flags. Parsed values go to `options`, which must outlive `app`.
void DefineRenderOptions(Command* app, RenderOptions* options);

/// Checks the options after parsing. Throws OperatorError, one line, for a flag that is malformed
/// or conflicts with another one.
void CheckRenderOptions(RenderOptions* options);

}  // namespace seam
