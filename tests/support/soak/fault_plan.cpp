#include "tests/support/soak/fault_plan.h"

#include <algorithm>
#include <cstdio>
#include <sstream>

#include "common/base/random.h"
#include "common/scene/scene.h"

namespace seam {
namespace {

/// Faults begin this long after tick 0, s.
constexpr double kFirstSeconds = 1;
/// From the end of a client's fault to its next: mean, s, besides the least.
constexpr double kBetweenSeconds = 4, kBetweenSecondsMin = 0.3;

struct Named {
  const char *mode, *reconcile, *predict;
};
/// The default four times: most sessions use it.
constexpr Named kMethods[] = {{"buffer", "rollback", ""}, {"buffer", "rollback", ""},
                              {"buffer", "rollback", ""}, {"buffer", "retrospect", ""},
                              {"buffer", "rollback", ""}, {"buffer", "fade", ""},
                              {"central", "", "all"},     {"strict", "", ""}};

int Between(Random* random, int low, int high) {  // both included
  return low + static_cast<int>(random->Next() % static_cast<std::uint64_t>(high - low + 1));
}

std::string DrawNetwork(Random* random) {
  char spec[160];
  const int delay = Between(random, 5, 120), jitter = Between(random, 0, 20);
  const int loss = Between(random, 0, 30), reorder = Between(random, 0, 8);
  const int duplicate = Between(random, 0, 5);
  std::snprintf(spec, sizeof spec,
                "delay=%dms,jitter=%dms,loss=%d%%,reorder=%d%%:30ms,duplicate=%d%%", delay, jitter,
                loss, reorder, duplicate);
  return spec;
}

Fault DrawFault(Random* random, int client, double from_s) {
  Fault fault;
  fault.client = client;
  fault.from_s = from_s;
  fault.kind = static_cast<FaultKind>(Between(random, 0, 4));
  switch (fault.kind) {
    case FaultKind::kCut: fault.to_s = from_s + random->Uniform(0.3, 5); break;
    case FaultKind::kPause:
      fault.to_s = from_s + (random->Chance(0.5) ? 5 : random->Uniform(0.2, 6));
      break;
    case FaultKind::kSlowed:
      fault.to_s = from_s + random->Uniform(1, 6);
      fault.every_us = 1000 * Between(random, 25, 250);
      break;
    case FaultKind::kKill:
    case FaultKind::kLeave: fault.to_s = from_s + random->Uniform(0.05, 7); break;
    case FaultKind::kMove:
    case FaultKind::kServer: break;  // AddServerFaults
  }
  return fault;
}

/// A scene's text without its players' regions: authority then follows distance.
std::string WithoutRegions(const std::string& text) {
  std::istringstream in(text);
  std::string line, without;
  while (std::getline(in, line)) {
    if (line.rfind("region = ", 0) != 0) without += line + "\n";
  }
  return without;
}

/// Makes a room narrow. Returns a description of the drawn limits.
std::string Narrow(const Scene& scene, Random* random, ClusterConfig* config) {
  char text[160];
  const int parts = static_cast<int>(scene.parts.size());
  const int follow = random->Chance(0.5) ? 0 : Between(random, 0, parts);
  std::snprintf(text, sizeof text, "follow = %d\nserver_follow = %d\n", follow, follow);
  config->scene_text = text + scene.text;
  std::string drawn = ", follows " + std::to_string(follow);
  const bool regions = std::any_of(scene.players.begin(), scene.players.end(),
                                   [](const Player& player) { return player.has_region; });
  if (regions && random->Chance(0.7)) {
    config->scene_text = text + WithoutRegions(scene.text);
    drawn += ", no regions";
  }
  if (random->Chance(0.4)) {
    const int kilobytes = Between(random, 8, 60);
    config->client_bytes_per_s = 1000.0 * kilobytes;
    drawn += ", " + std::to_string(kilobytes) + " kB/s";
  }
  return drawn;
}

}  // namespace

const char* ToString(FaultKind kind) {
  switch (kind) {
    case FaultKind::kCut: return "cut";
    case FaultKind::kPause: return "paused";
    case FaultKind::kSlowed: return "slow";
    case FaultKind::kKill: return "killed";
    case FaultKind::kLeave: return "away";
    case FaultKind::kMove: return "moved";
    case FaultKind::kServer: return "server killed";
  }
  return "";
}

void AddServerFaults(std::uint64_t seed, double seconds, FaultPlan* plan) {
  Random random = Random(seed).Fork(3);
  const double last_s = seconds - kCalmSeconds;
  double at = kFirstSeconds;
  int kills = 0, moves = 0;
  while ((at += 1 + random.Exponential(kBetweenSeconds * 2)) < last_s) {
    Fault fault;
    fault.kind = FaultKind::kServer;
    fault.client = -1;
    fault.from_s = fault.to_s = at;
    fault.every_us = 1000 * Between(&random, 50, 3000);
    plan->faults.push_back(fault);
    ++kills;
  }
  const int clients = plan->config.players + plan->config.spectators;
  for (int client = 0; client < clients; ++client) {
    if (!random.Chance(0.5)) continue;
    Fault fault;
    fault.kind = FaultKind::kMove;
    fault.client = client;
    fault.from_s = fault.to_s = random.Uniform(kFirstSeconds, last_s);
    plan->faults.push_back(fault);
    ++moves;
  }
  std::stable_sort(plan->faults.begin(), plan->faults.end(),
                   [](const Fault& a, const Fault& b) { return a.from_s < b.from_s; });
  plan->name += ", " + std::to_string(kills) + " deaths of the server, " + std::to_string(moves) +
                " new addresses";
}

FaultPlan DrawFaults(std::uint64_t seed, const FaultChoice& choice) {
  Random random = Random(seed).Fork(1);
  FaultPlan plan;
  ClusterConfig& config = plan.config;
  config.scene = choice.scenes[random.Next() % choice.scenes.size()];
  const Named& method = kMethods[random.Next() % std::size(kMethods)];
  config.mode = method.mode;
  config.reconcile = method.reconcile;
  config.predict = method.predict;
  config.impair = DrawNetwork(&random);
  config.drive = random.Chance(0.5) ? Drive::kBot : Drive::kScript;
  config.seed = static_cast<std::int64_t>(seed);
  config.duration_s = choice.seconds;
  config.spectators = random.Chance(0.3) ? 1 : 0;
  config.keep = false;
  const Scene scene = LoadScene("scenes/" + config.scene + ".toml");
  config.players = std::min(static_cast<int>(scene.players.size()), choice.players);
  const int clients = config.players + config.spectators;
  for (int client = 0; client < clients; ++client) {
    double at = kFirstSeconds;
    while (true) {
      at += kBetweenSecondsMin + random.Exponential(kBetweenSeconds);
      const Fault fault = DrawFault(&random, client, at);
      at = fault.to_s;
      if (at > choice.seconds - kCalmSeconds) break;
      plan.faults.push_back(fault);
    }
  }
  std::stable_sort(plan.faults.begin(), plan.faults.end(),
                   [](const Fault& a, const Fault& b) { return a.from_s < b.from_s; });
  Random other = Random(seed).Fork(2);
  const std::string narrow =
      choice.narrow && other.Chance(0.5) ? Narrow(scene, &other, &config) : "";
  plan.name = "seed " + std::to_string(seed) + ": " + config.scene + " " + config.mode + " " +
              config.reconcile + config.predict +
              (config.drive == Drive::kBot ? " bots " : " script ") + config.impair + narrow +
              ", " + std::to_string(clients) + " clients, " + std::to_string(plan.faults.size()) +
              " faults";
  return plan;
}

}  // namespace seam
