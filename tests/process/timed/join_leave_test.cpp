/// Clients join, leave, vanish and steer, with real processes.

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <set>

#include "tests/support/in_namespace.h"
#include "tests/support/live_session.h"

namespace seam {
namespace join_leave_test {

constexpr std::int64_t kHz = 60;
/// The longest that anything is waited for, s: normally under 5; a busy machine takes its time.
constexpr double kPatience = 60;

/// A car that stands still until somebody drives it.
constexpr const char* kParkedCar = R"(title = "A parked car"
[[player]]
name = "ann"
vehicle = "car"
[[part]]
name = "ground"
chain = [[-300, 0], [300, 0]]
friction = 0.9
[[part]]
name = "car"
box = [3, 0.6]
position = [0, 0.9]
owner = "ann"
[[part]]
name = "rear"
circle = 0.4
position = [-1, 0.41]
friction = 0.9
[[part]]
name = "front"
circle = 0.4
position = [1, 0.41]
friction = 0.9
[[joint]]
name = "rear-axle"
kind = "wheel"
a = "car"
b = "rear"
motor = {player = "ann", speed = -30, torque = 20}
[[joint]]
name = "front-axle"
kind = "wheel"
a = "car"
b = "front"
motor = {player = "ann", speed = -30, torque = 20}
)";

class JoinLeave : public InNamespace {
 protected:
  SessionPlan Plan(const std::string& name) const {
    SessionPlan plan;
    plan.name = name;
    return plan;
  }
  Workspace folder_;
};

bool Says(const Recording& recording, const std::string& text) {
  return FindEvent(recording, text) >= 0;
}

/// The tick of the first event that contains `text`.
std::int64_t TickOf(const Recording& recording, const std::string& text) {
  const int event = FindEvent(recording, text);
  return event < 0 ? -1 : recording.events[static_cast<std::size_t>(event)].tick;
}

/// True if `peer` has published a view after `tick`.
bool ShowsAfter(const Recording& recording, int peer, std::int64_t tick) {
  const auto views = recording.views.find(peer);
  return views != recording.views.end() && views->second.upper_bound(tick) != views->second.end();
}

TEST_F(JoinLeave, SigintAndSigtermEndServerAndClientsWithStatus0AndAreNoticed) {
  SEAM_INSIDE_ONLY();
  // Bob leaves by one signal, then the server by the other. Bob's last messages are delayed by his
  // simulated network, and his goodbye must pass it.
  const std::pair<int, int> kSignals[] = {{SIGINT, SIGTERM}, {SIGTERM, SIGINT}};
  std::vector<std::unique_ptr<LiveSession>> sessions;
  for (const auto& [first, second] : kSignals) {
    SessionPlan plan = Plan("signal" + std::to_string(first));
    plan.clients = {{"ann", {"--drive", "bot"}}, {"bob", {"--drive", "bot", "--impair", "demo"}}};
    sessions.push_back(
        std::make_unique<LiveSession>(folder_, static_cast<int>(sessions.size()), plan));
  }
  for (auto& session : sessions) ASSERT_TRUE(session->Begin()) << session->Story();
  for (std::size_t i = 0; i < sessions.size(); ++i) {
    LiveSession& session = *sessions[i];
    SCOPED_TRACE(session.Story());
    ASSERT_TRUE(
        session.WaitUntil([](const Recording& r) { return ShowsAfter(r, 2, 150); }, kPatience));
    session.client("bob").Signal(kSignals[i].first);
    EXPECT_TRUE(session.client("bob").Wait(kPatience));
    EXPECT_EQ(session.client("bob").status(), 0);
    EXPECT_NE(session.client("bob").errors().find("seam-client: left; "), std::string::npos);
    EXPECT_TRUE(session.WaitUntil(
        [](const Recording& r) { return Says(r, "bob (peer 2) is gone: left"); }, kPatience));
    session.server().Signal(kSignals[i].second);
    EXPECT_TRUE(session.Finish(kPatience));
    EXPECT_EQ(session.server().status(), 0);
    EXPECT_EQ(session.client("ann").status(), 0);
    EXPECT_NE(session.client("ann").errors().find("seam-client: the server closed the room; "),
              std::string::npos);
    for (Program* p : {&session.server(), &session.client("ann"), &session.client("bob")}) {
      EXPECT_EQ(p->output(), "");
    }
  }
  // The bots have driven, each in a way of its own.
  const Recording recording = sessions[0]->Captured();
  std::map<int, std::set<int>> drives;
  for (const auto& [player, messages] : recording.inputs) {
    for (const auto& [tick, inputs] : messages) {
      drives[player].insert(inputs.drive.begin(), inputs.drive.end());
    }
  }
  ASSERT_EQ(drives.size(), 2u);
  EXPECT_GE(drives[0].size(), 2u);
  EXPECT_GE(drives[1].size(), 2u);
}

/// The authority over each mechanism after the grants up to `tick`.
std::map<int, int> AuthorityAt(const Recording& recording, std::int64_t tick) {
  std::map<int, int> authority;
  std::map<int, int> epoch;
  for (const Grants& grants : recording.grants) {
    for (std::size_t i = 0; grants.tick <= tick && i < grants.mechanism.size(); ++i) {
      const int m = grants.mechanism[i];
      if (epoch.count(m) != 0 && grants.epoch[i] < epoch[m]) continue;
      epoch[m] = grants.epoch[i];
      authority[m] = grants.authority[i];
    }
  }
  return authority;
}

std::set<int> MechanismsOf(const Recording& recording, int peer, std::int64_t tick) {
  std::set<int> mechanisms;
  for (const auto& [mechanism, authority] : AuthorityAt(recording, tick)) {
    if (authority == peer) mechanisms.insert(mechanism);
  }
  return mechanisms;
}

TEST_F(JoinLeave, AKilledClientsMechanismsAreTakenBackAndGivenToItsSuccessor) {
  SEAM_INSIDE_ONLY();
  const std::vector<std::string> flags = {"--drive", "ann", "--quiet", "--key",
                                          folder_ / "ann.key"};
  SessionPlan plan = Plan("killed");
  plan.server_flags = {"--quiet"};
  plan.clients = {{"ann", flags}, {"bob", {"--quiet"}}};
  LiveSession session(folder_, 0, plan);
  ASSERT_TRUE(session.Begin()) << session.Story();
  ASSERT_TRUE(session.WaitUntil([](const Recording& r) { return ShowsAfter(r, 1, 60); }, kPatience))
      << session.Story();
  session.client("ann").Signal(SIGKILL);
  ASSERT_TRUE(session.client("ann").Wait(kPatience));
  Program impostor(
      {BuiltProgram("seam-client"), session.address(), "--name", "bob", "--lcm-url", "none"});
  const std::string gone = "ann (peer 1) is gone: not heard for 4 s";
  ASSERT_TRUE(session.WaitUntil(
      [&](const Recording& r) { return Says(r, gone) && MechanismsOf(r, 1, r.last_tick).empty(); },
      kPatience))
      << session.Story();
  EXPECT_TRUE(impostor.Wait(kPatience));
  EXPECT_EQ(impostor.status(), 2);
  EXPECT_EQ(impostor.errors(),
            "seam-client: the server refuses: the name bob is in use; no player is free\n");
  Recording seen = session.Captured();
  const std::int64_t killed = seen.views[1].rbegin()->first;
  const std::set<int> hers = MechanismsOf(seen, 1, killed);
  EXPECT_FALSE(hers.empty());
  const std::int64_t taken_back = TickOf(seen, gone);
  EXPECT_LE(taken_back, killed + 8 * kHz) << "normally 4 s; a busy machine is late itself";
  EXPECT_GE(taken_back, killed + 2 * kHz) << "patience with a path that stalls";
  for (const auto& [mechanism, authority] : AuthorityAt(seen, taken_back)) {
    EXPECT_EQ(authority, hers.count(mechanism) != 0 ? 0 : authority) << mechanism;
  }

  const auto has_them = [&](const Recording& r) {
    return MechanismsOf(r, 1, r.last_tick) == hers && ShowsAfter(r, 1, r.last_tick - 10);
  };
  session.Join("ann", flags);
  EXPECT_TRUE(session.WaitUntil(
      [&](const Recording& r) { return has_them(r) && ShowsAfter(r, 1, taken_back + 30); },
      kPatience))
      << session.Story();
  // And when she comes back before she is missed, while the dead one still has the place.
  session.client("ann").Signal(SIGKILL);
  ASSERT_TRUE(session.client("ann").Wait(kPatience));
  const std::int64_t again = session.Captured().last_tick;
  session.Join("ann", flags);
  EXPECT_TRUE(session.WaitUntil(
      [&](const Recording& r) {
        return Says(r, "replaced by a new session with its key") && has_them(r) &&
               ShowsAfter(r, 1, again + 2 * kHz);
      },
      kPatience))
      << session.Story();
  session.server().Signal(SIGTERM);
  EXPECT_TRUE(session.Finish(kPatience)) << session.Story();
  EXPECT_EQ(session.server().status(), 0);
  EXPECT_EQ(session.client("ann").status(), 0);
  EXPECT_EQ(session.client("bob").status(), 0);
}

/// The first player's inputs, by tick.
struct Driving {
  std::map<std::int64_t, int> drive;
  bool button = false;

  std::int64_t TicksOf(int value) const {
    return std::count_if(drive.begin(), drive.end(),
                         [&](const auto& entry) { return entry.second == value; });
  }
};

Driving Driven(const Recording& recording) {
  Driving driven;
  driven.drive[-1] = 0;
  const auto found = recording.inputs.find(0);
  if (found == recording.inputs.end()) return driven;
  for (const auto& [first, inputs] : found->second) {
    for (std::size_t i = 0; i < inputs.drive.size(); ++i) {
      driven.drive[first + static_cast<std::int64_t>(i)] = inputs.drive[i];
      driven.button = driven.button || inputs.buttons[i] == 1;
    }
  }
  return driven;
}

TEST_F(JoinLeave, ArrowKeysDriveTheCarAndQLeavesTheTerminalAsItWas) {
  SEAM_INSIDE_ONLY();
  PseudoTerminal terminal;
  if (!terminal.good()) GTEST_SKIP() << "no pseudo terminals here";
  folder_.Write("parked.toml", kParkedCar);
  SessionPlan plan = Plan("keys");
  plan.scene = folder_ / "parked.toml";
  plan.server_flags = {"--quiet"};
  LiveSession session(folder_, 0, plan);
  ASSERT_TRUE(session.Begin()) << session.Story();
  Program& ann = session.Join("ann", {"--drive", "keyboard", "--quiet"}, terminal.terminal());
  ASSERT_TRUE(session.WaitUntil([](const Recording& r) { return ShowsAfter(r, 1, 5); }, kPatience))
      << session.Story();
  EXPECT_FALSE(terminal.IsCooked());
  // Held down: a terminal repeats the key. Half of the arrows come in two pieces.
  const auto typed = [&](const std::string& key, bool in_two, const auto& enough) {
    for (int i = 0; i < 1200; ++i) {
      terminal.Type(in_two && i % 2 != 0 ? key.substr(0, 1) : key);
      if (in_two && i % 2 != 0) terminal.Type(key.substr(1));
      usleep(50000);
      if (enough(Driven(session.Captured()))) return true;
    }
    return false;
  };
  EXPECT_TRUE(typed("\033[C", true, [](const Driving& d) { return d.TicksOf(127) >= kHz; }));
  EXPECT_TRUE(session.WaitUntil(
      [](const Recording& r) { return Driven(r).drive.rbegin()->second == 0; }, kPatience))
      << "a key that is no longer repeated is released";
  EXPECT_TRUE(typed("a ", false, [](const Driving& d) { return d.TicksOf(-127) >= 3 && d.button; }))
      << "a letter, and the space bar";
  terminal.Type("q");
  EXPECT_TRUE(ann.Wait(kPatience));
  EXPECT_EQ(ann.status(), 0) << ann.Story();
  EXPECT_TRUE(terminal.IsCooked());
  session.server().Signal(SIGINT);
  EXPECT_TRUE(session.Finish(kPatience)) << session.Story();

  Recording recording = session.Captured();
  // In her own view the car was at rest and has moved to the right, as the server saw too.
  for (const int peer : {0, 1}) {
    const auto& views = recording.views[peer];
    EXPECT_LT(std::abs(views.begin()->second.x[0]), 0.1f);
    EXPECT_GT(views.rbegin()->second.x[0], 1.0f) << "of peer " << peer;
  }
}

TEST_F(JoinLeave, AClosedTerminalIsAGoodbye) {
  SEAM_INSIDE_ONLY();
  PseudoTerminal terminal;
  if (!terminal.good()) GTEST_SKIP() << "no pseudo terminals here";
  folder_.Write("parked.toml", kParkedCar);
  SessionPlan plan = Plan("closed");
  plan.scene = folder_ / "parked.toml";
  plan.server_flags = {"--quiet"};
  LiveSession session(folder_, 0, plan);
  ASSERT_TRUE(session.Begin()) << session.Story();
  Program& ann = session.Join("ann", {"--drive", "keyboard", "--quiet"}, terminal.terminal());
  ASSERT_TRUE(session.WaitUntil([](const Recording& r) { return ShowsAfter(r, 1, 5); }, kPatience))
      << session.Story();
  terminal.HangUp();
  EXPECT_TRUE(ann.Wait(kPatience)) << "it must not go on without a driver";
  EXPECT_EQ(ann.status(), 0) << ann.Story();
  EXPECT_TRUE(
      session.WaitUntil([](const Recording& r) { return Says(r, "is gone: left"); }, kPatience));
}

}  // namespace join_leave_test
}  // namespace seam
