/// The requests that seam-view answers, and those that it refuses.

#include "render/view/view_page.h"

#include <gtest/gtest.h>

#include <vector>

namespace seam {
namespace view_page_test {

HttpRequest Get(const std::string& path) {
  HttpRequest request;
  request.method = "GET";
  request.path = path;
  request.host = "127.0.0.1:8080";
  return request;
}

HttpRequest Post(const std::string& body) {
  HttpRequest request = Get("/drive");
  request.method = "POST";
  request.query = "token=secret";
  request.origin = "http://127.0.0.1:8080";
  request.body = body;
  return request;
}

std::string StatusOf(ViewPage* page, const HttpRequest& request) {
  return page->Answer(0, request).status;
}

TEST(ViewPage, HasAPageAndAStreamForThisMachineOnly) {
  ViewPage page("", [](const Input&) { FAIL(); });
  const HttpResponse whole = page.Answer(0, Get("/"));
  EXPECT_STREQ(whole.type, "text/html; charset=utf-8");
  EXPECT_NE(whole.body.find("connect-src 'self'"), std::string::npos);
  EXPECT_NE(whole.body.find("followLive"), std::string::npos);
  EXPECT_TRUE(page.Answer(0, Get("/live")).stream);
  EXPECT_EQ(StatusOf(&page, Get("/other")), "404 Not Found");
  HttpRequest rebound = Get("/");
  rebound.host = "evil.example:8080";
  EXPECT_EQ(StatusOf(&page, rebound), "403 Forbidden");
  HttpRequest foreign = Get("/live");
  foreign.origin = "http://evil.example";
  EXPECT_EQ(StatusOf(&page, foreign), "403 Forbidden");
  HttpRequest posted = Get("/");
  posted.method = "POST";
  EXPECT_EQ(StatusOf(&page, posted), "405 Method Not Allowed");
  EXPECT_EQ(StatusOf(&page, Post("1 0 0 0")), "403 Forbidden") << "nobody may drive";
}

TEST(ViewPage, DrivesForWhoeverHasTheToken) {
  std::vector<Input> seen;
  ViewPage page("secret", [&](const Input& input) { seen.push_back(input); });
  EXPECT_EQ(StatusOf(&page, Post("5 127 -127 3")), "204 No Content");
  ASSERT_EQ(seen.size(), 1u);
  EXPECT_TRUE(seen[0] == (Input{127, -127, 3}));
  EXPECT_EQ(StatusOf(&page, Post("4 0 0 0")), "204 No Content") << "overtaken: not taken";
  EXPECT_EQ(StatusOf(&page, Post("6 127 -127 3")), "204 No Content") << "the same: not told";
  EXPECT_EQ(seen.size(), 1u);
  page.Tick(ViewPage::kHeldUs / 2);
  EXPECT_EQ(seen.size(), 1u);
  page.Tick(ViewPage::kHeldUs + 1);
  ASSERT_EQ(seen.size(), 2u) << "the page has gone: it holds nothing any more";
  EXPECT_TRUE(seen[1] == Input());
  for (const char* body : {"", "7", "7 1 1", "7 128 0 0", "7 0 -128 0", "7 0 0 1024", "7 0 0 -1",
                           "-1 0 0 0", "7 0 0 0 0", "7 0 0 x", "7 1e9 0 0"})
    EXPECT_EQ(StatusOf(&page, Post(body)), "400 Bad Request") << body;
  HttpRequest guessed = Post("9 1 1 1");
  guessed.query = "token=guess";
  EXPECT_EQ(StatusOf(&page, guessed), "403 Forbidden");
  HttpRequest foreign = Post("9 1 1 1");
  foreign.origin = "http://localhost:9999";
  EXPECT_EQ(StatusOf(&page, foreign), "403 Forbidden");
  EXPECT_EQ(seen.size(), 2u);
}

HttpRequest Command(const std::string& command) {
  HttpRequest request = Post(command);
  request.path = "/control";
  return request;
}

TEST(ViewPage, PassesOnCommandsOfItsOwnPageAlone) {
  std::vector<std::string> passed;
  ViewPage page("secret", nullptr, [&](std::int64_t, const std::string& command) {
    if (command == "jump") return Status::Error("jump is no command");
    passed.push_back(command);
    return Status::Ok();
  });
  EXPECT_EQ(StatusOf(&page, Command("impair 4g")), "204 No Content");
  const HttpResponse refused = page.Answer(0, Command("jump"));
  EXPECT_STREQ(refused.status, "400 Bad Request");
  EXPECT_EQ(refused.body, "jump is no command\n");
  EXPECT_EQ(StatusOf(&page, Command("")), "400 Bad Request");
  HttpRequest guessed = Command("impair 4g");
  guessed.query = "token=guess";
  EXPECT_EQ(StatusOf(&page, guessed), "403 Forbidden");
  HttpRequest foreign = Command("impair 4g");
  foreign.origin = "http://localhost:9999";
  EXPECT_EQ(StatusOf(&page, foreign), "403 Forbidden");
  HttpRequest rebound = Command("impair 4g");
  rebound.host = "evil.example";
  EXPECT_EQ(StatusOf(&page, rebound), "403 Forbidden");
  HttpRequest read = Command("impair 4g");
  read.method = "GET";
  EXPECT_EQ(StatusOf(&page, read), "405 Method Not Allowed");
  EXPECT_EQ(StatusOf(&page, Post("5 1 1 1")), "403 Forbidden") << "it drives nobody";
  EXPECT_EQ(passed, std::vector<std::string>{"impair 4g"});
  ViewPage only_drives("secret", [](const Input&) {});
  EXPECT_EQ(StatusOf(&only_drives, Command("impair 4g")), "403 Forbidden");
  ViewPage only_shows("", nullptr);
  EXPECT_EQ(StatusOf(&only_shows, Command("impair 4g")), "403 Forbidden");
}

}  // namespace view_page_test
}  // namespace seam
