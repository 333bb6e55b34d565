/// Tests the server's part of seam-swarm's report, from given load messages.

#include <gtest/gtest.h>

#include "client/swarm/report.h"

namespace seam {
namespace swarm_report_test {

RoomLoad Told(const std::string& room, std::int64_t seconds) {
  RoomLoad told;
  told.room = room;
  told.load.utime = seconds * 1000000;
  told.load.cpu_us = seconds * 100000;
  told.load.tick_p50_us = 1000;
  told.load.tick_p99_us = 18000;
  told.load.tick_max_us = 19000;
  told.load.late_p50_us = 500;
  told.load.late_p99_us = 7000;
  told.load.late_max_us = 8000;
  told.load.speed_ppm = kFullSpeedPpm;
  return told;
}

void Add(int n, std::int64_t tick_us, std::int64_t late_us, RoomLoad* told) {
  for (int i = 0; i < n; ++i) told->tick.Add(tick_us), told->late.Add(late_us);
}

TEST(SwarmReport, P99CoversAllRoomsAndTheWholeMeasuredTime) {
  ServerLoads told;
  RoomLoad a = Told("a", 1), b = Told("b", 1);
  Add(1000, 200000, 200000, &a);  // while they joined
  told.before = {a, b};
  Add(60, 1200, 120, &a), Add(30, 1200, 120, &b);
  told.meanwhile = {a, b};
  Add(6, 1200, 120, &a), Add(3, 1200, 120, &b), Add(1, 3000, 300, &b);
  told.after = {a, b};
  // 99 of 100 are between 1 and 1.5 ms and begin .1 to .15 ms late.
  EXPECT_EQ(ServerReport(told),
            "server: tick p50 1.00 ms, p99 1.50 ms, 18.00 ms in the worst second, max 19.00 ms\n"
            "server lateness: p50 0.50 ms, p99 0.15 ms, 7.00 ms in the worst second, max 8.00 ms\n"
            "server room: 2 room(s), slowest clock 100 %, clients hold 0.0 % of what moves\n");
}

TEST(SwarmReport, ARoomThatAnswersLateCountsFromItsFirstAnswer) {
  ServerLoads told;
  RoomLoad a = Told("a", 1);
  Add(1000, 200000, 200000, &a);
  told.meanwhile = {a};
  a.load = Told("a", 3).load;
  Add(50, 500, 500, &a);
  told.meanwhile.push_back(a);
  const std::string said = ServerReport(told);
  EXPECT_NE(said.find("p99 0.68 ms, 18.00 ms in the worst second"), std::string::npos) << said;
  EXPECT_NE(said.find("server cpu: 10.00 % of a core"), std::string::npos) << said;
}

TEST(SwarmReport, OnABusOnlyTheWorstSecondIsKnown) {
  ServerLoads told;
  told.meanwhile = {Told("a", 1), Told("a", 2)};
  const std::string said = ServerReport(told);
  EXPECT_EQ(said.substr(0, said.find('\n')),
            "server: tick p50 1.00 ms, p99 18.00 ms in the worst second, max 19.00 ms");
  EXPECT_EQ(ServerReport({}).rfind("server: not heard", 0), 0u);
}

}  // namespace swarm_report_test
}  // namespace seam
