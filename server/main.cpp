/// seam-server: one room or several over UDP. `seam-server --help`.

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>

#include "common/base/command_line.h"
#include "common/base/find_scene.h"
#include "common/base/hex.h"
#include "common/base/plain_file.h"
#include "common/base/process.h"
#include "common/base/progress_line.h"
#include "common/codec/version_line.h"
#include "common/net/impair.h"
#include "common/net/secret_file.h"
#include "common/net/udp.h"
#include "common/record/doctor.h"
#include "common/sync/method.h"
#include "server/fleet/agones.h"
#include "server/fleet/fleet_host.h"
#include "server/fleet/room_plans.h"
#include "server/hub/hub.h"
#include "server/hub/hub_door.h"
#include "server/hub/progress.h"
#include "server/metrics_page.h"
#include "server/server_flags.h"

namespace {

using namespace seam;
using Flags = ServerFlags;

/// Returns the key with which logs are sealed; nullptr: none.
std::shared_ptr<const Secret> KeyOfLogs(const Flags& f) {
  if (f.log_key.empty()) return nullptr;
  return std::make_shared<const Secret>(ReadSecretFile("--log-key", f.log_key));
}

/// Describes the end of the session for people.
std::string Ending(const RoomPlan& plan) {
  if (plan.last_tick == 0) return "; Ctrl-C ends it";
  const std::int64_t tick = plan.resumed == nullptr ? 0 : plan.resumed->tick();
  const auto ticks = static_cast<double>(std::max<std::int64_t>(0, plan.last_tick - tick));
  char text[80];
  std::snprintf(text, sizeof text, "; then %g s (--duration 0: until Ctrl-C)",
                ticks / plan.scene.solver.tick_hz);
  return text;
}

/// Notes in a folder of kept rooms that they demand tokens. Throws OperatorError if they do and no
/// key is given: a slip would open them to anybody.
void KeepTokenRule(const std::string& folder, bool demands) {
  const std::string mark = folder + "/tokens";
  const bool demanded = access(mark.c_str(), F_OK) == 0;
  if (demanded && !demands) {
    throw OperatorError("the rooms in " + folder + " demand tokens: --token-key FILE (or remove " +
                        mark + ": then anybody may join)");
  }
  if (demands && !demanded) {
    std::ofstream(mark) << "--token-key was given: see docs/persistence.md\n";
  }
}

/// The same for all rooms of the server.
struct Shared {
  std::shared_ptr<const KeyPair> identity;
  std::shared_ptr<const Secret> token_key, log_key;
  std::vector<std::shared_ptr<SessionWriter>> writers;

  void GiveTo(RoomPlan* plan) const {
    plan->config.identity = identity;
    plan->config.token_key = token_key;
    plan->log_key = log_key;
    plan->writers = writers;
  }
};

Shared MakeShared(const Flags& f) {
  Shared shared;
  OsEntropy entropy;
  // A kept room's clients give the keys of their places to the same server alone.
  const std::string folder = f.state.empty() ? f.resume : f.state;
  if (!folder.empty()) KeepTokenRule(folder, !f.token_key.empty());
  std::string file = f.identity;
  if (file.empty() && !folder.empty()) file = folder + "/identity";
  if (!f.resume.empty() && access(file.c_str(), F_OK) != 0) {
    PrintError("seam-server", file + ": is missing, and is made anew: players lose their places");
  }
  shared.identity = std::make_shared<const KeyPair>(
      file.empty() ? Secret(entropy) : KeepSecretFile("--identity", file, entropy));
  shared.log_key = KeyOfLogs(f);
  if (!f.token_key.empty()) {
    shared.token_key = std::make_shared<const Secret>(ReadSecretFile("--token-key", f.token_key));
  }
  if (!f.store.empty()) {
    RequirePlainFile(f.store);
    shared.writers.push_back(WriteIntoStore(f.store));
  }
  if (!f.events.empty()) {
    RequirePlainFile(f.events);
    shared.writers.push_back(WriteEvents(f.events));
  }
  return shared;
}

/// Says what the server has.
void Announce(const Flags& f, const std::vector<RoomPlan>& plans, const Address& local,
              const KeyPair& identity) {
  const std::string key = ToHex(identity.open.data(), identity.open.size());
  if (plans.empty()) {
    std::fprintf(stderr, "seam-server: %s of fleet %s, on %s\nseam-server: its key is %s\n",
                 f.gateway ? "gateway" : "member", f.fleet.c_str(), ToString(local).c_str(),
                 key.c_str());
    return;
  }
  const int rooms = static_cast<int>(plans.size());
  const SyncConfig& sync = plans[0].config.sync;
  const std::string variant = VariantOf(NamesOf(sync));
  const std::string what = rooms == 1 ? plans[0].scene.name : std::to_string(rooms) + " rooms";
  std::fprintf(stderr,
               "seam-server: %s, mode %s%s%s, network %s, on %s\n"
               "seam-server: its key is %s\n"
               "seam-server: %s %d player(s)%s%s\n",
               what.c_str(), NamesOf(sync).mode.c_str(), variant.empty() ? "" : " ",
               variant.c_str(), plans[0].config.impair.c_str(), ToString(local).c_str(),
               key.c_str(), f.resume.empty() ? "waiting for" : "goes on, waiting for",
               plans[0].config.wait_players, rooms == 1 ? "" : " in the first",
               Ending(plans[0]).c_str());
}

int Serve(const Flags& f) {
  CheckFleetFlags(f);
  UdpNet udp(ParseAddress(f.bind, static_cast<std::uint16_t>(f.port)));
  // The thread of the member makes plans too.
  std::shared_ptr<const Shared> shared;
  std::unique_ptr<FleetMember> member;
  const bool fleet = !f.directory.empty();
  const auto prepare = [&](const std::string& room, std::int32_t epoch,
                           std::unique_ptr<FollowedRoom> followed) {
    RoomPlan plan = followed != nullptr
                        ? PlanOfFollowed(f, room, epoch, *followed)
                        : PlanOfResumed(f, shared->log_key.get(), room, 0, 2, epoch);
    shared->GiveTo(&plan);
    return plan;
  };
  if (fleet) {
    FleetMember::Config config = MemberOf(f, udp.local());
    config.log_key = KeyOfLogs(f);
    member = std::make_unique<FleetMember>(config, prepare);
  }
  PrepareFolders(f);
  std::vector<std::string> left_out;
  std::vector<RoomPlan> plans = MakePlans(f, KeyOfLogs(f).get(), member.get(), &left_out);
  for (const std::string& line : left_out) {
    PrintError("seam-server", line + "; the other rooms go on");
  }
  if (!f.summary.empty()) RequireOutput(f.summary, f.force, f.scenes);
  shared = std::make_shared<const Shared>(MakeShared(f));
  for (RoomPlan& plan : plans) {
    shared->GiveTo(&plan);
    plan.alone = plan.alone && !fleet;
  }
  const int rooms = static_cast<int>(plans.size());
  if (f.workers > 0 && rooms == 1 && !fleet) {
    throw OperatorError("--workers: one room has one thread");
  }
  MetricsPage page(f);
  if (fleet) member->Start();  // it keeps the lease while the rooms are opened
  Hub hub(plans, udp, shared->identity, shared->token_key);
  std::unique_ptr<HubDoor> door;
  if (f.control_port >= 0) {
    door = std::make_unique<HubDoor>(static_cast<std::uint16_t>(f.control_port), hub);
  }
  StopOnSignals();
  const int workers = f.workers > 0 ? f.workers : CoreCount();
  if (rooms > 1 || fleet) hub.Start(fleet ? workers : std::min(workers, rooms));
  Announce(f, plans, udp.local(), *shared->identity);
  if (door != nullptr) {
    std::fprintf(stderr, "seam-server: control at %s\n", door->address().c_str());
  }
  if (fleet) {
    hub.SetElsewhere([&](const JoinRequest& join) {
      return member->Find({join.room, join.name, static_cast<std::uint64_t>(join.place_key),
                           join.epoch, join.epoch_proved});
    });
  }
  const std::unique_ptr<Agones> agones = f.agones ? std::make_unique<Agones>() : nullptr;
  ProgressLine line(f.quiet);
  while (g_stop == 0 && (fleet || !hub.done())) {
    const std::int64_t now = SteadyClockUs();
    hub.Poll(now);
    if (fleet) FollowFleet(*member, hub);
    if (door != nullptr) door->Poll(now);
    page.Poll(now, hub, member.get());
    std::vector<std::string> lines = hub.TakeReports();
    if (agones != nullptr) agones->Poll(now, hub, &lines);
    for (const std::string& news : lines) {
      line.End();
      PrintError("seam-server", news);
    }
    if (line.Due(now) && HasReport(hub)) line.Show(now, HubProgress(hub));
    hub.Wait();
  }
  line.End();
  if (g_stop != 0 && !f.drain_to.empty()) DrainRooms(f, member.get(), hub);
  hub.Close();
  member.reset();
  for (const auto& writer : shared->writers) writer->Finish();
  return std::max(ReportEnd(hub, f.summary), left_out.empty() ? 0 : 1);
}

}  // namespace

int main(int argc, char** argv) {
  Flags flags;
  const ProgramText text{
      "seam-server",
      "seam-server: rooms of a distributed 2D world, over UDP and the LCM bus",
      VersionLine("seam-server"),
      ProfilesText(),
      {{"scene", SceneNames()}, {"--impair", ProfileNames()}, {"--reconcile", ReconcilerNames()}}};
  return RunCommandLine(
      text, argc, argv, [&](Command& app) { DefineServerFlags(app, flags); },
      [&] {
        if (!flags.doctor) return Serve(flags);
        const DoctorReport report = RunDoctor(flags.lcm_url);
        for (const std::string& line : report.lines) std::printf("%s\n", line.c_str());
        return report.healthy ? 0 : 1;
      });
}
