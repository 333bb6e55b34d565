#include "common/net/http_server.h"

#include <netdb.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "common/base/check.h"

namespace seam {
namespace {

constexpr const char* kHeadEnd = "\r\n\r\n";

/// Returns the status line and the headers.
std::string HeadOf(const HttpResponse& response) {
  std::string head = std::string("HTTP/1.1 ") + response.status +
                     "\r\nContent-Type: " + response.type +
                     "\r\nCache-Control: no-store\r\nX-Content-Type-Options: nosniff"
                     "\r\nX-Frame-Options: DENY\r\nReferrer-Policy: no-referrer"
                     "\r\nConnection: close\r\n";
  if (!response.stream) {
    head += "Content-Length: " + std::to_string(response.body.size()) + "\r\n";
  }
  return head + "\r\n";
}

/// A client's connection: first its request is read, then our answer is sent.
struct Connection {
  int fd = -1;
  std::int64_t since_us = 0;  // accepted; of a stream: its last progress
  bool streams = false;
  std::uint64_t place = 0;  // of the stream
  std::string request;
  HttpServer::Piece answer;  // nullptr: none yet
  std::size_t sent = 0;
};

/// Returns a header's value; "" if it is absent. `head`: the lines of a request.
std::string HeaderOf(const std::string& head, const std::string& name) {
  std::string lower = head;
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const std::size_t at = lower.find("\r\n" + name + ":");
  if (at == std::string::npos) return "";
  const std::size_t begin = head.find_first_not_of(" \t", at + name.size() + 3);
  const std::size_t end = head.find("\r\n", at + 2);
  if (begin == std::string::npos || begin >= end) return "";
  return head.substr(begin, end - begin);
}

/// Returns true once the request is whole, with its body.
bool IsWhole(const std::string& request) {
  const std::size_t end = request.find(kHeadEnd);
  if (end == std::string::npos) return false;
  const std::string length = HeaderOf(request.substr(0, end + 2), "content-length");
  return request.size() - end - 4 >= std::strtoul(length.c_str(), nullptr, 10);
}

/// Reads the available bytes. False when the connection is closed, broken or over the limit.
bool ReadRequest(Connection* connection) {
  char bytes[1024];
  for (;;) {
    const ssize_t got = recv(connection->fd, bytes, sizeof bytes, MSG_DONTWAIT);
    if (got < 0) return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR;
    if (got == 0)
      return !connection->streams && IsWhole(connection->request);  // nothing more comes
    if (connection->streams) continue;  // nothing more is asked
    connection->request.append(bytes, static_cast<std::size_t>(got));
    if (connection->request.size() > HttpServer::kRequestBytesMax) return false;
  }
}

/// Sends as much of the answer as the socket takes; false when sending fails.
bool SendAnswer(Connection* connection, std::int64_t now_us) {
  while (connection->sent < connection->answer->size()) {
    const char* data = connection->answer->data() + connection->sent;
    const std::size_t left = connection->answer->size() - connection->sent;
    const ssize_t sent = send(connection->fd, data, left, MSG_DONTWAIT | MSG_NOSIGNAL);
    if (sent < 0) return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR;
    connection->sent += static_cast<std::size_t>(sent);
    if (connection->streams) connection->since_us = now_us;
  }
  return true;
}

/// Parses a whole request; false if it is none.
bool Parse(const std::string& text, HttpRequest* request) {
  const std::string line = text.substr(0, text.find("\r\n"));
  const std::size_t first = line.find(' ');
  const std::size_t second = first == std::string::npos ? first : line.find(' ', first + 1);
  if (second == std::string::npos || line.compare(second + 1, 5, "HTTP/") != 0) return false;
  const std::string target = line.substr(first + 1, second - first - 1);
  const std::size_t mark = std::min(target.find('?'), target.size());
  const std::size_t end = text.find(kHeadEnd);
  const std::string head = text.substr(0, end + 2);
  request->method = line.substr(0, first);
  request->path = target.substr(0, mark);
  request->query = mark < target.size() ? target.substr(mark + 1) : "";
  request->host = HeaderOf(head, "host");
  request->origin = HeaderOf(head, "origin");
  request->body = text.substr(end + 4);
  return true;
}

/// Opens a listening socket at a numeric address; -1 on failure, with errno. Of "::", for IPv4 too.
int Listen(const std::string& host, std::uint16_t port) {
  addrinfo hints{}, *found = nullptr;
  hints.ai_flags = AI_NUMERICHOST | AI_NUMERICSERV | AI_PASSIVE;
  hints.ai_socktype = SOCK_STREAM;
  if (getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found) != 0) {
    errno = EADDRNOTAVAIL;
    return -1;
  }
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> address(found, freeaddrinfo);
  const int fd = socket(found->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (fd < 0) return -1;
  const int yes = 1, no = 0;
  (void)setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  if (found->ai_family == AF_INET6) {
    (void)setsockopt(fd, IPPROTO_IPV6, IPV6_V6ONLY, host == "::" ? &no : &yes, sizeof yes);
  }
  if (bind(fd, found->ai_addr, found->ai_addrlen) == 0 &&
      listen(fd, static_cast<int>(HttpServer::kConnectionsMax)) == 0)
    return fd;
  const int error = errno;
  close(fd);
  errno = error;
  return -1;
}

}  // namespace

struct HttpServer::Impl {
  std::vector<int> doors;  // sockets that listen
  std::vector<Connection> connections;

  ~Impl() {
    for (const Connection& connection : connections) close(connection.fd);
    for (const int door : doors) close(door);
  }

  std::size_t Streams() const {
    return static_cast<std::size_t>(std::count_if(connections.begin(), connections.end(),
                                                  [](const Connection& c) { return c.streams; }));
  }

  /// Returns true if a connection is pending. A tenth of the cost of an accept without one: accept
  /// makes a socket first.
  static bool Pending(int door) {
    pollfd waiting{door, POLLIN, 0};
    return poll(&waiting, 1, 0) > 0;
  }

  /// True while there is room for another connection.
  bool HasRoom() const { return connections.size() - Streams() < kConnectionsMax; }

  void Accept(std::int64_t now_us) {
    for (const int door : doors) {
      while (HasRoom() && Pending(door)) {
        Connection connection;
        connection.fd = accept4(door, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
        if (connection.fd < 0) return;
        connection.since_us = now_us;
        connections.push_back(std::move(connection));
      }
    }
  }

  void Answer(const Handle& handle, Connection* connection) const {
    HttpRequest request;
    HttpResponse response;
    if (Parse(connection->request, &request)) {
      response = handle(request);
    } else {
      response.status = "400 Bad Request";
      response.body = "this is no HTTP request\n";
    }
    if (response.stream && Streams() >= kStreamsMax) {
      response = HttpResponse();
      response.status = "503 Service Unavailable";
      response.body = std::to_string(kStreamsMax) + " are watching already\n";
    }
    connection->streams = response.stream;
    connection->answer = std::make_shared<const std::string>(
        HeadOf(response) + (response.stream ? "" : response.body));
  }

  /// Reads, answers and writes as far as possible. False when the connection is to be closed.
  bool Serve(std::int64_t now_us, const Handle& handle, const Next& next, Connection* connection) {
    const std::int64_t patience = connection->streams ? kStreamUs : kConnectionUs;
    if (now_us - connection->since_us > patience) return false;
    if ((connection->answer == nullptr || connection->streams) && !ReadRequest(connection)) {
      return false;
    }
    if (connection->answer == nullptr) {
      if (!IsWhole(connection->request)) return true;
      Answer(handle, connection);
    }
    for (;;) {
      if (!SendAnswer(connection, now_us)) return false;
      if (connection->sent < connection->answer->size()) return true;
      if (!connection->streams) return false;
      Piece piece = next ? next(&connection->place) : nullptr;
      if (piece == nullptr) {
        connection->since_us = now_us;
        return true;
      }
      connection->answer = std::move(piece);
      connection->sent = 0;
    }
  }
};

HttpServer::HttpServer(std::uint16_t port, const std::string& bind)
    : impl_(std::make_unique<Impl>()) {
  const int door = Listen(bind.empty() ? "127.0.0.1" : bind, port);
  if (door < 0) {
    const std::string where = (bind.empty() ? "" : bind + " ") + "port " + std::to_string(port);
    throw OperatorError(errno == EADDRINUSE
                            ? where + " is in use: stop the program that has it or choose another"
                            : "cannot serve a page at " + where + ": " + std::strerror(errno));
  }
  impl_->doors.push_back(door);
  if (!bind.empty()) return;
  const int six = Listen("::1", this->port());
  if (six >= 0) impl_->doors.push_back(six);
}

HttpServer::~HttpServer() = default;

void HttpServer::Poll(std::int64_t now_us, const Handle& handle, const Next& next) {
  impl_->Accept(now_us);
  auto& all = impl_->connections;
  for (std::size_t i = 0; i < all.size();) {
    if (impl_->Serve(now_us, handle, next, &all[i])) {
      ++i;
      continue;
    }
    // Half-closes first, so that a client that is still sending gets the answer.
    (void)shutdown(all[i].fd, SHUT_WR);
    close(all[i].fd);
    all.erase(all.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

void HttpServer::Wait(std::int64_t timeout_us, int other_fd) const {
  std::vector<pollfd> waiting;
  // Who waits at a door that lets nobody in does not wake us.
  for (const int door : impl_->doors) {
    if (impl_->HasRoom()) waiting.push_back({door, POLLIN, 0});
  }
  if (other_fd >= 0) waiting.push_back({other_fd, POLLIN, 0});
  for (const Connection& connection : impl_->connections) {
    const bool sends = connection.answer != nullptr && connection.sent < connection.answer->size();
    waiting.push_back({connection.fd, static_cast<short>(sends ? POLLIN | POLLOUT : POLLIN), 0});
  }
  (void)poll(waiting.data(), waiting.size(), static_cast<int>((timeout_us + 999) / 1000));
}

std::uint16_t HttpServer::port() const {
  sockaddr_storage address{};
  socklen_t bytes = sizeof address;
  (void)getsockname(impl_->doors[0], reinterpret_cast<sockaddr*>(&address), &bytes);
  // The port has the same place in addresses of both families.
  static_assert(offsetof(sockaddr_in, sin_port) == offsetof(sockaddr_in6, sin6_port));
  return ntohs(reinterpret_cast<const sockaddr_in&>(address).sin_port);
}

bool IsLoopbackHost(const std::string& host) {
  const std::size_t colon = host.rfind(':');
  const bool port = colon != std::string::npos && colon + 1 < host.size() &&
                    host.find_first_not_of("0123456789", colon + 1) == std::string::npos;
  const std::string name = port ? host.substr(0, colon) : host;
  return name == "127.0.0.1" || name == "localhost" || name == "[::1]";
}

}  // namespace seam
