#include "client/swarm/group.h"

#include <poll.h>
#include <sys/epoll.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "common/base/check.h"
#include "common/base/process.h"

namespace seam {
namespace {

/// The longest stay in Run, us.
constexpr std::int64_t kStayUs = 100000;
/// Sockets reported by one system call.
constexpr int kSocketEvents = 256;

}  // namespace

Group::Group() : epoll_(epoll_create1(EPOLL_CLOEXEC)) {
  if (epoll_ < 0) throw OperatorError(std::string("no epoll here: ") + std::strerror(errno));
}

Group::~Group() { close(epoll_); }

void Group::Add(ClientConfig config, bool first_of_room) {
  config.scenes = &scenes_;
  first_of_room_.push_back(first_of_room);
  members_.push_back(std::make_unique<Member>(config));
  due_us_.push_back(0);
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.u64 = members_.size() - 1;
  if (epoll_ctl(epoll_, EPOLL_CTL_ADD, members_.back()->fd(), &event) != 0) {
    throw OperatorError(std::string("cannot watch a socket: ") + std::strerror(errno));
  }
}

/// Sleeps until a socket is readable. Not by epoll_wait itself, which counts in milliseconds.
void Group::Sleep(std::int64_t us) const {
  pollfd watched{epoll_, POLLIN, 0};
  timespec timeout{};
  timeout.tv_nsec = static_cast<long>(std::clamp<std::int64_t>(us, 0, 999999)) * 1000;
  (void)ppoll(&watched, 1, &timeout, nullptr);
}

void Group::TickOne(std::size_t member, std::int64_t now_us, std::int64_t* cpu_us) {
  members_[member]->Tick(now_us, cpu_us);
  due_us_[member] = members_[member]->due_us();
}

std::int64_t Group::TickDue(std::int64_t* cpu_us) {
  std::int64_t at_us = SteadyClockUs();
  for (std::size_t i = 0; i < members_.size(); ++i) {
    if (due_us_[i] > at_us) continue;
    TickOne(i, at_us, cpu_us);
    at_us = SteadyClockUs();
  }
  return *std::min_element(due_us_.begin(), due_us_.end());
}

/// Steps due members before those with datagrams: a due one reads its own, and a call costs as much
/// as many datagrams, since the member's data has left the processor's caches meanwhile.
void Group::Run(std::int64_t until_us) {
  const std::int64_t end_us = std::min(until_us, SteadyClockUs() + kStayUs);
  std::array<epoll_event, kSocketEvents> events{};
  std::int64_t cpu_us = ThreadCpuUs();
  for (std::int64_t now_us = SteadyClockUs(); now_us < end_us && g_stop == 0;
       now_us = SteadyClockUs()) {
    const std::int64_t due_us = TickDue(&cpu_us);
    now_us = SteadyClockUs();
    Sleep(std::min(due_us, end_us) - now_us);
    cpu_us = ThreadCpuUs();
    const int ready = epoll_wait(epoll_, events.data(), kSocketEvents, 0);
    for (int i = 0; i < ready; ++i) {
      now_us = SteadyClockUs();
      if (now_us >= due_us) break;  // remaining datagrams wait
      TickOne(events[static_cast<std::size_t>(i)].data.u64, now_us, &cpu_us);
    }
  }
}

void Group::Leave(std::int64_t now_us) {
  for (const auto& member : members_) member->Leave(now_us);
}

int Group::running() const {
  return static_cast<int>(std::count_if(members_.begin(), members_.end(), [](const auto& member) {
    return member->client().running();
  }));
}

std::string Group::Fatal() const {
  for (const auto& member : members_) {
    const std::string& why = member->client().fatal();
    if (!why.empty()) return member->name() + ": " + why;
  }
  return "";
}

bool Group::Closed() const {
  return std::any_of(members_.begin(), members_.end(),
                     [](const auto& member) { return member->client().closed(); });
}

MovingBodies Group::Moving(std::size_t part, std::size_t parts) const {
  MovingBodies moving;
  for (std::size_t i = part; i < members_.size(); i += parts) {
    const Client& client = members_[i]->client();
    if (!client.running()) continue;
    moving.held += MovingHeld(*client.replica(), client.peer());
    if (first_of_room_[i]) moving.server += MovingHeld(*client.replica(), 0);
  }
  return moving;
}

MemberFigures Group::Figures() const {
  MemberFigures all;
  for (const auto& member : members_) all.Add(member->figures());
  return all;
}

void Group::Forget() {
  for (const auto& member : members_) member->Forget();
}

}  // namespace seam
