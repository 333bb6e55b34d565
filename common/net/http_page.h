#pragma once
/// Serves one page of text over HTTP to a scraper on this machine: loopback only, GET only, one
/// request per connection; no call blocks. Besides udp the only user of sockets.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "common/base/status.h"

namespace seam {

class HttpPage {
 public:
  /// Listens on 127.0.0.1 (port 0: any). Throws OperatorError ("port 9464 is in use: ...").
  explicit HttpPage(std::uint16_t port);
  ~HttpPage();
  HttpPage(const HttpPage&) = delete;
  HttpPage& operator=(const HttpPage&) = delete;

  using Render = std::function<std::string()>;
  /// Accepts connections, reads requests and sends answers without waiting, at `now_us` (any clock
  /// that never runs backwards). Calls `render` for each GET of / or /metrics. Closes a connection
  /// after kConnectionUs or a request above kRequestBytesMax; accepts at most kConnectionsMax at
  /// once. Call it often: requests are answered only here.
  void Poll(std::int64_t now_us, const Render& render);

  std::uint16_t port() const;

  static constexpr std::int64_t kConnectionUs = 2000000;
  static constexpr std::size_t kRequestBytesMax = 4096;
  static constexpr std::size_t kConnectionsMax = 16;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Fetches such a page from `address`, "127.0.0.1:9464". Blocks for at most `timeout_us`. Returns
/// an error unless an answer with status 200 arrives.
Status FetchPage(const std::string& address, std::int64_t timeout_us, std::string* body);

}  // namespace seam
