#include "tests/support/live_session.h"

#include <signal.h>
#include <unistd.h>

#include <algorithm>

#include "common/base/check.h"
#include "common/record/bus.h"
#include "common/record/log_file.h"

namespace seam {

LiveSession::LiveSession(const Workspace& folder, int index, const SessionPlan& plan)
    : plan_(plan),
      stem_(folder / plan.name),
      port_(std::to_string(17300 + index)),
      lcm_url_("udpm://239.255.76.67:" + std::to_string(18300 + index) + "?ttl=0") {
  logger_ = std::make_unique<Program>(
      std::vector<std::string>{"lcm-logger", "--quiet", "--force",
                               "--lcm-url=" + lcm_url_ + "&recv_buf_size=4194304", capture_path()});
}

bool LiveSession::Probe(const std::string& channel) {
  Bus bus(lcm_url_);
  for (int i = 0; i < 1000 && !logger_->Wait(0); ++i) {
    bus.Publish(channel, 0, Bytes{1});
    usleep(20000);
    try {
      LogReader log(capture_path());
      for (LogEvent event; log.Next(&event);) {
        if (event.channel == channel) return true;
      }
    } catch (const OperatorError&) {
      // no event in it yet
    }
  }
  return false;
}

bool LiveSession::Begin() {
  if (!Probe("BEGIN")) return false;
  std::vector<std::string> words = {BuiltProgram("seam-server"),
                                    plan_.scene,
                                    "--bind",
                                    "127.0.0.1",
                                    "--port",
                                    port_,
                                    "--lcm-url",
                                    lcm_url_};
  const auto& given = plan_.server_flags;
  if (std::find(given.begin(), given.end(), "--duration") == given.end()) {
    words.insert(words.end(), {"--duration", "0"});  // until it is stopped
  }
  words.insert(words.end(), given.begin(), given.end());
  server_ = std::make_unique<Program>(words);
  for (const auto& [name, flags] : plan_.clients) Join(name, flags);
  return true;
}

Program& LiveSession::Join(const std::string& name, const std::vector<std::string>& flags,
                           int terminal) {
  std::vector<std::string> words = {
      BuiltProgram("seam-client"), address(), "--name", name, "--lcm-url", lcm_url_};
  words.insert(words.end(), flags.begin(), flags.end());
  clients_[name] = std::make_unique<Program>(words, "", terminal);
  return *clients_[name];
}

bool LiveSession::Finish(double seconds) {
  bool ended = server_ != nullptr && server_->Wait(seconds);
  for (auto& [name, program] : clients_) ended = program->Wait(seconds) && ended;
  // The logger writes with a delay, and loses unwritten messages when it is stopped.
  ended = Probe("END") && ended;
  logger_->Signal(SIGINT);
  return logger_->Wait(10) && ended;
}

Recording LiveSession::Captured() const {
  try {
    return ReadRecording(capture_path());
  } catch (const OperatorError&) {
    return Recording();  // nothing of the room yet
  }
}

bool LiveSession::WaitUntil(const std::function<bool(const Recording&)>& enough,
                            double seconds) const {
  for (int i = 0; i <= static_cast<int>(seconds * 20); ++i) {
    if (enough(Captured())) return true;
    usleep(50000);
  }
  return false;
}

std::string LiveSession::Story() const {
  std::string text = plan_.name + ": logger: " + logger_->Story();
  if (server_ != nullptr) text += "\nserver: " + server_->Story();
  for (const auto& [name, program] : clients_) text += "\n" + name + ": " + program->Story();
  return text;
}

long NumberBefore(const std::string& text, const std::string& word) {
  const std::size_t end = text.rfind(word);
  if (end == std::string::npos || end == 0) return -1;
  const std::size_t before = text.find_last_not_of("0123456789", end - 1);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  return begin == end ? -1 : std::stol(text.substr(begin, end - begin));
}

int FindEvent(const Recording& recording, const std::string& text) {
  for (std::size_t i = 0; i < recording.events.size(); ++i) {
    if (recording.events[i].text.find(text) != std::string::npos) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace seam
