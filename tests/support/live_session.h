#pragma once
/// A session of real processes: the stock lcm-logger, seam-server and seam-clients, on a UDP port
/// and an LCM port of their own.

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/record/recording.h"
#include "tests/support/program.h"

namespace seam {

struct SessionPlan {
  std::string name;  ///< base name of its files
  std::string scene = "scenes/crossing.toml";
  std::vector<std::string> server_flags;
  std::map<std::string, std::vector<std::string>> clients;  ///< flags by name
};

class LiveSession {
 public:
  /// Makes or overwrites its files and starts the logger. `index` chooses the ports: a number of
  /// its own for each session in the namespace.
  LiveSession(const Workspace& folder, int index, const SessionPlan& plan);

  /// Waits until the logger listens, then starts the server and the clients; returns false if the
  /// logger does not start.
  bool Begin();
  /// Starts a client, or restarts one that has ended. `terminal`: its standard input, -1 for none.
  Program& Join(const std::string& name, const std::vector<std::string>& flags, int terminal = -1);
  /// Waits for the server and the clients to end by themselves, then ends the logger. Returns false
  /// if one of them does not end within `seconds` after the one before.
  bool Finish(double seconds);

  Program& server() { return *server_; }
  Program& client(const std::string& name) { return *clients_.at(name); }
  /// Returns the messages captured by the logger so far.
  Recording Captured() const;
  /// Waits at most `seconds` until the captured messages are `enough`.
  bool WaitUntil(const std::function<bool(const Recording&)>& enough, double seconds) const;
  std::string capture_path() const { return stem_ + ".lcm"; }
  const std::string& lcm_url() const { return lcm_url_; }
  std::string address() const { return "127.0.0.1:" + port_; }
  /// Returns the output of all programs, for a failure's message.
  std::string Story() const;

 private:
  /// Publishes on `channel` until the logger has written it; returns false if it never does.
  bool Probe(const std::string& channel);

  SessionPlan plan_;
  std::string stem_, port_, lcm_url_;
  std::unique_ptr<Program> logger_, server_;
  std::map<std::string, std::unique_ptr<Program>> clients_;
};

/// Returns the whole number before the last occurrence of `word` in `text`; -1: none.
/// NumberBefore("12 ticks", " ticks") is 12.
long NumberBefore(const std::string& text, const std::string& word);

/// Returns the number of the first event of `recording` that contains `text`; -1: none.
int FindEvent(const Recording& recording, const std::string& text);

}  // namespace seam
