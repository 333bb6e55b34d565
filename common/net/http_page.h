#pragma once
/// Serves one page of text over HTTP to a scraper, GET only.

#include <cstdint>
#include <functional>
#include <string>

#include "common/base/status.h"
#include "common/net/http_server.h"

namespace seam {

class HttpPage {
 public:
  /// Listens as HttpServer does: on loopback, or at the address `bind`. Throws OperatorError.
  explicit HttpPage(std::uint16_t port, const std::string& bind = "");

  using Render = std::function<std::string()>;
  /// Answers without waiting, at `now_us`, as HttpServer::Poll does. Calls `render` for each GET of
  /// / or /metrics. Call it often: requests are answered only here.
  void Poll(std::int64_t now_us, const Render& render);

  std::uint16_t port() const { return server_.port(); }

 private:
  HttpServer server_;
};

/// The answer to a request.
struct HttpAnswer {
  int status = 0;  ///< 200
  std::string body;
};

/// Sends a request to a page on this machine, "GET" or "POST", for a target such as "/metrics".
/// Blocks for at most `timeout_us`. Returns an error unless an answer arrives, of whatever status.
Status AskPage(const std::string& address, const std::string& method, const std::string& target,
               const std::string& body, std::int64_t timeout_us, HttpAnswer* answer);

/// Fetches such a page from `address`, "127.0.0.1:9464". Blocks for at most `timeout_us`. Returns
/// an error unless an answer with status 200 arrives.
Status FetchPage(const std::string& address, std::int64_t timeout_us, std::string* body);

}  // namespace seam
