#pragma once
/// A server in a pod of Agones: tells the sidecar that it is ready, that its rooms run, and that it
/// ends, by Agones's REST API for game servers. A thread of its own does so, and no tick waits.

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "common/fleet/http_post.h"
#include "server/hub/hub.h"

namespace seam {

class Agones {
 public:
  /// Says /ready, again until the sidecar hears it. The sidecar is on loopback, on the port that
  /// the environment's AGONES_SDK_HTTP_PORT has (9358 without one). Throws OperatorError if that is
  /// no port.
  Agones();
  /// Says /shutdown: Agones takes the pod away.
  ~Agones();
  Agones(const Agones&) = delete;
  Agones& operator=(const Agones&) = delete;

  /// Call whenever the main loop comes round. Lets the thread say /health if every room has run
  /// lately; without it Agones ends the pod after a while. Adds lines for the operator: the sidecar
  /// is gone, or back.
  void Poll(std::int64_t now_us, const Hub& hub, std::vector<std::string>* lines);

 private:
  void Run();
  void Say(const char* what);

  const std::string address_;
  HttpPost post_;
  bool answers_ = true;
  std::mutex mutex_;  // guards all below
  std::condition_variable wake_;
  bool healthy_ = false;  // since the last /health
  bool stop_ = false;
  std::vector<std::string> news_;
  std::thread thread_;
};

}  // namespace seam
