#pragma once
/// Flags of seam-server.

#include <cstdint>
#include <string>
#include <vector>

#include "common/base/command_line.h"

namespace seam {

struct ServerFlags {
  std::vector<std::string> scenes;
  int port = 7777;
  std::string bind = "[::]";
  std::string mode = "buffer";
  std::string reconcile;
  std::string predict;
  int input_delay_ticks = -1;  // -1: the scene's
  std::string impair = "perfect";
  std::int64_t seed = 1;
  int send_hz = 30;
  std::string budget;  // "": kClientBytesPerS
  std::string room = "main";
  int wait = -1;
  double duration_s = -1;  // the scene's
  std::string record;
  bool force = false;
  std::string state;   // folder to keep the rooms in
  std::string resume;  // the same, of rooms to go on with
  double segment_mb = 256;
  std::string keep;    // "": all
  std::string store;   // database of past sessions
  std::string events;
  std::string summary;  // file for the sums of the sessions
  std::string lcm_url;
  std::string publish = "all";
  bool quiet = false;
  bool doctor = false;
  int rooms = 0;  // 0: one for each scene
  int workers = 0;
  std::string bus_rooms = "first";
  int metrics_port = 0;
  std::string metrics_bind;
  std::string metrics_rooms = "all";
  int control_port = -1;  // -1: no door; 0: any that is free
  std::string trust = "act";
  std::string identity, token_key, log_key;
  std::string drain_to;   // address at which the rooms go on after SIGTERM; "fleet": any server's
  bool standby = false;
  std::string directory;  // of the fleet; "": none
  std::string fleet = "main";
  std::string server_id;  // in the directory; "": from the address
  std::string advertise;  // address under which clients reach it
  int capacity = 64;
  bool gateway = false;
  bool agones = false;
};

/// Defines the flags, which set `flags`.
void DefineServerFlags(Command& app, ServerFlags& flags);
/// Returns the network profiles and reconcilers for --help.
std::string ProfilesText();
/// Returns "which scene? ..." with the names of known scenes.
std::string WhichScene();
/// Parses bytes a second: "64kB/s", "64000". Throws OperatorError.
double ParseBudget(const std::string& text);

}  // namespace seam
