/// ExactIsland: mechanisms in free flight. A mechanism without anchor or outer contact keeps its
/// momentum, its angular momentum about the centre of mass, and its energy relative to it: joints
/// do no work, and gravity accelerates all bodies alike. A substep with large rotations keeps these
/// only in the mean, so its final velocities are projected on them (Hairer, Lubich and Wanner 2006,
/// IV.4).

#include <algorithm>
#include <cmath>

#include "common/physics/exact/island.h"

namespace seam {
namespace {

/// Bounds of the scale of internal velocities in one projection.
constexpr double kScaleMin = 0.5, kScaleMax = 2;
/// Internal energy below this share of the energy is rounding.
constexpr double kLittle = 1e-12;

}  // namespace

/// Finds the mechanisms that may fly: all their joints are rigid, without a motor and between their
/// own bodies, and none takes momentum from outside, as a pulley's rope does.
void ExactIsland::ShapeFlights() {
  flights_.clear();
  flight_bodies_.clear();
  flight_rows_.clear();
  const auto group_of = [&](int body) { return body < 0 ? -1 : Body(body).group; };
  std::vector<int>& tied = first_;  // groups that cannot fly
  tied.clear();
  for (const Held& held : joints) {
    bool free = held.joint->type != e_pulleyJoint;
    for (const int body : {held.ends.a, held.ends.b, held.ends.base_a, held.ends.base_b}) {
      free = free && (body < 0 || Body(body).moves());
    }
    for (int i = held.row; i < held.row + held.rows; ++i) {
      free = free && At(i).kind != RowKind::kSoft && At(i).kind != RowKind::kMotor;
    }
    if (free) continue;
    tied.push_back(group_of(held.ends.a));
    tied.push_back(group_of(held.ends.b));
  }
  for (const Held& held : joints) {
    const int group = group_of(held.ends.a);
    const bool known = std::any_of(flights_.begin(), flights_.end(),
                                   [&](const Flight& f) { return f.group == group; });
    if (known || std::count(tied.begin(), tied.end(), group) > 0) continue;
    Flight flight;
    flight.group = group;
    flight.first_body = static_cast<int>(flight_bodies_.size());
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      if (bodies[b].moves() && bodies[b].group == group) {
        flight_bodies_.push_back(static_cast<int>(b));
      }
    }
    flight.bodies = static_cast<int>(flight_bodies_.size()) - flight.first_body;
    flight.first_row = static_cast<int>(flight_rows_.size());
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      bool acts = false;
      for (int e = 0; e < rows_[i].ends; ++e) {
        acts = acts || group_of(rows_[i].end[e].body) == group;
      }
      if (acts && rows_[i].bounded()) flight_rows_.push_back(static_cast<int>(i));
    }
    flight.rows = static_cast<int>(flight_rows_.size()) - flight.first_row;
    flights_.push_back(flight);
  }
}

ExactIsland::Flying ExactIsland::FlyingOf(const Flight& flight) const {
  Flying f;
  const int* const first = flight_bodies_.data() + flight.first_body;
  const int* const stop = first + flight.bodies;
  double mass = 0;
  for (const int* b = first; b != stop; ++b) {
    const ExactBody& q = bodies[static_cast<std::size_t>(*b)];
    mass += 1 / q.im;
    f.x += q.x / q.im;
    f.y += q.y / q.im;
    f.vx += q.vx / q.im;
    f.vy += q.vy / q.im;
  }
  f.x /= mass;
  f.y /= mass;
  f.vx /= mass;
  f.vy /= mass;
  for (const int* b = first; b != stop; ++b) {
    const ExactBody& q = bodies[static_cast<std::size_t>(*b)];
    const double rx = q.x - f.x, ry = q.y - f.y, ux = q.vx - f.vx, uy = q.vy - f.vy;
    f.inertia += (rx * rx + ry * ry) / q.im + q.inertia;
    f.spin += (rx * uy - ry * ux) / q.im + q.inertia * q.w;
    f.energy += ((ux * ux + uy * uy) / q.im + q.inertia * q.w * q.w) / 2;
  }
  return f;
}

/// Stores the conserved quantities, before a substep's velocities change.
void ExactIsland::Depart() {
  for (Flight& flight : flights_) {
    const ExactBody& lead = Body(flight_bodies_[static_cast<std::size_t>(flight.first_body)]);
    flight.flies = true;
    for (int i = 0; i < flight.bodies; ++i) {
      const ExactBody& q = Body(flight_bodies_[static_cast<std::size_t>(flight.first_body + i)]);
      flight.flies = flight.flies && q.ax == lead.ax && q.ay == lead.ay && q.turn == 0 &&
                     q.slow == 0 && q.slow_spin == 0;
    }
    if (flight.flies) flight.before = FlyingOf(flight);
  }
}

/// At the substep's end, restores the quantities of mechanisms without outer impulses. The common
/// rotation is set by the angular momentum; the velocities relative to that are scaled, which keeps
/// joints satisfied.
void ExactIsland::Arrive() {
  for (const Flight& flight : flights_) {
    bool flies = flight.flies;
    for (int i = 0; i < flight.rows && flies; ++i) {
      flies = At(flight_rows_[static_cast<std::size_t>(flight.first_row + i)]).base == 0;
    }
    if (!flies) continue;
    const Flying& was = flight.before;
    const Flying is = FlyingOf(flight);
    const double turns = is.spin / is.inertia, turned = was.spin / is.inertia;
    const double inner = is.energy - is.spin * turns / 2;
    const double wanted = was.energy - was.spin * turned / 2;
    const double scale = inner > kLittle * is.energy
                             ? std::sqrt(std::clamp(wanted / inner, kScaleMin, kScaleMax))
                             : 1;
    for (int i = 0; i < flight.bodies; ++i) {
      ExactBody& q = Body(flight_bodies_[static_cast<std::size_t>(flight.first_body + i)]);
      const double rx = q.x - is.x, ry = q.y - is.y;
      q.vx = is.vx - turned * ry + scale * (q.vx - is.vx + turns * ry);
      q.vy = is.vy + turned * rx + scale * (q.vy - is.vy - turns * rx);
      q.w = turned + scale * (q.w - turns);
    }
  }
}

}  // namespace seam
