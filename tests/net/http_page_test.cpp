/// The page that Prometheus scrapes: answers valid requests and waits for nobody.

#include "common/net/http_page.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <string>
#include <thread>

#include "common/base/check.h"
#include "common/base/process.h"

namespace seam {
namespace http_page_test {

/// A page that is served by a thread while the object lives.
class Served {
 public:
  explicit Served(const std::string& text) : page_(0), text_(text) {
    thread_ = std::thread([this] {
      while (!stop_) {
        page_.Poll(SteadyClockUs(), [this] { return text_; });
        usleep(500);
      }
    });
  }
  ~Served() {
    stop_ = true;
    thread_.join();
  }
  std::uint16_t port() const { return page_.port(); }
  std::string address() const { return "127.0.0.1:" + std::to_string(port()); }

 private:
  HttpPage page_;
  std::string text_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

/// A connection by hand.
class Peer {
 public:
  explicit Peer(std::uint16_t port) : fd_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(connect(fd_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    const timeval patience{5, 0};
    setsockopt(fd_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  }
  ~Peer() { close(fd_); }
  void Say(const std::string& text) { (void)send(fd_, text.data(), text.size(), MSG_NOSIGNAL); }
  std::string Hear() {
    std::string text;
    char bytes[1024];
    for (ssize_t n = 0; (n = recv(fd_, bytes, sizeof bytes, 0)) > 0;) {
      text.append(bytes, static_cast<std::size_t>(n));
    }
    return text;
  }

 private:
  int fd_;
};

TEST(HttpPage, AGetReturnsAPageOfAnyLength) {
  const std::string long_page(3000000, 'x');
  for (const std::string& text : {std::string("seam_tick 7\n"), std::string(), long_page}) {
    Served served(text);
    std::string body = "before";
    const Status status = FetchPage(served.address(), 5000000, &body);
    EXPECT_TRUE(status.ok()) << status.why();
    EXPECT_EQ(body, text);
  }
}

TEST(HttpPage, OtherMethodsOtherPagesAndNonsenseAreRefused) {
  Served served("secret");
  const std::pair<const char*, const char*> cases[] = {
      {"POST /metrics HTTP/1.1\r\n\r\n", "HTTP/1.1 405 "},
      {"HEAD /metrics HTTP/1.1\r\n\r\n", "HTTP/1.1 405 "},
      {"GET /etc/passwd HTTP/1.1\r\n\r\n", "HTTP/1.1 404 "},
      {"GET /metrics\r\n\r\n", "HTTP/1.1 400 "},
      {"\r\n\r\n", "HTTP/1.1 400 "},
      {"GET / HTTP/1.0\r\nX: y\r\n\r\n", "HTTP/1.1 200 "}};
  for (const auto& [request, answer] : cases) {
    Peer peer(served.port());
    peer.Say(request);
    const std::string heard = peer.Hear();
    EXPECT_EQ(heard.substr(0, 13), answer) << request;
    EXPECT_EQ(heard.find("secret") != std::string::npos, answer[9] == '2') << request;
  }
}

TEST(HttpPage, CutsOffEndlessRequestsAndAnswersTheOthers) {
  Served served("page");
  Peer endless(served.port());
  endless.Say("GET /" + std::string(2 * HttpServer::kRequestBytesMax, 'a'));
  EXPECT_EQ(endless.Hear(), "");
  // As many silent connections as allowed; the next one is answered when their time is over.
  std::vector<std::unique_ptr<Peer>> silent;
  for (std::size_t i = 0; i < HttpServer::kConnectionsMax; ++i) {
    silent.push_back(std::make_unique<Peer>(served.port()));
  }
  std::string body;
  const Status status = FetchPage(served.address(), 3 * HttpServer::kConnectionUs, &body);
  EXPECT_TRUE(status.ok()) << status.why();
  EXPECT_EQ(body, "page");
}

TEST(HttpPage, AnUnreachableAndATakenPortAreOneLineEach) {
  std::string body;
  EXPECT_EQ(FetchPage("127.0.0.1:1", 1000000, &body).why(), "no page at 127.0.0.1:1");
  Served served("");
  try {
    HttpPage second(served.port());
    FAIL() << "two pages at one port";
  } catch (const OperatorError& e) {
    EXPECT_EQ(std::string(e.what()), "port " + std::to_string(served.port()) +
                                         " is in use: stop the program that has it or choose "
                                         "another");
  }
}

}  // namespace http_page_test
}  // namespace seam
