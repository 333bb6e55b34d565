/// seam-server: one room or several over UDP. `seam-server --help`.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "common/base/command_line.h"
#include "common/base/find_scene.h"
#include "common/base/hex.h"
#include "common/base/limits.h"
#include "common/base/names.h"
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
#include "server/hub/hub.h"
#include "server/hub/hub_door.h"
#include "server/hub/progress.h"
#include "server/metrics_page.h"
#include "server/saved/old_segments.h"
#include "server/saved/resumed_room.h"
#include "server/server_flags.h"

namespace {

using namespace seam;
using Flags = ServerFlags;

/// Returns the key with which logs are sealed; nullptr: none.
std::shared_ptr<const Secret> KeyOfLogs(const Flags& f) {
  if (f.log_key.empty()) return nullptr;
  return std::make_shared<const Secret>(ReadSecretFile("--log-key", f.log_key));
}

void CheckRoomName(const std::string& room, int rooms) {
  const bool good = IsName(RoomName(room, rooms - 1, rooms)) && IsName(room);
  if (!good) throw OperatorError("--room takes 1 to 32 letters, digits, - or _");
}

/// Returns the tick to stop after; 0: none. At least one tick for any positive duration.
std::int64_t LastTick(double duration_s, int tick_hz) {
  if (std::isnan(duration_s)) throw OperatorError("--duration must be a number of seconds");
  if (duration_s <= 0) return 0;
  return std::max<std::int64_t>(1, std::llround(duration_s * tick_hz));
}

double DurationOf(const Flags& f, const Scene& scene) {
  return f.duration_s < 0 ? scene.duration_s : f.duration_s;
}

/// Describes the end of the session for people.
std::string Ending(double duration_s) {
  if (duration_s <= 0) return "; Ctrl-C ends it";
  char text[80];
  std::snprintf(text, sizeof text, "; then %g s (--duration 0: until Ctrl-C)", duration_s);
  return text;
}

/// Returns the number of players that tick 0 waits for.
int PlayersToWaitFor(const Flags& f, const std::string& name, const Scene& scene) {
  const int players = static_cast<int>(scene.players.size());
  if (f.wait > players) {
    throw OperatorError("--wait " + std::to_string(f.wait) + ": " + name + " has " +
                        std::to_string(players) + " player(s), so the room would never start");
  }
  return f.wait >= 0 ? f.wait : players;
}

/// Returns the name of a room's log: "out/log.lcm" for one room, "out/log.main-1.lcm" for several.
std::string LogOf(const std::string& record, const std::string& room, int rooms) {
  if (record.empty() || rooms == 1) return record;
  const std::string ending = ".lcm";
  const bool has = record.size() > ending.size() &&
                   record.compare(record.size() - ending.size(), ending.size(), ending) == 0;
  const std::string stem = has ? record.substr(0, record.size() - ending.size()) : record;
  return stem + "." + room + ending;
}

/// The values of flags that are not given.
const ServerFlags kNotGiven;

/// Sets what is the same for new and resumed rooms. Requires the scene and the room's name.
void FinishPlan(const Flags& f, const std::string& impair, int index, int rooms, RoomPlan* plan) {
  plan->config.impair = impair;
  plan->config.publish = ParsePublish(f.publish);
  plan->config.trust = ParseTrustMode(f.trust);
  if (!f.budget.empty()) plan->config.client_bytes_per_s = ParseBudget(f.budget);
  plan->last_tick = LastTick(DurationOf(f, plan->scene), plan->scene.solver.tick_hz);
  plan->profile = FindProfile(impair);
  const bool on_bus = rooms == 1 || f.bus_rooms == "all" || (f.bus_rooms == "first" && index == 0);
  plan->lcm_url = on_bus ? f.lcm_url : "none";
  plan->alone = rooms == 1;
  plan->control = f.control_port >= 0;
  if (plan->control && (rooms > 1 || !f.directory.empty())) {
    throw OperatorError("--control: one room, and no --directory");
  }
  plan->news = !f.quiet;
  const bool kept = !f.state.empty() || !f.resume.empty();
  if (!kept && (!f.keep.empty() || f.segment_mb != kNotGiven.segment_mb))
    throw OperatorError("--segment-mb and --keep are of the logs of --state and --resume");
  if (kept) plan->segment_bytes = std::llround(f.segment_mb * 1024 * 1024);
  if (!f.keep.empty()) plan->keep_s = ParseKeep(f.keep);
}

/// Refuses flags that say what the folder of --resume says.
void CheckResume(const Flags& f) {
  const bool settles = !f.scenes.empty() || f.mode != kNotGiven.mode || !f.reconcile.empty() ||
                       !f.predict.empty() || f.input_delay_ticks >= 0 || f.rooms > 0;
  if (settles || !f.record.empty() || !f.state.empty()) {
    throw OperatorError(
        "--resume takes the scene, the method, the rooms and their logs from its folder: not with "
        "a scene, --mode, --reconcile, --predict, --input-delay, --rooms, --record or --state");
  }
}

RoomPlan PlanOfResumed(const Flags& f, const Secret* log_key, const std::string& name, int index,
                       int rooms, std::int32_t epoch = 0) {
  auto resumed = std::make_shared<ResumedRoom>(ReadResumedRoom(f.resume, name, log_key, epoch));
  const Room& room = resumed->saved->room();
  RoomPlan plan;
  plan.scene = resumed->saved->scene();
  ServerConfig& config = plan.config;
  config.sync = MakeSyncConfig(MethodNames{room.mode, room.reconcile, room.predict});
  config.sync.input_delay_ticks = room.input_delay_ticks;
  config.sync.tick_hz = room.tick_hz;
  config.sync.send_hz = room.send_hz;
  config.sync.seed = config.seed = room.seed;
  config.room = name;
  config.epoch = resumed->epoch;
  FinishPlan(f, f.impair == kNotGiven.impair ? room.impair : f.impair, index, rooms, &plan);
  plan.state = f.resume;
  plan.record = resumed->log;
  plan.resumed = std::move(resumed);
  return plan;
}

RoomPlan MakePlan(const Flags& f, const std::string& scene_name, int index, int rooms,
                  FleetMember* member) {
  RoomPlan plan;
  plan.scene = LoadScene(FindScene(scene_name));
  const Scene& scene = plan.scene;
  ServerConfig& config = plan.config;
  config.sync = MakeSyncConfig(MethodNames{f.mode, f.reconcile, f.predict});
  config.sync.input_delay_ticks = f.input_delay_ticks >= 0
                                      ? f.input_delay_ticks
                                      : config.sync.policy->InputDelay(scene.input_delay_ticks);
  config.sync.tick_hz = scene.solver.tick_hz;
  config.sync.send_hz = std::min(f.send_hz, scene.solver.tick_hz);
  config.sync.seed = f.seed + index;
  config.room = RoomName(f.room, index, rooms);
  config.seed = f.seed + index;
  config.wait_players = PlayersToWaitFor(f, scene_name, scene);
  FinishPlan(f, f.impair, index, rooms, &plan);
  if (member != nullptr) config.epoch = member->Claim(config.room, 1);
  plan.force = f.force;
  plan.record = LogOf(f.record, config.room, rooms);
  if (!f.state.empty()) {
    if (!f.record.empty()) throw OperatorError("--state records the room: not with --record");
    if (!config.sync.policy->SendsStates()) {
      throw OperatorError("--state: a room of mode " + f.mode + " cannot be resumed");
    }
    PrepareStateFolder(f.state, config.room, f.force);
    plan.state = f.state;
    plan.record = StateLogOf(f.state, config.room, config.epoch);
  }
  if (!plan.record.empty()) RequireOutput(plan.record, plan.force, {FindScene(scene_name)});
  return plan;
}

std::vector<RoomPlan> MakePlans(const Flags& f, const Secret* log_key, FleetMember* member) {
  std::vector<RoomPlan> plans;
  if (f.gateway) return plans;
  if (!f.resume.empty()) {
    CheckResume(f);
    const std::vector<std::string> names = RoomsIn(f.resume, member != nullptr);
    const int rooms = static_cast<int>(names.size());
    for (int r = 0; r < rooms; ++r) {
      const std::string& name = names[static_cast<std::size_t>(r)];
      if (member != nullptr && member->Knows(name)) continue;  // its thread takes it over
      plans.push_back(PlanOfResumed(f, log_key, name, r, rooms));
      if (member == nullptr) continue;
      const std::int32_t epoch = member->Claim(name, plans.back().config.epoch + 1);
      plans.back() = PlanOfResumed(f, log_key, name, r, rooms, epoch);
    }
    return plans;
  }
  if (f.scenes.empty()) throw OperatorError(WhichScene());
  const int rooms = f.rooms > 0 ? f.rooms : static_cast<int>(f.scenes.size());
  CheckRoomName(f.room, rooms);
  for (int r = 0; r < rooms; ++r) {
    const std::string& scene = f.scenes[static_cast<std::size_t>(r) % f.scenes.size()];
    plans.push_back(MakePlan(f, scene, r, rooms, member));
  }
  return plans;
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
  std::string file = f.identity;
  if (file.empty() && !folder.empty()) file = folder + "/identity";
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
               Ending(DurationOf(f, plans[0].scene)).c_str());
}

int Serve(const Flags& f) {
  CheckFleetFlags(f);
  UdpNet udp(ParseAddress(f.bind, static_cast<std::uint16_t>(f.port)));
  std::unique_ptr<FleetMember> member;
  const bool fleet = !f.directory.empty();
  // The thread of the member makes plans too.
  std::shared_ptr<const Shared> shared;
  const auto prepare = [&](const std::string& room, std::int32_t epoch) {
    RoomPlan plan = PlanOfResumed(f, shared->log_key.get(), room, 0, 2, epoch);
    shared->GiveTo(&plan);
    return plan;
  };
  if (fleet) member = std::make_unique<FleetMember>(MemberOf(f, udp.local()), prepare);
  PrepareFolders(f);
  std::vector<RoomPlan> plans = MakePlans(f, KeyOfLogs(f).get(), member.get());
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
  Hub hub(plans, udp, shared->identity);
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
    hub.SetElsewhere([&](const std::string& room) { return member->Find(room); });
    member->Start();
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
  return ReportEnd(hub, f.summary);
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
