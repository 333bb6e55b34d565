/// The scenes whose titles are about many players.

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/lab/titles/titles.h"

namespace seam {
namespace {

double Way(const Screen& screen, const std::string& part) {
  const Vec2 way = screen.AtEnd(part).position - screen.AtStart(part).position;
  return static_cast<double>(way.norm());
}

/// Parts of that prefix that ended more than `far` m from where they began, as far as shown.
int Moved(const Screen& screen, const std::string& prefix, float far) {
  return screen.CountAtEnd(prefix, [&](const std::string& part, const BodyState& state) {
    return (state.position - screen.AtStart(part).position).norm() > far;
  });
}

/// The least and the largest x, m, that a part was shown at from a time on, s.
std::pair<double, double> RangeOf(const Screen& screen, const std::string& part,
                                  double from_s = 0) {
  std::pair<double, double> reach{1e9, -1e9};
  for (double time_s = from_s; time_s <= screen.end_s(); time_s += 0.1) {
    const std::optional<BodyState> state = screen.Find(part, time_s);
    if (!state) continue;
    reach.first = std::min(reach.first, static_cast<double>(state->position.x()));
    reach.second = std::max(reach.second, static_cast<double>(state->position.x()));
  }
  return reach;
}

}  // namespace

void JudgeSwarm(const Screen& screen, Claims* claims) {
  std::set<int> present;
  for (const auto& [player, inputs] : screen.recording().inputs) present.insert(player);
  const auto there = static_cast<int>(present.size());
  for (const int player : present) {
    const std::string sled = "sled." + std::to_string(player);
    const auto [least, most] = RangeOf(screen, sled);
    claims->AtLeast(most - least, 8, "way of " + sled + ", m");
  }
  for (const std::string& sled : screen.All("sled.")) {
    if (present.count(std::stoi(sled.substr(5))) != 0) continue;
    // A neighbour's crates may press on the one beside the last.
    if (std::stoi(sled.substr(5)) <= there) continue;
    claims->Between(Way(screen, sled), 0, 0.3, "way of " + sled + ", which nobody drives, m");
  }
  claims->AtLeast(Moved(screen, "near.", 1), 2 * there, "crates shoved");
}

void JudgeDerby(const Screen& screen, Claims* claims) {
  int meetings = 0;
  std::set<std::string> met;
  for (const std::string& red : screen.All("red-car.")) {
    for (const std::string& blue : screen.All("blue-car.")) {
      bool apart = true;
      for (double time_s = 0; time_s <= screen.end_s(); time_s += 0.1) {
        const auto a = screen.Find(red, time_s), b = screen.Find(blue, time_s);
        if (!a || !b) continue;
        const float distance = (a->position - b->position).norm();
        if (apart && distance < 4) {
          ++meetings;
          met.insert(red), met.insert(blue);
        }
        apart = distance > 6 || (apart && distance >= 4);
      }
    }
  }
  claims->AtLeast(meetings, 12, "times that a red and a blue car came together");
  claims->AtLeast(static_cast<double>(met.size()), 6, "cars that met another");
  for (const char* prefix : {"red-car.", "blue-car."}) {
    for (const std::string& car : screen.All(prefix)) {
      claims->Between(screen.AtEnd(car).position.x(), -40, 40, car + " in the hollow, m");
    }
  }
}

void JudgePile(const Screen& screen, Claims* claims) {
  for (const std::string& blade : screen.All("blade.")) {
    const auto [least, most] = RangeOf(screen, blade);
    claims->AtLeast(most - least, 0.8, "way of " + blade + ", m");
  }
  int moved = 0;
  for (const char* heap : {"west.", "middle.", "east."}) {
    claims->AtLeast(Moved(screen, heap, 0.5f), 15, std::string("boxes moved in heap ") + heap);
    moved += Moved(screen, heap, 0.5f);
  }
  claims->AtLeast(moved, 80, "boxes moved");
}

void JudgeRelay8(const Screen& screen, Claims* claims) {
  claims->AtLeast(RangeOf(screen, "alone").second, 24, "the one alone, farthest right, m");
  claims->Between(RangeOf(screen, "alone", 8).first, -33, -24, "and back at the left, m");
  claims->Between(RangeOf(screen, "left", 5).first, -33, -24, "the left one, thrown back, m");
  claims->AtLeast(RangeOf(screen, "left").second, -4, "the left one in the middle, m");
  claims->Between(RangeOf(screen, "right", 5).second, 24, 33, "the right one, thrown back, m");
  claims->Between(RangeOf(screen, "right").first, -33, 4, "the right one in the middle, m");
}

}  // namespace seam
