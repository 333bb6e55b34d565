/// seam-top: shows the load of a server's rooms in a terminal. `seam-top --help`.

#include <time.h>
#include <unistd.h>

#include <cstdio>
#include <map>

#include "client/top/loads.h"
#include "client/top/top_table.h"
#include "common/base/command_line.h"
#include "common/base/process.h"
#include "common/codec/version_line.h"
#include "common/net/udp.h"

namespace {

using namespace seam;

struct Flags {
  std::string page;
  std::string lcm_url;
  int times = 0;
};

void Define(Command& app, Flags& f) {
  app.Option("page", f.page,
             "host:port of the page of a seam-server with --metrics (port 9464 if left out); "
             "without it the LCM bus is heard");
  app.Option("--lcm-url", f.lcm_url, "LCM bus (default: LCM_DEFAULT_URL)");
  app.Option("--times", f.times, "tables to print (0: until stopped)").Range(0, 1000000);
}

/// Prints a table. Clears a terminal before each; other outputs get one table after another.
void Print(const std::string& table) {
  if (isatty(1) != 0) std::printf("\033[H\033[J");
  std::printf("%s", table.c_str());
  std::fflush(stdout);
}

int Watch(const Flags& f) {
  if (!f.page.empty()) (void)ParseAddress(f.page, 9464);
  const std::unique_ptr<Loads> loads = f.page.empty() ? LoadsOnBus(f.lcm_url) : LoadsOnPage(f.page);
  StopOnSignals();
  TopTable table;
  int printed = 0;
  std::int64_t next_us = SteadyClockUs() + 1200000;  // time to receive each room once
  bool failed = false;
  while (g_stop == 0 && (f.times == 0 || printed < f.times)) {
    const std::int64_t now_us = SteadyClockUs();
    for (const RoomLoad& load : loads->Take(now_us)) table.Take(now_us, load);
    if (now_us >= next_us) {
      next_us += 1000000;
      ++printed;
      failed = table.empty() && !loads->trouble().empty();
      Print(table.Text(now_us) + (loads->trouble().empty() ? "" : loads->trouble() + "\n"));
    }
    const timespec moment{0, 20000000};
    nanosleep(&moment, nullptr);
  }
  return failed ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  Flags flags;
  const ProgramText text{"seam-top", "seam-top: what the rooms of a seam-server cost, each second",
                         VersionLine("seam-top"), ""};
  return RunCommandLine(
      text, argc, argv, [&](Command& app) { Define(app, flags); }, [&] { return Watch(flags); });
}
