#pragma once
/// An etcd on loopback, of a test alone, and a directory's stores for tests.

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <memory>
#include <string>
#include <vector>

#include "common/base/process.h"
#include "common/fleet/key_store.h"
#include "tests/support/program.h"

namespace seam {

/// Returns a TCP port of loopback that is free now.
inline int FreePort() {
  const int fd = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in name{};
  name.sin_family = AF_INET;
  name.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof name;
  bind(fd, reinterpret_cast<sockaddr*>(&name), sizeof name);
  getsockname(fd, reinterpret_cast<sockaddr*>(&name), &size);
  close(fd);
  return ntohs(name.sin_port);
}

class EtcdHere {
 public:
  static bool Installed() { return access("/usr/bin/etcd", X_OK) == 0; }

  EtcdHere() : port_(FreePort()), peer_port_(FreePort()) { Start(); }
  /// Ends it, or lets it begin again with what it has.
  void Stop() { etcd_.reset(); }
  void Start() {
    const std::string url = "http://127.0.0.1:" + std::to_string(port_);
    const std::string peer = "http://127.0.0.1:" + std::to_string(peer_port_);
    etcd_ = std::make_unique<Program>(std::vector<std::string>{
        "/usr/bin/etcd", "--data-dir", folder_ / "data", "--listen-client-urls", url,
        "--advertise-client-urls", url, "--listen-peer-urls", peer, "--initial-advertise-peer-urls",
        peer, "--initial-cluster", "default=" + peer, "--logger", "zap", "--log-level", "error"});
  }
  /// Waits until it answers.
  bool WaitUntilUp() const {
    const std::unique_ptr<KeyStore> store = OpenKeyStore(Text());
    for (int i = 0; i < 300; ++i, usleep(100000)) {
      std::vector<KeyValue> found;
      if (store->List("/", &found).ok()) return true;
    }
    return false;
  }
  std::string Text() const { return "etcd:127.0.0.1:" + std::to_string(port_); }
  std::string Story() const { return etcd_ == nullptr ? "stopped" : etcd_->Story(); }

 private:
  Workspace folder_;
  const int port_, peer_port_;
  std::unique_ptr<Program> etcd_;
};

}  // namespace seam
