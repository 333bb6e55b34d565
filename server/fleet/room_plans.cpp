#include "server/fleet/room_plans.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "common/base/check.h"
#include "common/base/find_scene.h"
#include "common/base/names.h"
#include "common/base/plain_file.h"
#include "common/base/process.h"
#include "common/net/impair.h"
#include "common/record/recording.h"
#include "common/sync/method.h"
#include "server/saved/old_segments.h"
#include "server/saved/resumed_room.h"
#include "server/saved/snapshot_file.h"
#include "server/saved/trial_load.h"

namespace seam {
namespace {

using Flags = ServerFlags;

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
  const double duration_s = f.duration_s < 0 ? plan->scene.duration_s : f.duration_s;
  plan->last_tick = LastTick(duration_s, plan->scene.solver.tick_hz);
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

RoomPlan MakePlan(const Flags& f, const std::string& scene_name, int index, int rooms) {
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
  plan.force = f.force;
  plan.record = LogOf(f.record, config.room, rooms);
  if (f.state.empty()) return plan;
  if (!f.record.empty()) throw OperatorError("--state records the room: not with --record");
  if (!config.sync.policy->SendsStates()) {
    throw OperatorError("--state: a room of mode " + f.mode + " cannot be resumed");
  }
  plan.state = f.state;
  return plan;
}

/// Chooses and checks the files of a room, whose epoch is known.
void PrepareFiles(const std::string& scene_name, RoomPlan* plan) {
  const ServerConfig& config = plan->config;
  if (!plan->state.empty()) {
    PrepareStateFolder(plan->state, config.room, plan->force);
    plan->record = StateLogOf(plan->state, config.room, config.epoch);
  }
  if (!plan->record.empty()) RequireOutput(plan->record, plan->force, {FindScene(scene_name)});
}

/// A kept room that still waited for its players has no snapshot: it begins anew, with the scene
/// and the method of its log, which is put aside.
RoomPlan PlanOfUnbegun(const Flags& f, const Room& room, const std::string& name, int index,
                       int rooms) {
  RoomPlan plan;
  plan.scene = ParseScene(room.scene_text, room.scene_name);
  plan.config = ConfigOf(room);
  plan.config.room = name;
  plan.config.wait_players = PlayersToWaitFor(f, room.scene_name, plan.scene);
  FinishPlan(f, f.impair == kNotGiven.impair ? room.impair : f.impair, index, rooms, &plan);
  PrepareStateFolder(f.resume, name, false);
  plan.state = f.resume;
  plan.record = StateLogOf(f.resume, name);
  return plan;
}

}  // namespace

namespace {

RoomPlan PlanOf(const Flags& f, const std::string& name, int index, int rooms,
                std::shared_ptr<ResumedRoom> resumed) {
  const Room& room = resumed->saved->room();
  RoomPlan plan;
  plan.scene = resumed->saved->scene();
  ServerConfig& config = plan.config;
  config = ConfigOf(room);
  config.room = name;
  config.epoch = resumed->epoch;
  FinishPlan(f, f.impair == kNotGiven.impair ? room.impair : f.impair, index, rooms, &plan);
  if (plan.last_tick != 0 && plan.last_tick <= resumed->tick()) {
    if (f.duration_s < 0) {
      plan.last_tick = 0;  // it had another duration than the scene's, which nobody knows now
    } else {
      resumed->notes.push_back("room " + name + " is over: it is " +
                               std::to_string(resumed->tick() / plan.scene.solver.tick_hz) +
                               " s old, and --duration counts from its tick 0");
    }
  }
  plan.state = f.resume;
  plan.record = resumed->log;
  plan.resumed = std::move(resumed);
  return plan;
}

}  // namespace

RoomPlan PlanOfResumed(const Flags& f, const Secret* log_key, const std::string& name, int index,
                       int rooms, std::int32_t epoch) {
  return PlanOf(f, name, index, rooms,
                std::make_shared<ResumedRoom>(ReadResumedRoom(f.resume, name, log_key, epoch)));
}

RoomPlan PlanOfFollowed(const Flags& f, const std::string& name, std::int32_t epoch,
                        FollowedRoom& followed) {
  return PlanOf(f, name, 0, 2, followed.Finish(SteadyClockUs(), epoch));
}

namespace {

RoomPlan PlanOfKept(const Flags& f, const Secret* log_key, const std::string& name, int index,
                    int rooms, FleetMember* member) {
  if (ListSnapshots(f.resume, name).empty() && member == nullptr) {
    const Recording log = ReadRecording(StateLogOf(f.resume, name), name);
    if (log.last_tick <= 0) return PlanOfUnbegun(f, log.room, name, index, rooms);
  }
  RoomPlan plan = PlanOfResumed(f, log_key, name, index, rooms);
  if (member == nullptr) return plan;
  const std::int32_t epoch = member->Claim(name, plan.config.epoch + 1);
  return PlanOfResumed(f, log_key, name, index, rooms, epoch);
}

}  // namespace

std::vector<RoomPlan> MakePlans(const Flags& f, const Secret* log_key, FleetMember* member,
                                std::vector<std::string>* left_out) {
  std::vector<RoomPlan> plans;
  if (f.gateway) return plans;
  if (!f.resume.empty()) {
    CheckResume(f);
    const std::vector<std::string> names = RoomsIn(f.resume, member != nullptr);
    const int rooms = static_cast<int>(names.size());
    for (int r = 0; r < rooms; ++r) {
      const std::string& name = names[static_cast<std::size_t>(r)];
      if (member != nullptr && member->Knows(name)) continue;  // its thread takes it over
      try {
        plans.push_back(PlanOfKept(f, log_key, name, r, rooms, member));
      } catch (const OperatorError& error) {
        left_out->push_back(error.what());
      }
    }
    if (left_out->size() == names.size() && !names.empty()) throw OperatorError(left_out->front());
    return plans;
  }
  if (f.scenes.empty()) throw OperatorError(WhichScene());
  const int rooms = f.rooms > 0 ? f.rooms : static_cast<int>(f.scenes.size());
  CheckRoomName(f.room, rooms);
  const auto scene_of = [&f](int r) {
    return f.scenes[static_cast<std::size_t>(r) % f.scenes.size()];
  };
  std::vector<std::string> names;
  for (int r = 0; r < rooms; ++r) {
    plans.push_back(MakePlan(f, scene_of(r), r, rooms));
    names.push_back(plans.back().config.room);
  }
  std::vector<std::int32_t> epochs(names.size(), 1);
  if (member != nullptr) epochs = member->ClaimAll(names, 1);
  for (int r = 0; r < rooms; ++r) {
    RoomPlan& plan = plans[static_cast<std::size_t>(r)];
    plan.config.epoch = epochs[static_cast<std::size_t>(r)];
    PrepareFiles(scene_of(r), &plan);
  }
  return plans;
}

}  // namespace seam
