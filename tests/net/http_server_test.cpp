/// A server of pages and streams: whoever reads slowly or goes away holds up nobody.

#include "common/net/http_server.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

namespace seam {
namespace http_server_test {

/// A client's end of a connection that does not block.
class Line {
 public:
  explicit Line(std::uint16_t port) : fd_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(connect(fd_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  }
  ~Line() { Close(); }
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;
  void Say(const std::string& text) {
    EXPECT_GE(send(fd_, text.data(), text.size(), MSG_NOSIGNAL), 0);
  }
  /// Returns all that has come so far.
  const std::string& Hear() {
    char bytes[65536];
    for (ssize_t n = 0; (n = recv(fd_, bytes, sizeof bytes, MSG_DONTWAIT)) > 0;)
      heard_.append(bytes, static_cast<std::size_t>(n));
    return heard_;
  }
  void HalfClose() { EXPECT_EQ(shutdown(fd_, SHUT_WR), 0); }
  void Close() {
    if (fd_ >= 0) close(fd_);
    fd_ = -1;
  }

 private:
  int fd_;
  std::string heard_;
};

/// Answers "path query body", and streams numbered pieces of 10 kB.
class HttpServers : public ::testing::Test {
 protected:
  void Poll(int times) {
    for (int i = 0; i < times; ++i) {
      usleep(200);
      now_us_ += 1000;
      server_.Poll(
          now_us_,
          [](const HttpRequest& request) {
            HttpResponse response;
            response.stream = request.path == "/live";
            response.body = request.method + "|" + request.path + "|" + request.query + "|" +
                            request.host + "|" + request.origin + "|" + request.body;
            return response;
          },
          [this](std::uint64_t* place) -> HttpServer::Piece {
            if (*place >= pieces_) return nullptr;
            ++*place;
            ++taken_;
            return std::make_shared<const std::string>(std::string(10000, '0') +
                                                       std::to_string(*place) + "\n");
          });
    }
  }
  /// Polls until a line has heard this; its kernel may be slow, but no connection is cut off.
  bool Hears(Line* line, const std::string& text) {
    for (int i = 0; i < 1000 && line->Hear().find(text) == std::string::npos; ++i) Poll(1);
    return line->Hear().find(text) != std::string::npos;
  }
  HttpServer server_{0};
  std::int64_t now_us_ = 0;
  std::uint64_t pieces_ = 0, taken_ = 0;
};

TEST_F(HttpServers, GiveTheHandlerTheWholeRequest) {
  Line line(server_.port());
  line.Say("POST /drive?token=7 HTTP/1.1\r\nHost: localhost:1\r\nOrigin: http://a\r\n");
  Poll(3);
  line.Say("content-length: 5\r\n\r\nab");
  Poll(3);
  EXPECT_EQ(line.Hear(), "") << "its body is not whole";
  line.Say("cde");
  EXPECT_TRUE(Hears(&line, "\r\n\r\nPOST|/drive|token=7|localhost:1|http://a|abcde"))
      << line.Hear();
  EXPECT_EQ(line.Hear().rfind("HTTP/1.1 200 OK\r\n", 0), 0u);
}

TEST_F(HttpServers, AStreamGoesOnAndASlowReaderHoldsUpNobody) {
  Line slow(server_.port()), quick(server_.port()), gone(server_.port());
  for (Line* line : {&slow, &quick, &gone}) line->Say("GET /live HTTP/1.1\r\n\r\n");
  for (Line* line : {&slow, &quick}) EXPECT_TRUE(Hears(line, "200 OK"));
  Poll(5);
  gone.Close();
  pieces_ = 3000;  // 30 MB, far more than what sockets hold
  for (int i = 0; i < 3000 && quick.Hear().find("03000\n") == std::string::npos; ++i) Poll(1);
  EXPECT_NE(quick.Hear().find("03000\n"), std::string::npos);
  EXPECT_LT(taken_, 5000u) << "pieces are made for whoever can take them";
  Line page(server_.port());
  page.Say("GET / HTTP/1.1\r\n\r\n");
  EXPECT_TRUE(Hears(&page, "GET|/||"));
  const std::uint64_t before = taken_;
  now_us_ += HttpServer::kStreamUs;  // who takes nothing for so long is cut off
  Poll(3);
  pieces_ += 100;
  Poll(50);
  EXPECT_LE(taken_ - before, 100u) << "only the quick one is left";
}

TEST_F(HttpServers, SilentConnectionsDoNotKeepItAwake) {
  std::vector<std::unique_ptr<Line>> lines;
  for (std::size_t i = 0; i < HttpServer::kConnectionsMax + 2; ++i) {
    lines.push_back(std::make_unique<Line>(server_.port()));
    Poll(1);
  }
  const auto begin = std::chrono::steady_clock::now();
  server_.Wait(50000);
  const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - begin;
  EXPECT_GT(waited.count(), 0.04) << "two wait at the door, and are not let in";
  lines.front()->Close();
  Poll(2);
  lines.back()->Say("GET /x HTTP/1.1\r\nHost: h\r\n\r\n");
  lines[1]->Close();
  EXPECT_TRUE(Hears(lines.back().get(), "GET|/x|"));
}

TEST_F(HttpServers, AHalfClosedRequestIsAnswered) {
  Line line(server_.port());
  line.Say("GET /x HTTP/1.1\r\nHost: h\r\n\r\n");
  line.HalfClose();
  EXPECT_TRUE(Hears(&line, "GET|/x|"));
}

TEST_F(HttpServers, TooManyStreamsAreRefusedAndPagesAreStillAnswered) {
  std::vector<std::unique_ptr<Line>> lines;
  for (std::size_t i = 0; i <= HttpServer::kStreamsMax; ++i) {
    lines.push_back(std::make_unique<Line>(server_.port()));
    lines.back()->Say("GET /live HTTP/1.1\r\n\r\n");
    EXPECT_TRUE(Hears(lines.back().get(), "HTTP/1.1 ")) << i;
  }
  EXPECT_EQ(lines.back()->Hear().rfind("HTTP/1.1 503 ", 0), 0u) << lines.back()->Hear();
  Line page(server_.port());
  page.Say("GET / HTTP/1.1\r\n\r\n");
  EXPECT_TRUE(Hears(&page, "200 OK"));
}

TEST(LoopbackHost, OnlyNamesOfThisMachineAreOurs) {
  for (const char* host : {"127.0.0.1", "127.0.0.1:8080", "localhost:1", "[::1]:8080", "[::1]"})
    EXPECT_TRUE(IsLoopbackHost(host)) << host;
  for (const char* host : {"", "evil.example", "evil.example:8080", "127.0.0.1.evil.example",
                           "localhost.evil", "127.0.0.1:", "127.0.0.1:80x", "::1"})
    EXPECT_FALSE(IsLoopbackHost(host)) << host;
}

}  // namespace http_server_test
}  // namespace seam
