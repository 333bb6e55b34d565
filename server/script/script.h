#pragma once
/// One script of a scene: Lua 5.4 in a sandbox, with limits to what it may compute and keep. An
/// error stops it for good; the room goes on.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/scene/part_rules.h"
#include "common/scene/toml/toml_tree.h"
#include "server/script/script_host.h"

namespace seam {

class Script {
 public:
  /// Compiles the code and runs it once, which defines its callbacks. `scene_file`: what its
  /// errors begin with. `host` must outlive the script.
  Script(const ScriptSource& source, const std::string& scene_file, std::uint64_t seed,
         ScriptHost& host);
  ~Script();
  Script(const Script&) = delete;
  Script& operator=(const Script&) = delete;

  /// A tick begins: the limit of work is full again.
  void BeginTick();
  /// The callbacks; each does nothing when the script has no such function or is stopped.
  void OnTick(double t);
  void OnTouch(const std::string& a, const std::string& b);
  void OnTrigger(const std::string& trigger, const std::string& part, bool entered);
  void OnJoin(const std::string& player);
  void OnLeave(const std::string& player);
  /// Whether there is a callback of this name now.
  bool Defines(const char* callback) const;
  /// The line of the scene file on which a global function begins; 0: there is nothing of that
  /// name; -1: it is no function of Lua.
  int LineOf(const char* function) const;
  /// Calls a global function with a number and returns its first `results` values (kOther: nil),
  /// tables as trees of 20 000 entries at most. Empty when there is no such function or the script
  /// is stopped, then or by this call.
  std::vector<TomlNode> Ask(const char* function, double argument, int results);

  bool stopped() const;
  /// "scene.toml:12: what", once stopped.
  const std::string& error() const;
  const std::string& name() const;
  /// Of the last tick: instructions and other work; and what it keeps now, bytes.
  std::int64_t work() const;
  std::int64_t memory_bytes() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace seam
