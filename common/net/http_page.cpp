#include "common/net/http_page.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <vector>

#include "common/base/check.h"

namespace seam {
namespace {

/// Returns a whole answer: status line, headers and body.
std::string Answer(const char* status, const std::string& body) {
  return std::string("HTTP/1.1 ") + status +
         "\r\nContent-Type: text/plain; version=0.0.4; charset=utf-8\r\nConnection: close\r\n" +
         "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
}

/// A client's connection: first its request is read, then our answer is sent.
struct Connection {
  int fd = -1;
  std::int64_t since_us = 0;
  std::string request, answer;
  std::size_t sent = 0;
};

/// Reads the available bytes. False when the connection is closed, broken or over the limit.
bool Read(Connection* connection) {
  char bytes[1024];
  for (;;) {
    const ssize_t got = recv(connection->fd, bytes, sizeof bytes, MSG_DONTWAIT);
    if (got < 0) return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR;
    if (got == 0) return false;
    connection->request.append(bytes, static_cast<std::size_t>(got));
    if (connection->request.size() > HttpPage::kRequestBytesMax) return false;
  }
}

/// Sends as much of the answer as the socket takes. False when all is sent or sending fails.
bool Write(Connection* connection) {
  while (connection->sent < connection->answer.size()) {
    const char* data = connection->answer.data() + connection->sent;
    const std::size_t left = connection->answer.size() - connection->sent;
    const ssize_t sent = send(connection->fd, data, left, MSG_DONTWAIT | MSG_NOSIGNAL);
    if (sent < 0) return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR;
    connection->sent += static_cast<std::size_t>(sent);
  }
  return false;
}

std::string Respond(const std::string& request, const HttpPage::Render& render) {
  const std::string line = request.substr(0, request.find("\r\n"));
  const std::size_t first = line.find(' ');
  const std::size_t second = first == std::string::npos ? first : line.find(' ', first + 1);
  if (second == std::string::npos || line.compare(second + 1, 5, "HTTP/") != 0) {
    return Answer("400 Bad Request", "this is no HTTP request\n");
  }
  const std::string target = line.substr(first + 1, second - first - 1);
  if (line.substr(0, first) != "GET") {
    return Answer("405 Method Not Allowed", "only GET is answered here\n");
  }
  if (target != "/" && target != "/metrics") {
    return Answer("404 Not Found", "the page is /metrics\n");
  }
  return Answer("200 OK", render());
}

}  // namespace

struct HttpPage::Impl {
  int fd = -1;
  std::vector<Connection> connections;

  ~Impl() {
    for (const Connection& connection : connections) close(connection.fd);
    if (fd >= 0) close(fd);
  }

  /// Returns true if a connection is pending. A tenth of the cost of an accept without one: accept
  /// makes a socket first.
  bool ConnectionPending() const {
    pollfd waiting{fd, POLLIN, 0};
    return poll(&waiting, 1, 0) > 0;
  }

  void Accept(std::int64_t now_us) {
    while (connections.size() < kConnectionsMax && ConnectionPending()) {
      const int got = accept4(fd, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
      if (got < 0) return;
      Connection connection;
      connection.fd = got;
      connection.since_us = now_us;
      connections.push_back(std::move(connection));
    }
  }

  /// Reads, answers and writes as far as possible. False when the connection is to be closed.
  static bool Serve(std::int64_t now_us, Connection* connection, const Render& render) {
    if (now_us - connection->since_us > kConnectionUs) return false;
    if (connection->answer.empty()) {
      if (!Read(connection)) return false;
      if (connection->request.find("\r\n\r\n") == std::string::npos) return true;
      connection->answer = Respond(connection->request, render);
    }
    return Write(connection);
  }
};

HttpPage::HttpPage(std::uint16_t port) : impl_(std::make_unique<Impl>()) {
  impl_->fd = socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (impl_->fd < 0) {
    throw OperatorError(std::string("cannot open a TCP socket: ") + std::strerror(errno));
  }
  const int yes = 1;
  (void)setsockopt(impl_->fd, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const bool bound =
      bind(impl_->fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  if (!bound || listen(impl_->fd, static_cast<int>(kConnectionsMax)) != 0) {
    const std::string where = "port " + std::to_string(port);
    throw OperatorError(errno == EADDRINUSE
                            ? where + " is in use: stop the program that has it or choose another"
                            : "cannot serve a page at " + where + ": " + std::strerror(errno));
  }
}

HttpPage::~HttpPage() = default;

void HttpPage::Poll(std::int64_t now_us, const Render& render) {
  impl_->Accept(now_us);
  auto& all = impl_->connections;
  const auto over = std::remove_if(all.begin(), all.end(), [&](Connection& connection) {
    if (Impl::Serve(now_us, &connection, render)) return false;
    // Half-closes first, so that a client that is still sending gets the answer.
    (void)shutdown(connection.fd, SHUT_WR);
    close(connection.fd);
    return true;
  });
  all.erase(over, all.end());
}

std::uint16_t HttpPage::port() const {
  sockaddr_in address{};
  socklen_t bytes = sizeof address;
  (void)getsockname(impl_->fd, reinterpret_cast<sockaddr*>(&address), &bytes);
  return ntohs(address.sin_port);
}

}  // namespace seam
