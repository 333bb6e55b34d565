#include "client/swarm/member.h"

#include "common/base/process.h"

namespace seam {

void MemberFigures::Add(const MemberFigures& other) {
  late.Add(other.late);
  tick_cost.Add(other.tick_cost);
  ticks += other.ticks;
  cpu_us += other.cpu_us;
}

Member::Member(const ClientConfig& config)
    : name_(config.name), udp_(kAnyAddress), client_(config, udp_, nowhere_, entropy_) {}

void Member::Tick(std::int64_t now_us, std::int64_t* cpu_us) {
  const bool ran = client_.running();
  const std::int64_t before = ran ? client_.replica()->tick() : 0;
  const std::int64_t due_us = due_us_;
  client_.Tick(now_us, spent_us_);
  const std::int64_t cost_us = ThreadCpuUs() - *cpu_us;
  *cpu_us += cost_us;
  spent_us_ += cost_us;
  figures_.cpu_us += cost_us;
  const bool runs = ran && client_.running();
  const std::int64_t stepped = runs ? client_.replica()->tick() - before : 0;
  const std::int64_t hz = client_.room().tick_hz;
  for (std::int64_t i = 0; i < stepped; ++i) {
    figures_.late.Add(now_us - due_us - i * 1000000 / hz);
    figures_.tick_cost.Add(cost_us / stepped);
  }
  figures_.ticks += stepped;
  due_us_ = client_.next_tick_us(now_us);
}

}  // namespace seam
