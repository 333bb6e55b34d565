#pragma once
/// A small HTTP server, for programs on this machine unless told otherwise: one request per
/// connection, answers and endless streams of events; no call blocks.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace seam {

struct HttpRequest {
  std::string method;  ///< "GET"
  std::string path;    ///< "/live"
  std::string query;   ///< "token=1": the part behind the question mark
  std::string host;    ///< header Host; "" if absent
  std::string origin;  ///< header Origin; "" if absent
  std::string body;
};

struct HttpResponse {
  const char* status = "200 OK";
  const char* type = "text/plain; charset=utf-8";
  std::string body;
  bool stream = false;  ///< after the headers, pieces follow without end; `body` is not sent

  /// Returns a refusal with one line of text.
  static HttpResponse Refusal(const char* status, const std::string& why) {
    HttpResponse refusal;
    refusal.status = status;
    refusal.body = why + "\n";
    return refusal;
  }
};

class HttpServer {
 public:
  /// Listens on 127.0.0.1 and, where there is one, on ::1 (port 0: any), or on the one numeric
  /// address `bind`, of which "::" stands for all. Throws OperatorError ("port 8080 is in use:
  /// ...").
  explicit HttpServer(std::uint16_t port, const std::string& bind = "");
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  using Handle = std::function<HttpResponse(const HttpRequest&)>;
  using Piece = std::shared_ptr<const std::string>;
  /// Returns the next piece of a stream and moves `place` behind it; nullptr: none yet. The place
  /// of a stream is 0 at first. Called only when the piece before it was sent, so a slow reader
  /// holds up nobody and costs no memory.
  using Next = std::function<Piece(std::uint64_t* place)>;

  /// Accepts connections, reads requests and sends answers without waiting, at `now_us` (any clock
  /// that never runs backwards). Closes a connection after kConnectionUs, a stream after kStreamUs
  /// without progress, and a request above kRequestBytesMax. Refuses streams above kStreamsMax.
  void Poll(std::int64_t now_us, const Handle& handle, const Next& next = {});
  /// Waits for a request, for `other_fd` (-1: none) to be readable, or for the time.
  void Wait(std::int64_t timeout_us, int other_fd = -1) const;

  std::uint16_t port() const;

  static constexpr std::int64_t kConnectionUs = 2000000;
  static constexpr std::int64_t kStreamUs = 60000000;
  static constexpr std::size_t kRequestBytesMax = 4096;
  static constexpr std::size_t kConnectionsMax = 16;  ///< besides streams
  static constexpr std::size_t kStreamsMax = 32;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// True if a Host header names this machine's loopback: "127.0.0.1:8080", "localhost", "[::1]:80".
/// A page of another site whose name was made to point here (DNS rebinding) sends its own name.
bool IsLoopbackHost(const std::string& host);

}  // namespace seam
