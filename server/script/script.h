#pragma once
/// One script of a scene: Lua 5.4 in a sandbox, with limits to what it may compute and keep. An
/// error stops it for good; the room goes on.

#include <cstdint>
#include <memory>
#include <string>

#include "common/scene/part_rules.h"
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
