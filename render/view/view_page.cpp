#include "render/view/view_page.h"

#include <cstdio>
#include <utility>

#include "common/sync/inputs/input_line.h"
#include "render/page/document.h"

namespace seam {
namespace {

/// True if a request comes from a page of this server, or from no page at all.
bool IsOwnOrigin(const HttpRequest& request) {
  return request.origin.empty() || request.origin == "http://" + request.host;
}

}  // namespace

bool ParseDrive(const std::string& text, std::int64_t* number, Input* input) {
  long long n = 0;
  int end = 0;
  if (std::sscanf(text.c_str(), "%18lld %n", &n, &end) != 1 || n < 0 || end == 0) return false;
  *number = n;
  return ParseInputLine(text.substr(static_cast<std::size_t>(end)), input);
}

ViewPage::ViewPage(std::string token, std::function<void(const Input&)> drive, Control control)
    : token_(std::move(token)),
      page_(LivePageHtml()),
      drive_(std::move(drive)),
      control_(std::move(control)) {}

HttpResponse ViewPage::Answer(std::int64_t now_us, const HttpRequest& request) {
  if (!IsLoopbackHost(request.host)) {
    return HttpResponse::Refusal("403 Forbidden", "this page is at 127.0.0.1 and localhost only");
  }
  if (request.path == "/drive") return Drive(now_us, request);
  if (request.path == "/control") return Command(now_us, request);
  if (request.method != "GET") {
    return HttpResponse::Refusal("405 Method Not Allowed", "only GET is answered here");
  }
  HttpResponse response;
  if (request.path == "/") {
    response.type = "text/html; charset=utf-8";
    response.body = page_;
  } else if (request.path == "/live") {
    if (!IsOwnOrigin(request)) return HttpResponse::Refusal("403 Forbidden", "another site asks");
    response.type = "text/event-stream";
    response.stream = true;
  } else {
    return HttpResponse::Refusal("404 Not Found", "the page is /");
  }
  return response;
}

bool ViewPage::IsTrusted(const HttpRequest& request) const {
  return !token_.empty() && request.query == "token=" + token_ && IsOwnOrigin(request);
}

HttpResponse ViewPage::Command(std::int64_t now_us, const HttpRequest& request) {
  if (request.method != "POST") {
    return HttpResponse::Refusal("405 Method Not Allowed", "/control takes POST");
  }
  if (!control_) {
    return HttpResponse::Refusal("403 Forbidden", "nothing is changed from here (--control)");
  }
  if (!IsTrusted(request)) {
    return HttpResponse::Refusal("403 Forbidden",
                                 "changes need the token of the address that was printed");
  }
  if (request.body.empty()) return HttpResponse::Refusal("400 Bad Request", "no command");
  const Status done = control_(now_us, request.body);
  if (!done.ok()) return HttpResponse::Refusal("400 Bad Request", done.why());
  HttpResponse response;
  response.status = "204 No Content";
  return response;
}

HttpResponse ViewPage::Drive(std::int64_t now_us, const HttpRequest& request) {
  if (request.method != "POST")
    return HttpResponse::Refusal("405 Method Not Allowed", "/drive takes POST");
  if (token_.empty() || !drive_) {
    return HttpResponse::Refusal("403 Forbidden", "nobody is driven from here (--drive)");
  }
  if (!IsTrusted(request)) {
    return HttpResponse::Refusal("403 Forbidden",
                                 "driving needs the token of the address that was printed");
  }
  std::int64_t number = 0;
  Input input;
  if (!ParseDrive(request.body, &number, &input)) {
    return HttpResponse::Refusal("400 Bad Request", "the body must be NUMBER DRIVE LIFT BUTTONS");
  }
  if (number > number_) {
    number_ = number;
    held_us_ = now_us;
    Set(input);
  }
  HttpResponse response;
  response.status = "204 No Content";
  return response;
}

void ViewPage::Tick(std::int64_t now_us) {
  if (now_us - held_us_ > kHeldUs) Set(Input());
}

void ViewPage::Set(const Input& input) {
  if (input == input_) return;
  input_ = input;
  drive_(input);
}

}  // namespace seam
