#pragma once
/// `seam play` and `seam demo`: a server, its players and a page that shows them, on this machine.

#include <string>

namespace seam {

struct PlayOptions {
  std::string scene = "arena";
  std::string name;  ///< the player to drive; "": the scene's first
  std::string impair = "demo";
  std::string mode = "buffer";
  int bots = 7;           ///< at most
  bool drive = true;      ///< false: bots only, nobody drives
  bool browser = true;    ///< open the page, where there is a display
  int port = 0;           ///< of the page; 0: any
  std::string token;      ///< of the page; "-": a line of standard input; "": one of its own
  double duration_s = 0;  ///< 0: until stopped
};

/// Runs until Ctrl-C, `q` in the terminal's view, or the end of a program; ends all programs that
/// it started. Prints what goes wrong in the room, such as a script that is stopped: then the
/// exit status, which this returns, is 1. Throws OperatorError when the scene has no such player.
int Play(const PlayOptions& options);

}  // namespace seam
