#pragma once
/// One script of a scene: Lua 5.4 in a sandbox, with limits on computation and memory. An error
/// stops the script for good; the room goes on.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/codec/lcm_types.h"
#include "common/scene/part_rules.h"
#include "common/scene/toml/toml_tree.h"
#include "server/script/saved_script.h"
#include "server/script/script_host.h"

namespace seam {

/// The callbacks that the server calls.
inline constexpr const char* kScriptCallbacks[] = {
    "on_join", "on_leave", "on_seat", "on_touch", "on_trigger", "on_tick", "on_message"};

class Script {
 public:
  /// Compiles the code and runs it once, which defines its callbacks. `scene_file` is the prefix of
  /// its error messages. `host` must outlive the script.
  /// `saved`: continues a script that was saved. Its code runs again to define the callbacks; it
  /// finds its table `room` as saved, and requests of changes at this time have no effect, because
  /// the room has them already.
  Script(const ScriptSource& source, const std::string& scene_file, std::uint64_t seed,
         ScriptHost& host, const SavedScript* saved = nullptr);
  ~Script();
  Script(const Script&) = delete;
  Script& operator=(const Script&) = delete;

  /// Begins a tick: resets the work limit.
  void BeginTick();
  /// Run the callbacks. Each does nothing if the script has no such function or is stopped.
  void OnTick(double t);
  void OnTouch(const std::string& a, const std::string& b);
  void OnTrigger(const std::string& trigger, const std::string& part, bool entered);
  void OnJoin(const std::string& player);
  void OnLeave(const std::string& player);
  /// `news`: in, out, far or taken.
  void OnSeat(const std::string& player, const std::string& seat, const char* news);
  void OnMessage(const LcmHeard& heard);
  /// True if the script currently has a callback of this name.
  bool Defines(const char* callback) const;
  /// Returns the line of the scene file on which a global function begins; 0: there is no global of
  /// that name; -1: it is not a function. A C function counts as line 1.
  int LineOf(const char* function) const;
  /// Calls a global function with a number and returns its first `results` values (kOther: nil);
  /// tables become trees of at most 20 000 entries. Returns nothing if there is no such function or
  /// the script is stopped, before or by this call.
  std::vector<TomlNode> Ask(const char* function, double argument, int results);

  /// Returns the state for a saved room. Stops the script if its table `room` cannot be saved.
  SavedScript Save();

  /// False if the code is not Lua.
  bool compiled() const;
  bool stopped() const;
  /// Returns the error as "scene.toml:12: text", once stopped.
  const std::string& error() const;
  const std::string& name() const;
  /// Returns the work of the last tick in units (an instruction is one), and the memory in use,
  /// bytes.
  std::int64_t work() const;
  std::int64_t memory_bytes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace seam
