#pragma once
/// Servers and clients of a fleet as programs, with a directory in a file.

#include <unistd.h>

#include <memory>
#include <string>
#include <vector>

#include "common/fleet/directory.h"
#include "tests/support/in_namespace.h"
#include "tests/support/program.h"

namespace seam {
namespace fleet_test {

constexpr double kPatience = 60;

class FleetPrograms : public InNamespace {
 protected:
  std::unique_ptr<Program> Server(const std::string& id, const std::vector<std::string>& flags) {
    const std::string port = std::to_string(7800 + id.back() - 'a');
    std::vector<std::string> words = {BuiltProgram("seam-server"),
                                      "--bind",
                                      "127.0.0.1",
                                      "--port",
                                      port,
                                      "--lcm-url",
                                      "none",
                                      "--id",
                                      id,
                                      "--directory",
                                      directory_,
                                      "--duration",
                                      "0"};
    words.insert(words.end(), flags.begin(), flags.end());
    return std::make_unique<Program>(words);
  }
  std::unique_ptr<Program> Client(const std::string& name, const std::vector<std::string>& flags) {
    std::vector<std::string> words = {BuiltProgram("seam-client"),
                                      "--name",
                                      name,
                                      "--drive",
                                      "bot",
                                      "--lcm-url",
                                      "none",
                                      "--quiet",
                                      "--join-timeout",
                                      "30"};
    words.insert(words.end(), flags.begin(), flags.end());
    return std::make_unique<Program>(words);
  }
  std::string State() const { return folder_ / rooms_; }
  /// Returns how often a player has come to this server.
  static int Came(const Program& server, const std::string& name) {
    const std::string errors = server.errors(), line = ": " + name + " is here as ";
    int count = 0;
    for (std::size_t at = 0; (at = errors.find(line, at)) != std::string::npos; ++at) ++count;
    return count;
  }
  static bool BothCame(const Program& server, int times) {
    return Came(server, "ann") >= times && Came(server, "bob") >= times;
  }
  template <class Condition>
  static bool WaitFor(double seconds, const Condition& condition) {
    for (int i = 0; i < seconds * 100; ++i, usleep(10000)) {
      if (condition()) return true;
    }
    return false;
  }
  /// The epoch in which a room has a holder; 0: it has none.
  std::int32_t Held() {
    Directory directory(OpenKeyStore(directory_), "main");
    FleetListing listing;
    if (!directory.List(&listing).ok()) return -1;
    const FleetRoom* const room = listing.FindRoom("main");
    return room != nullptr && room->holder ? room->holder->epoch : 0;
  }

  /// The server that stands by for the room; "": none.
  std::string StandbyOf(const std::string& name = "main") {
    Directory directory(OpenKeyStore(directory_), "main");
    FleetListing listing;
    (void)directory.List(&listing);
    const FleetRoom* const room = listing.FindRoom(name);
    return room != nullptr && room->standby ? room->standby->server : "";
  }

  Workspace folder_;
  std::string rooms_ = "rooms";
  std::string directory_ = "file:" + (folder_ / "directory");
};

}  // namespace fleet_test
}  // namespace seam
