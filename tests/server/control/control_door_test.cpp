/// Which requests the operator's door does, and which it refuses.

#include "server/control/control_door.h"

#include <gtest/gtest.h>

#include <vector>

namespace seam {
namespace control_door_test {

HttpRequest Post(const std::string& command) {
  HttpRequest request;
  request.method = "POST";
  request.path = "/control";
  request.query = "token=secret";
  request.host = "127.0.0.1:9465";
  request.body = command;
  return request;
}

class Door : public ::testing::Test {
 protected:
  HttpResponse Ask(const HttpRequest& request) { return door_.Answer(now_us_, request); }
  std::string StatusOf(const HttpRequest& request) { return Ask(request).status; }

  std::vector<std::string> done_;
  std::int64_t now_us_ = 0;
  ControlDoor door_{"secret",
                    [this](const std::string& command) {
                      if (command == "jump") return Status::Error("jump is no command");
                      done_.push_back(command);
                      return Status::Ok();
                    },
                    [this] { return "{\"done\":" + std::to_string(done_.size()) + "}"; }};
};

TEST_F(Door, DoesACommandAndAnswersByThePresentValues) {
  const HttpResponse done = Ask(Post("impair 4g"));
  EXPECT_STREQ(done.status, "200 OK");
  EXPECT_STREQ(done.type, "application/json");
  EXPECT_EQ(done.body, "{\"done\":1}\n");
  EXPECT_EQ(done_, std::vector<std::string>{"impair 4g"});
  HttpRequest look = Post("");
  look.method = "GET";
  EXPECT_EQ(Ask(look).body, "{\"done\":1}\n");
  EXPECT_EQ(done_.size(), 1u) << "a look does nothing";
  const HttpResponse refused = Ask(Post("jump"));
  EXPECT_STREQ(refused.status, "400 Bad Request");
  EXPECT_EQ(refused.body, "jump is no command\n");
}

TEST_F(Door, RefusesWhoeverHasNoToken) {
  for (const char* query : {"", "token=", "token=guess", "token=secret1", "secret",
                            "token=secret&x=1", "TOKEN=secret"}) {
    HttpRequest guessed = Post("impair 4g");
    guessed.query = query;
    EXPECT_EQ(StatusOf(guessed), "403 Forbidden") << query;
    guessed.method = "GET";
    EXPECT_EQ(StatusOf(guessed), "403 Forbidden") << query;
  }
  EXPECT_TRUE(done_.empty());
}

TEST_F(Door, RefusesPagesAndNamesOfOthers) {
  HttpRequest rebound = Post("impair 4g");
  rebound.host = "evil.example:9465";
  EXPECT_EQ(StatusOf(rebound), "403 Forbidden");
  // The door has no page of its own: every page is another's.
  for (const char* origin : {"http://evil.example", "http://127.0.0.1:8080", "null"}) {
    HttpRequest foreign = Post("impair 4g");
    foreign.origin = origin;
    EXPECT_EQ(StatusOf(foreign), "403 Forbidden") << origin;
  }
  HttpRequest other = Post("impair 4g");
  other.path = "/";
  EXPECT_EQ(StatusOf(other), "404 Not Found");
  HttpRequest method = Post("impair 4g");
  method.method = "PUT";
  EXPECT_EQ(StatusOf(method), "405 Method Not Allowed");
  EXPECT_TRUE(done_.empty());
}

TEST_F(Door, AFloodIsRefusedAndEndsWithItsSecond) {
  int refused = 0;
  for (int i = 0; i < 1000; ++i) {
    now_us_ += 100;  // ten thousand a second
    refused += StatusOf(Post("impair 4g")) == "429 Too Many Requests" ? 1 : 0;
  }
  const auto most =
      static_cast<std::size_t>(ControlDoor::kCommandsAtOnce + ControlDoor::kCommandsPerS * 0.1) + 1;
  EXPECT_LE(done_.size(), most);
  EXPECT_GE(done_.size(), most - 2);
  EXPECT_EQ(refused, 1000 - static_cast<int>(done_.size()));
  // Those without the token use up nothing.
  now_us_ += 1000000;
  HttpRequest guessed = Post("impair 4g");
  guessed.query = "token=guess";
  for (int i = 0; i < 1000; ++i) EXPECT_EQ(StatusOf(guessed), "403 Forbidden");
  EXPECT_EQ(StatusOf(Post("impair 4g")), "200 OK");
}

}  // namespace control_door_test
}  // namespace seam
