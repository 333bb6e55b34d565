/// seam-server --agones, with a sidecar made here.

#include <gtest/gtest.h>
#include <signal.h>

#include <memory>
#include <string>
#include <vector>

#include "common/base/process.h"
#include "common/net/http_server.h"
#include "tests/support/in_namespace.h"
#include "tests/support/program.h"
#include "tests/support/source_tree.h"

namespace seam {
namespace agones_test {

constexpr double kPatience = 30;

/// The paths that were posted to the sidecar of a pod.
struct Sidecar {
  explicit Sidecar(std::uint16_t port = 0) : http(port) {}
  /// Answers for so long, or until `count` requests have come.
  void Answer(double seconds, std::size_t count) {
    const std::int64_t end_us = SteadyClockUs() + static_cast<std::int64_t>(seconds * 1e6);
    while (SteadyClockUs() < end_us && paths.size() < count) {
      http.Poll(SteadyClockUs(), [&](const HttpRequest& request) {
        paths.push_back(request.method + " " + request.path);
        HttpResponse answer;
        answer.body = "{}";
        return answer;
      });
      http.Wait(10000);
    }
  }
  HttpServer http;
  std::vector<std::string> paths;
};

std::vector<std::string> Server(std::uint16_t port, const std::string& more = "0") {
  return {"env",
          "AGONES_SDK_HTTP_PORT=" + (port > 0 ? std::to_string(port) : more),
          BuiltProgram("seam-server"),
          (Root() / "scenes/crossing.toml").string(),
          "--wait",
          "0",
          "--duration",
          "0",
          "--bind",
          "127.0.0.1",
          "--port",
          "7851",
          "--lcm-url",
          "none",
          "--quiet",
          "--agones"};
}

class AgonesPod : public InNamespace {};

TEST_F(AgonesPod, IsToldReadyThenHealthyThenOver) {
  SEAM_INSIDE_ONLY();
  auto sidecar = std::make_unique<Sidecar>();
  const std::uint16_t port = sidecar->http.port();
  Program server(Server(port));
  sidecar->Answer(kPatience, 3);
  ASSERT_EQ(sidecar->paths.size(), 3u) << server.Story();
  EXPECT_EQ(sidecar->paths[0], "POST /ready");
  EXPECT_EQ(sidecar->paths[1], "POST /health");
  EXPECT_EQ(sidecar->paths[2], "POST /health");
  // A server that stands still is not healthy.
  server.Signal(SIGSTOP);
  sidecar->Answer(1, 4);  // it may have asked before
  const std::size_t before = sidecar->paths.size();
  sidecar->Answer(5, before + 1);
  EXPECT_EQ(sidecar->paths.size(), before);
  server.Signal(SIGCONT);
  sidecar->Answer(kPatience, before + 1);
  EXPECT_EQ(sidecar->paths.size(), before + 1);
  EXPECT_EQ(sidecar->paths.back(), "POST /health");
  // Without its sidecar it plays on, and says so once.
  sidecar.reset();
  ASSERT_TRUE(server.WaitForErrors("the rooms go on", kPatience)) << server.Story();
  sidecar = std::make_unique<Sidecar>(port);
  ASSERT_TRUE([&] {
    sidecar->Answer(kPatience, 1);
    return server.WaitForErrors("agones: the sidecar answers again", kPatience);
  }()) << server.Story();
  const std::string errors = server.errors();
  EXPECT_EQ(errors.find("the rooms go on"), errors.rfind("the rooms go on"));
  server.Signal(SIGTERM);
  while (sidecar->paths.back() != "POST /shutdown" && !server.Wait(0)) sidecar->Answer(1, 99);
  EXPECT_EQ(sidecar->paths.back(), "POST /shutdown");
  ASSERT_TRUE(server.Wait(kPatience)) << server.Story();
  EXPECT_EQ(server.status(), 0) << server.Story();
}

TEST_F(AgonesPod, APortThatIsNoneIsOneLine) {
  SEAM_INSIDE_ONLY();
  for (const char* port : {"0", "65536", "http", "", "-1", "9358x"}) {
    Program server(Server(0, port));
    ASSERT_TRUE(server.Wait(kPatience)) << server.Story();
    EXPECT_EQ(server.status(), 2) << server.Story();
    EXPECT_NE(server.errors().find("AGONES_SDK_HTTP_PORT is \"" + std::string(port) + "\""),
              std::string::npos)
        << server.Story();
  }
}

}  // namespace agones_test
}  // namespace seam
