#pragma once
/// One page of text over HTTP, for a scraper on this machine: bound to loopback, GET alone, one
/// request a connection, and no call that waits. Besides udp the only door to sockets.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "common/base/status.h"

namespace seam {

class HttpPage {
 public:
  /// Listens at 127.0.0.1 (port 0: any). Throws OperatorError ("port 9464 is in use: ...").
  explicit HttpPage(std::uint16_t port);
  ~HttpPage();
  HttpPage(const HttpPage&) = delete;
  HttpPage& operator=(const HttpPage&) = delete;

  using Render = std::function<std::string()>;
  /// Takes what has come and sends what can be sent, at `now_us` (any clock that never runs
  /// backwards). `render` is called for each GET of / or /metrics. Who has not finished after
  /// kConnectionUs, or asks for more than kRequestBytesMax, is cut off; beyond kConnectionsMax
  /// nobody is let in. Call it often: nothing is answered in between.
  void Poll(std::int64_t now_us, const Render& render);

  std::uint16_t port() const;

  static constexpr std::int64_t kConnectionUs = 2000000;
  static constexpr std::size_t kRequestBytesMax = 4096;
  static constexpr std::size_t kConnectionsMax = 16;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Fetches such a page: "127.0.0.1:9464". Waits at most `timeout_us`. An error, one line, when
/// nobody answers, or not with status 200.
Status FetchPage(const std::string& address, std::int64_t timeout_us, std::string* body);

}  // namespace seam
