#include "server/fleet/agones.h"

#include <chrono>
#include <cstdlib>
#include <utility>

#include "common/base/check.h"

namespace seam {
namespace {

constexpr std::chrono::seconds kHealthEvery{2};  // as Agones's guide has it; it waits for 5 s
/// A room that has not run for so long hangs, us.
constexpr std::int64_t kHangsUs = 2000000;
constexpr int kAnswerWaitS = 2;
constexpr std::size_t kAnswerBytesMax = 4096;

std::string SidecarAddress() {
  const char* const given = std::getenv("AGONES_SDK_HTTP_PORT");
  const std::string port = given == nullptr ? "9358" : given;
  const bool digits = !port.empty() && port.size() <= 5 &&
                      port.find_first_not_of("0123456789") == std::string::npos;
  if (!digits || std::stoi(port) < 1 || std::stoi(port) > 65535) {
    throw OperatorError("--agones: AGONES_SDK_HTTP_PORT is \"" + port + "\", which is no port");
  }
  return "http://127.0.0.1:" + port;
}

}  // namespace

Agones::Agones() : address_(SidecarAddress()), thread_([this] { Run(); }) {}

Agones::~Agones() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
  Say("/shutdown");
}

void Agones::Poll(std::int64_t now_us, const Hub& hub, std::vector<std::string>* lines) {
  const bool healthy = hub.AllRan(now_us - kHangsUs);
  const std::lock_guard<std::mutex> lock(mutex_);
  healthy_ = healthy_ || healthy;
  for (std::string& line : news_) lines->push_back(std::move(line));
  news_.clear();
}

void Agones::Run() {
  std::unique_lock<std::mutex> lock(mutex_);
  bool ready = false;
  while (!stop_) {
    const bool healthy = std::exchange(healthy_, false);
    lock.unlock();
    if (!ready) {
      Say("/ready");
      ready = answers_;
    }
    if (healthy) Say("/health");
    lock.lock();
    wake_.wait_for(lock, kHealthEvery, [this] { return stop_; });
  }
}

/// Reports only what has changed: the sidecar may be gone for hours.
void Agones::Say(const char* what) {
  std::string answer;
  const Status status = post_.Send(address_ + what, "{}", kAnswerWaitS, kAnswerBytesMax, &answer);
  if (status.ok() == answers_) return;
  answers_ = status.ok();
  const std::lock_guard<std::mutex> lock(mutex_);
  news_.push_back(answers_ ? "agones: the sidecar answers again"
                           : "agones: " + status.why() + "; the rooms go on");
}

}  // namespace seam
