#include "server/control/control_door.h"

#include <algorithm>
#include <utility>

namespace seam {
ControlDoor::ControlDoor(std::string token, Do act, State state)
    : token_(std::move(token)), act_(std::move(act)), state_(std::move(state)) {}

HttpResponse ControlDoor::Answer(std::int64_t now_us, const HttpRequest& request) {
  if (!IsLoopbackHost(request.host)) {
    return HttpResponse::Refusal("403 Forbidden", "this door is at 127.0.0.1 and localhost only");
  }
  // A page of any site can send here, but it knows no token.
  if (!request.origin.empty() || request.query != "token=" + token_) {
    return HttpResponse::Refusal("403 Forbidden",
                                 "commands need the token of the address that was printed");
  }
  if (request.path != "/control")
    return HttpResponse::Refusal("404 Not Found", "the door is /control");
  if (request.method != "GET" && request.method != "POST") {
    return HttpResponse::Refusal("405 Method Not Allowed", "/control takes GET and POST");
  }
  credit_ = std::min(kCommandsAtOnce,
                     credit_ + static_cast<double>(now_us - credited_us_) * 1e-6 * kCommandsPerS);
  credited_us_ = now_us;
  if (credit_ < 1)
    return HttpResponse::Refusal("429 Too Many Requests", "too many commands; try again");
  credit_ -= 1;
  if (request.method == "POST") {
    const Status done = act_(request.body);
    if (!done.ok()) return HttpResponse::Refusal("400 Bad Request", done.why());
  }
  HttpResponse response;
  response.type = "application/json";
  response.body = state_() + "\n";
  return response;
}

}  // namespace seam
