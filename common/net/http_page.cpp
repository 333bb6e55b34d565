#include "common/net/http_page.h"

#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "common/net/udp.h"

namespace seam {
namespace {

/// Longest page, bytes: 1000 rooms take half of this.
constexpr std::size_t kPageBytesMax = 16 << 20;

std::int64_t MonotonicUs() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return static_cast<std::int64_t>(t.tv_sec) * 1000000 + t.tv_nsec / 1000;
}

/// A socket that closes itself.
struct Socket {
  int fd = -1;
  ~Socket() {
    if (fd >= 0) close(fd);
  }
};

/// Waits until `fd` is ready for `events`; false after the deadline.
bool WaitFor(int fd, short events, std::int64_t deadline_us) {
  const std::int64_t left_us = deadline_us - MonotonicUs();
  if (left_us <= 0) return false;
  pollfd watched{fd, events, 0};
  return poll(&watched, 1, static_cast<int>(left_us / 1000) + 1) > 0;
}

bool Connect(int fd, const Address& to, std::int64_t deadline_us) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(to.port);
  address.sin_addr.s_addr = htonl(to.ip);
  if (connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return true;
  if (errno != EINPROGRESS || !WaitFor(fd, POLLOUT, deadline_us)) return false;
  int error = 0;
  socklen_t bytes = sizeof error;
  return getsockopt(fd, SOL_SOCKET, SO_ERROR, &error, &bytes) == 0 && error == 0;
}

/// Reads everything until the other end closes.
bool ReadAll(int fd, std::int64_t deadline_us, std::string* text) {
  char bytes[16384];
  while (WaitFor(fd, POLLIN, deadline_us)) {
    const ssize_t got = recv(fd, bytes, sizeof bytes, 0);
    if (got == 0) return true;
    if (got < 0 || text->size() > kPageBytesMax) return false;
    text->append(bytes, static_cast<std::size_t>(got));
  }
  return false;
}

}  // namespace

HttpPage::HttpPage(std::uint16_t port, const std::string& bind) : server_(port, bind) {}

void HttpPage::Poll(std::int64_t now_us, const Render& render) {
  server_.Poll(now_us, [&render](const HttpRequest& request) {
    HttpResponse response;
    response.type = "text/plain; version=0.0.4; charset=utf-8";
    if (request.method != "GET") {
      response.status = "405 Method Not Allowed";
      response.body = "only GET is answered here\n";
    } else if (request.path != "/" && request.path != "/metrics") {
      response.status = "404 Not Found";
      response.body = "the page is /metrics\n";
    } else {
      response.body = render();
    }
    return response;
  });
}

Status AskPage(const std::string& address, const std::string& method, const std::string& target,
               const std::string& body, std::int64_t timeout_us, HttpAnswer* answer) {
  const std::int64_t deadline_us = MonotonicUs() + timeout_us;
  Socket socket_of{socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)};
  const Address to = ParseAddress(address, 9464);
  if (socket_of.fd < 0 || !to.ipv4() || !Connect(socket_of.fd, to, deadline_us)) {
    return Status::Error("no page at " + address);
  }
  const std::string length = "Content-Length: " + std::to_string(body.size()) + "\r\n";
  const std::string request = method + " " + target + " HTTP/1.1\r\nHost: " + address + "\r\n" +
                              (body.empty() ? "" : length) + "\r\n" + body;
  const ssize_t sent = send(socket_of.fd, request.data(), request.size(), MSG_NOSIGNAL);
  std::string text;
  if (sent != static_cast<ssize_t>(request.size()) || !ReadAll(socket_of.fd, deadline_us, &text)) {
    return Status::Error("no answer from " + address);
  }
  const std::size_t begin = text.find("\r\n\r\n");
  if (text.rfind("HTTP/1.1 ", 0) != 0 || begin == std::string::npos) {
    return Status::Error(address + " has no such page");
  }
  answer->status = std::atoi(text.c_str() + 9);
  answer->body = text.substr(begin + 4);
  return Status::Ok();
}

Status FetchPage(const std::string& address, std::int64_t timeout_us, std::string* body) {
  HttpAnswer answer;
  const Status asked = AskPage(address, "GET", "/metrics", "", timeout_us, &answer);
  if (!asked.ok()) return asked;
  if (answer.status != 200) return Status::Error(address + " has no such page");
  *body = std::move(answer.body);
  return Status::Ok();
}

}  // namespace seam
