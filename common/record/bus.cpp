#include "common/record/bus.h"

#include <poll.h>
#include <regex.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <lcm/lcm-cpp.hpp>
#include <utility>

#include "common/base/check.h"
#include "common/codec/messages.h"

namespace seam {
namespace {

/// Most messages queued for one Poll; LCM's default of 30 loses messages when 30 clients send in
/// phase.
constexpr int kQueueMessages = 4096;
/// Most messages handled by one Poll, so that a flood cannot block the caller.
constexpr int kPollMessagesMax = 10000;

constexpr const char* kRoute =
    "as root type: ip link set lo up multicast on; ip route add 224.0.0.0/4 dev lo   (without "
    "root: unshare -rn sh -c 'ip link set lo up; ip route add 224.0.0.0/4 dev lo; exec \"$@\"' sh "
    "COMMAND)";

/// Captures stderr during its lifetime: LCM writes its explanations there, in many lines.
class StderrCapture {
 public:
  StderrCapture() : text_fd_(memfd_create("lcm-stderr", MFD_CLOEXEC)), stderr_fd_(dup(2)) {
    std::fflush(stderr);
    if (text_fd_ >= 0 && stderr_fd_ >= 0) dup2(text_fd_, 2);
  }
  ~StderrCapture() { Take(); }
  StderrCapture(const StderrCapture&) = delete;
  StderrCapture& operator=(const StderrCapture&) = delete;

  /// Ends the capture and returns the text.
  std::string Take() {
    std::string text;
    if (text_fd_ >= 0 && stderr_fd_ >= 0) {
      std::fflush(stderr);
      dup2(stderr_fd_, 2);
      char buffer[4096];
      const ssize_t bytes = pread(text_fd_, buffer, sizeof buffer, 0);
      text.assign(buffer, static_cast<std::size_t>(std::max<ssize_t>(bytes, 0)));
    }
    if (text_fd_ >= 0) close(text_fd_);
    if (stderr_fd_ >= 0) close(stderr_fd_);
    text_fd_ = stderr_fd_ = -1;
    return text;
  }

 private:
  int text_fd_, stderr_fd_;
};

bool Contains(const std::string& text, const char* part) {
  return text.find(part) != std::string::npos;
}

/// Returns the url in effect, with a receive buffer that holds a burst.
std::string FullUrl(std::string url) {
  const char* fallback = std::getenv("LCM_DEFAULT_URL");
  if (url.empty() && fallback != nullptr) url = fallback;
  if (url.empty()) url = "udpm://239.255.76.67:7667";
  if (url.compare(0, 7, "udpm://") == 0 && !Contains(url, "recv_buf_size")) {
    url += Contains(url, "?") ? "&" : "?";
    url += "recv_buf_size=" + std::to_string(kBusReceiveBytes);
  }
  return url;
}

/// Condenses LCM's several lines into one.
std::string OneLine(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.substr(0, 200);
}

[[noreturn]] void ThrowNotCreated(const std::string& url, const std::string& text) {
  if (Contains(text, "provider") || Contains(text, "URL") || Contains(text, "parse")) {
    throw OperatorError("LCM url \"" + url +
                        "\" is wrong; say for example udpm://239.255.76.67:7667");
  }
  if (Contains(text, "unreachable") || Contains(text, "No such device") ||
      Contains(text, "route")) {
    throw OperatorError(
        "LCM: this machine has no route for multicast; do without the bus "
        "(--lcm-url none), or " +
        std::string(kRoute));
  }
  throw OperatorError("LCM url \"" + url + "\" cannot be used: " + OneLine(text));
}

}  // namespace

struct Bus::Impl {
  struct Subscriber {
    Handler handler;
    std::int64_t* failures;
  };

  static void Handle(const lcm::ReceiveBuffer* buffer, const std::string& channel,
                     Subscriber* subscriber) {
    try {  // no exception may pass through LCM's C code
      const ByteView message(static_cast<const std::uint8_t*>(buffer->data), buffer->data_size);
      subscriber->handler(channel, buffer->recv_utime, message);
    } catch (...) {
      ++*subscriber->failures;
    }
  }

  std::string url;
  std::unique_ptr<lcm::LCM> lcm;
  std::vector<std::unique_ptr<Subscriber>> subscribers;
  std::vector<std::string> warnings;
  std::int64_t failures = 0;
};

Bus::Bus(const std::string& url) : impl_(new Impl) {
  impl_->url = FullUrl(url);
  StderrCapture capture;
  impl_->lcm = std::make_unique<lcm::LCM>(impl_->url);
  const std::string text = capture.Take();
  if (!impl_->lcm->good()) ThrowNotCreated(impl_->url, text);
}

Bus::~Bus() = default;

void Bus::Publish(const std::string& channel, std::int64_t, ByteView message) {
  const bool fits =
      !channel.empty() && channel.size() <= kChannelBytesMax && message.size <= kBusMessageBytesMax;
  const auto bytes = static_cast<unsigned int>(message.size);
  if (!fits || impl_->lcm->publish(channel, message.data, bytes) != 0) ++impl_->failures;
}

std::int64_t Bus::failures() const { return impl_->failures; }

void Bus::Subscribe(const std::string& channel_regex, Handler handler) {
  // LCM just adds ^ and $; the parentheses make them apply to all of "a|b".
  const std::string regex = "(" + channel_regex + ")";
  regex_t compiled;
  if (regcomp(&compiled, regex.c_str(), REG_EXTENDED | REG_NOSUB) != 0) {
    throw OperatorError("channel \"" + channel_regex + "\" is not a regular expression");
  }
  regfree(&compiled);

  StderrCapture capture;
  const bool listening = impl_->lcm->getFileno() >= 0;
  const std::string text = capture.Take();
  if (!listening) {
    throw OperatorError("LCM: multicast sent on " + impl_->url +
                        " does not come back; a firewall? As root type: "
                        "iptables -I INPUT -d 224.0.0.0/4 -p udp -j ACCEPT; or " +
                        kRoute);
  }
  if (Contains(text, "receive buffer")) {
    impl_->warnings.push_back(
        "LCM's receive buffer is smaller than asked for, bursts of large messages may be lost; as "
        "root type: sysctl -w net.core.rmem_max=" +
        std::to_string(kBusReceiveBytes));
  } else if (!text.empty()) {
    impl_->warnings.push_back("LCM says: " + OneLine(text));
  }
  impl_->subscribers.push_back(
      std::make_unique<Impl::Subscriber>(Impl::Subscriber{std::move(handler), &impl_->failures}));
  lcm::Subscription* subscription =
      impl_->lcm->subscribeFunction(regex, &Impl::Handle, impl_->subscribers.back().get());
  subscription->setQueueCapacity(kQueueMessages);
}

void Bus::Poll(std::int64_t timeout_us) {
  const int descriptor = fd();
  if (descriptor < 0) return;
  pollfd wait = {descriptor, POLLIN, 0};
  timespec timeout = {};
  timeout.tv_sec = static_cast<time_t>(std::max<std::int64_t>(timeout_us, 0) / 1000000);
  timeout.tv_nsec = static_cast<long>(std::max<std::int64_t>(timeout_us, 0) % 1000000 * 1000);
  if (ppoll(&wait, 1, &timeout, nullptr) <= 0) return;
  for (int i = 0; i < kPollMessagesMax && impl_->lcm->handleTimeout(0) > 0;) ++i;
}

int Bus::fd() const { return impl_->subscribers.empty() ? -1 : impl_->lcm->getFileno(); }

const std::vector<std::string>& Bus::warnings() const { return impl_->warnings; }

}  // namespace seam
