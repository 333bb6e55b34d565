/// A latecomer finds the progress of a character on its way to a seat.

#include "common/stages/seat_way.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/stages/make_stages.h"

namespace seam {
namespace seat_way_test {

using Eigen::Vector2d;

/// Place on the way, `ticks` after the seat was taken, of a character that started at `from`.
Transform2 PlaceAt(const Seat& seat, const Transform2& from, double ticks, int tick_hz) {
  const double share = ShareOfWay(ticks, tick_hz);
  const double turn = WrapAngle(static_cast<double>(seat.angle) - from.angle);
  return {(1 - share) * from.shift + share * seat.at.cast<double>(), from.angle + share * turn};
}

TEST(SeatWay, IsFoundFromPlaceAndSpeed) {
  Seat seat;
  seat.at = {0.3f, 0.7f};
  seat.angle = 0.2f;
  for (const int tick_hz : {30, 60, 120}) {
    for (const int substeps : {1, 4}) {
      Solver solver;
      solver.tick_hz = tick_hz;
      solver.substeps = substeps;
      const int wait = SeatWaitTicks(tick_hz), all = SeatTicks(tick_hz);
      for (const Transform2& from : {Transform2{{-1.8, 0.5}, 0.1}, Transform2{{1, -0.4}, -2}}) {
        int found = 0;
        for (int ticks = wait; ticks <= all; ++ticks) {
          const double before = ticks - 1.0 / substeps;
          const Transform2 now = PlaceAt(seat, from, ticks, tick_hz);
          const Vector2d step = now.shift - PlaceAt(seat, from, before, tick_hz).shift;
          SeatWay way{0, {}};
          EstimateWay(seat, solver, {now, step * (tick_hz * substeps)}, &way);
          if (way.ticks <= wait) continue;  // little to be seen yet
          ++found;
          // At the end there is little to be seen again: it may be the last thirtieth of a second.
          const bool ends = ticks > wait + 0.9 * (all - wait);
          EXPECT_LE(std::abs(way.ticks - ticks), ends ? 1 + tick_hz / 30 : 1)
              << ticks << " at " << tick_hz << " Hz, " << substeps;
          // By its further way: its places in the next ticks. Half a tick is 10 cm of the way at 30
          // Hz.
          for (int next = 1; next <= 3; ++next) {
            const Vector2d off = PlaceAt(seat, way.from, way.ticks + next, tick_hz).shift -
                                 PlaceAt(seat, from, ticks + next, tick_hz).shift;
            EXPECT_LT(off.norm(), tick_hz < 60 ? 0.1 : 0.03)
                << ticks << " of " << wait << " to " << all << " at " << tick_hz << " Hz, "
                << substeps << " substeps";
          }
        }
        EXPECT_GE(found, (all - wait) * 8 / 10);
      }
    }
  }
}

TEST(SeatWay, ADistantCharacterHasNotStartedAndASeatedOneStays) {
  Seat seat;
  const Solver solver;
  SeatWay way{3, {{9, 9}, 1}};
  EstimateWay(seat, solver, {{{-1.5, 0}, 0}, {0, 0}}, &way);
  EXPECT_EQ(way.ticks, 3);
  EstimateWay(seat, solver, {{{-1.5, 0}, 0}, {-3, 0}}, &way);
  EXPECT_EQ(way.ticks, 3) << "it goes away";
  EstimateWay(seat, solver, {{{0.01, 0}, 0}, {0, 0}}, &way);
  EXPECT_EQ(way.ticks, SeatTicks(solver.tick_hz));
  EstimateWay(seat, solver, {{{0.2, 0}, 0}, {1, 0}}, &way);
  EXPECT_EQ(way.ticks, SeatTicks(solver.tick_hz)) << "shown beyond it, by what was heard before";
}

}  // namespace seat_way_test
}  // namespace seam
