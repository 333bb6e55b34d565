/// seam-view: a running session as a page in a browser. `seam-view --help`.

#include <unistd.h>

#include <cstdio>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "common/base/command_line.h"
#include "common/base/entropy.h"
#include "common/base/hex.h"
#include "common/base/names.h"
#include "common/base/process.h"
#include "common/codec/version_line.h"
#include "common/net/http_server.h"
#include "common/record/bus.h"
#include "common/sync/inputs/input_line.h"
#include "render/view/control_line.h"
#include "render/view/live_feed.h"
#include "render/view/log_tails.h"
#include "render/view/view_page.h"

namespace {

using namespace seam;

struct Flags {
  std::vector<std::string> logs;
  std::string room;
  int port = 8080;
  std::string lcm_url;
  std::string drive;
  std::string control;  // address of a server's door; "": none
  std::string token;    // "": one of its own
  bool oracle = false;
  bool quiet = false;
};

/// Time between two looks at logs that grow, us.
constexpr std::int64_t kLogsUs = 10000;
constexpr std::size_t kTokenMin = 16;
/// Messages that are read at a time, between two looks at the watchers.
constexpr int kMessagesAtATime = 2000;

void Define(Command& app, Flags& f) {
  app.Option("log", f.logs, "logs that are being written (default: the LCM bus)");
  app.Option("--room", f.room, "which room, if there are several");
  app.Option("--port", f.port, "of the page, on this machine only; 0: any that is free (8080)")
      .Range(0, 65535);
  app.Option("--lcm-url", f.lcm_url, "the bus (LCM_DEFAULT_URL)");
  app.Option(
      "--drive", f.drive,
      "let the page drive this player: a line DRIVE LIFT BUTTONS on standard output for each "
      "change, for seam-client --inputs -");
  app.Option(
      "--control", f.control,
      "let the page change the room, and drag bodies: the address that seam-server --control "
      "prints (-: a line of standard input)");
  app.Option("--token", f.token,
             "of the page's address, instead of a new one: - is a line of standard input, behind "
             "that of --control")
      .OneOf({"-"});
  app.Switch("--oracle", f.oracle,
             "simulate the session in one world beside it, and show each view's error against it");
  app.Switch("--quiet", f.quiet, "do not print the page's address");
}

/// Writes inputs for a client; without a reader there is nothing to do but go on showing.
void PrintInput(const Input& input) {
  const std::string line = InputLine(input) + '\n';
  (void)!write(1, line.data(), line.size());
}

/// Returns the way to the server's control door; nullptr: none. "-": its address is the first line
/// of standard input, which no list of processes shows.
std::unique_ptr<ControlLine> ControlOf(std::string address) {
  if (address.empty()) return nullptr;
  if (address == "-") std::getline(std::cin, address);
  return std::make_unique<ControlLine>(address);
}

/// Returns what a page needs to drive and to control; "": it may do neither.
std::string TokenOf(const Flags& f) {
  if (f.drive.empty() && f.control.empty()) return "";
  OsEntropy entropy;
  if (f.token.empty()) return SecretDigits(entropy);
  std::string token;
  std::getline(std::cin, token);
  if (token.size() < kTokenMin || !IsName(token)) {
    throw OperatorError("--token takes a line of 16 to 32 letters and digits on standard input");
  }
  return token;
}

/// Reads what has come to the logs; false when nothing has.
bool ReadLogs(LogTails* tails, LiveFeed* feed) {
  LogEvent event;
  for (int i = 0; i < kMessagesAtATime; ++i) {
    if (!tails->Next(&event)) return i > 0;
    feed->Add(event.channel, event.data);
  }
  feed->Prune();
  return true;
}

int Run(const Flags& f) {
  if (!f.room.empty() && !IsName(f.room)) {
    throw OperatorError("--room takes 1 to 32 letters, digits, - or _");
  }
  if (!f.drive.empty() && !IsName(f.drive)) {
    throw OperatorError("--drive takes the name of a player");
  }
  if (!f.logs.empty() && !f.lcm_url.empty()) {
    throw OperatorError("logs or the bus: --lcm-url does not go with a log");
  }
  LiveFeed feed(f.room, f.drive);
  if (f.oracle) feed.MeasureErrors();
  std::unique_ptr<LogTails> tails;
  std::unique_ptr<Bus> bus;
  if (f.logs.empty()) {
    bus = std::make_unique<Bus>(f.lcm_url);
    const std::string room = f.room.empty() ? "[^.]*" : f.room;
    bus->Subscribe("SEAM\\." + room + "\\..*",
                   [&feed](const std::string& channel, std::int64_t, ByteView message) {
                     feed.Add(channel, message);
                   });
  } else {
    tails = std::make_unique<LogTails>(f.logs);
  }
  HttpServer server(static_cast<std::uint16_t>(f.port));
  const std::unique_ptr<ControlLine> control = ControlOf(f.control);
  const std::string token = TokenOf(f);
  const auto command = [&](std::int64_t now_us, const std::string& line) {
    const Status done = control->Send(now_us, line);
    feed.ShowControl(control->state());
    return done;
  };
  ViewPage page(token, f.drive.empty() ? nullptr : std::function<void(const Input&)>(PrintInput),
                control == nullptr ? nullptr : ViewPage::Control(command));
  StopOnSignals();
  if (!f.quiet) {
    std::fprintf(stderr, "seam-view: http://127.0.0.1:%d/%s%s; Ctrl-C ends it\n", server.port(),
                 token.empty() ? "" : "?token=", token.c_str());
  }
  while (g_stop == 0) {
    const std::int64_t now = SteadyClockUs();
    bool more = false;
    if (tails != nullptr) more = ReadLogs(tails.get(), &feed);
    if (bus != nullptr) bus->Poll(0);
    // A log's past is read before the first page shows its present.
    if (!more || feed.begun()) feed.Flush(now);
    page.Tick(now);
    if (control != nullptr) {
      control->Tick(now);
      feed.ShowControl(control->state());
    }
    server.Poll(
        now, [&](const HttpRequest& request) { return page.Answer(now, request); },
        [&](std::uint64_t* place) { return feed.Next(place); });
    if (!more) server.Wait(kLogsUs, bus != nullptr ? bus->fd() : -1);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Flags flags;
  const ProgramText text{
      "seam-view", "seam-view: watch a running session in a browser on this machine",
      VersionLine("seam-view"),
      "examples:\n"
      "  seam-view                     the session on the LCM bus\n"
      "  seam-view --room main --port 8081\n"
      "  seam-view session.lcm         a log that is being written\n"
      "  seam-view --drive ann | seam-client 127.0.0.1:7777 --name ann --inputs -\n"
      "  seam-view --control 'http://127.0.0.1:9465/control?token=...'"};
  return RunCommandLine(
      text, argc, argv, [&](Command& app) { Define(app, flags); }, [&] { return Run(flags); });
}
