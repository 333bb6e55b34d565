#include "render/view/control_line.h"

#include <algorithm>

#include "common/base/check.h"
#include "common/net/http_page.h"

namespace seam {
namespace {

constexpr std::int64_t kAskUs = 1000000;

}  // namespace

ControlLine::ControlLine(const std::string& url) {
  const std::string scheme = "http://";
  const std::size_t slash = url.find('/', scheme.size());
  const bool plain =
      std::all_of(url.begin(), url.end(), [](char c) { return c > ' ' && c <= '~'; });
  const bool whole = plain && url.rfind(scheme, 0) == 0 && slash != std::string::npos &&
                     url.find("?token=") != std::string::npos;
  address_ = whole ? url.substr(scheme.size(), slash - scheme.size()) : "";
  if (!whole || !IsLoopbackHost(address_)) {
    throw OperatorError("--control takes the address that seam-server --control prints: " + scheme +
                        "127.0.0.1:PORT/control?token=...");
  }
  target_ = url.substr(slash);
}

Status ControlLine::Send(std::int64_t now_us, const std::string& command) {
  asked_us_ = now_us;
  const Status silent = Status::Error("the server does not answer");
  if (now_us - silent_us_ < kAgainUs) return silent;
  HttpAnswer answer;
  const char* const method = command.empty() ? "GET" : "POST";
  if (!AskPage(address_, method, target_, command, kAnswerUs, &answer).ok()) {
    silent_us_ = now_us;
    state_.clear();
    return silent;
  }
  std::string line = answer.body.substr(0, answer.body.find('\n'));
  if (answer.status != 200) return Status::Error(line.empty() ? "the server refuses" : line);
  state_ = line;
  return Status::Ok();
}

void ControlLine::Tick(std::int64_t now_us) {
  if (now_us - asked_us_ >= kAskUs) (void)Send(now_us, "");
}

}  // namespace seam
