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
  double duration_s = 0;  ///< 0: until stopped
};

/// Runs until Ctrl-C, `q` in the terminal's view, or the end of a program; ends all programs that
/// it started. Returns the exit status. Throws OperatorError when the scene has no such player.
int Play(const PlayOptions& options);

}  // namespace seam
