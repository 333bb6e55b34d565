#pragma once
/// Two bodies strike each other: on a screen, does one respond later than the other?

#include <map>
#include <vector>

#include "common/measure/screen/noticed.h"

namespace seam {

class Blows {
 public:
  /// `h`: s per tick.
  explicit Blows(double h) : h_(h) {}

  /// Finds the oracle's blows against a body; the calls of Show that follow are of that body.
  void Begin(PartId id, const BodyPath& truth, double radius);
  /// When the body answers to each of them on that peer's screen.
  void Show(int peer, const ShownBody& body);
  /// Notices the later one of two bodies that answer to the same blow more than kContactDelay
  /// apart. A blow is the same if it is in the same or the next tick of the oracle, and the bodies
  /// are as near as their radii let them touch. A body that never answers is later than one that
  /// does.
  void Notice(BodySeconds* seconds) const;

 private:
  struct Blow {
    PartId id = 0;
    std::int64_t tick = 0;
    Eigen::Vector2d position{0, 0};    // m
    Eigen::Vector2d before{0, 0};      // m/s, velocity before it
    Eigen::Vector2d change{0, 0};      // m/s
    double radius = 0;                 // m
    std::int64_t answer_due = 0;       // tick of the oracle's own answer
    std::map<int, std::int64_t> late;  // ticks after that, by peer; kNever
  };
  /// The tick in which a path has made half of the blow's change; nullopt: never.
  std::optional<std::int64_t> Answer(const Blow& blow, const BodyPath& path) const;

  double h_;
  std::vector<Blow> blows_;
  std::size_t begin_ = 0;  // of the present body's
};

}  // namespace seam
