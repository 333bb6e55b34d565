#pragma once
/// Process services of the mains: clocks, CPU time, stop signals and exit status.

#include <sched.h>
#include <sys/resource.h>
#include <time.h>

#include <csignal>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <string>

#include "common/base/check.h"

namespace seam {

/// Wall clock, us since 1970, as LCM's utime. May jump when the system's clock is set.
inline std::int64_t WallClockUs() {
  timespec t{};
  clock_gettime(CLOCK_REALTIME, &t);
  return static_cast<std::int64_t>(t.tv_sec) * 1000000 + t.tv_nsec / 1000;
}

/// Clock that never runs backwards, us. Starts at the wall clock's reading at the first call.
inline std::int64_t SteadyClockUs() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  const std::int64_t now = static_cast<std::int64_t>(t.tv_sec) * 1000000 + t.tv_nsec / 1000;
  static const std::int64_t offset_us = WallClockUs() - now;
  return now + offset_us;
}

/// CPU time of this process so far, us.
inline std::int64_t CpuUs() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::int64_t>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) * 1000000 +
         usage.ru_utime.tv_usec + usage.ru_stime.tv_usec;
}

/// Number of cores this process may use, at least 1.
inline int CoreCount() {
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) != 0) return 1;
  return CPU_COUNT(&set) > 0 ? CPU_COUNT(&set) : 1;
}

/// Sleeps `us` microseconds, capped just below 1 s; a signal ends it early. Returns at once for
/// `us` <= 0.
inline void SleepUs(std::int64_t us) {
  if (us <= 0) return;
  timespec t{};
  t.tv_nsec = static_cast<long>(us < 1000000 ? us : 999999) * 1000;
  nanosleep(&t, nullptr);
}

/// CPU time of this thread so far, us.
inline std::int64_t ThreadCpuUs() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<std::int64_t>(t.tv_sec) * 1000000 + t.tv_nsec / 1000;
}

inline volatile std::sig_atomic_t g_stop = 0;

/// Makes SIGINT, SIGTERM and SIGHUP (a closed terminal, unless nohup ignores it) set g_stop and
/// interrupt poll(). The same signal a second time kills the process.
inline void StopOnSignals() {
  struct sigaction action {};
  action.sa_handler = [](int) { g_stop = 1; };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction hang_up {};
  sigaction(SIGHUP, nullptr, &hang_up);
  if (hang_up.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a file at `ulimit -f`: the write fails, as on a full disk
}

/// Writes "program: text" to stderr as one line. Control characters become '?': a file's name may
/// contain line ends and terminal commands.
inline void PrintError(const char* program, std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  std::fprintf(stderr, "%s: %s\n", program, text.c_str());
}

/// Runs a main's body and returns its exit status. An OperatorError gives one line and status 2,
/// any other exception one line and status 1.
template <typename Body>
int RunMain(const char* program, Body body) {
  try {
    return body();
  } catch (const OperatorError& e) {
    PrintError(program, e.what());
    return 2;
  } catch (const std::exception& e) {
    PrintError(program, std::string("unexpected: ") + e.what());
    return 1;
  }
}

}  // namespace seam
