#pragma once
/// Servers that keep their rooms, over loopback, and their clients.

#include <gtest/gtest.h>
#include <unistd.h>

#include <string>
#include <vector>

#include "common/record/recording.h"
#include "tests/support/in_namespace.h"
#include "tests/support/live_session.h"

namespace seam {

constexpr double kKeptPatience = 60;
constexpr const char* kKeptPort = "7801";

/// Two cars, a gate that one of them passes, and a script that counts seconds and makes parts.
constexpr const char* kYard = R"(title = "A yard"
[[player]]
name = "ann"
vehicle = "car"
[[player]]
name = "bob"
vehicle = "cart"
[[part]]
name = "ground"
chain = [[-300, 0], [300, 0]]
friction = 0.9
[[part]]
name = "car"
box = [3, 0.6]
position = [-8, 0.9]
velocity = [3, 0]
owner = "ann"
[[part]]
name = "cart"
box = [2, 0.6]
position = [8, 0.9]
owner = "bob"
[[part]]
name = "crate"
box = [0.6, 0.6]
position = [0, 0.3]
repeat = {count = [1, 3], step = [0, 0.6]}
[[trigger]]
name = "gate"
kind = "area"
position = [-6, 0.5]
box = [2, 3]
score = 7
once = true
[[script]]
name = "keeper"
code = '''
function on_tick()
  room.ticks = (room.ticks or 0) + 1
  if room.ticks % 60 == 0 then
    room.seconds = (room.seconds or 0) + 1
    world.say("second " .. room.seconds)
    if room.seconds % 2 == 0 then
      world.add_part{name = "made" .. room.seconds, circle = 0.2, position = {20 + room.seconds, 3}}
    end
  end
end
'''
)";

class KeptRooms : public InNamespace {
 protected:
  std::vector<std::string> Server(const std::vector<std::string>& flags) const {
    std::vector<std::string> words = {BuiltProgram("seam-server"),
                                      "--bind",
                                      "127.0.0.1",
                                      "--port",
                                      kKeptPort,
                                      "--lcm-url",
                                      "none",
                                      "--quiet",
                                      "--duration",
                                      "0"};
    words.insert(words.end(), flags.begin(), flags.end());
    return words;
  }
  std::vector<std::string> Client(const std::string& name) const {
    return {BuiltProgram("seam-client"),
            "127.0.0.1:" + std::string(kKeptPort),
            "--name",
            name,
            "--drive",
            "none",
            "--lcm-url",
            "none",
            "--key",
            folder_ / (name + ".key"),
            "--quiet"};
  }
  std::string State() const { return folder_ / "state"; }
  std::string Log() const { return folder_ / "state/main.lcm"; }
  /// Waits until the recording of the last session is `enough`.
  template <class Enough>
  bool WaitForLog(const Enough& enough) const {
    for (int i = 0; i < kKeptPatience * 20; ++i, usleep(50000)) {
      try {
        if (enough(ReadRecording(Log()))) return true;
      } catch (const std::exception&) {
      }  // not begun yet
    }
    return false;
  }
  Workspace folder_;
};

inline const View* LastView(const Recording& recording, int peer) {
  const auto found = recording.views.find(peer);
  return found == recording.views.end() ? nullptr : &found->second.rbegin()->second;
}

}  // namespace seam
