#pragma once
/// Collisions of two bodies: detects that on a screen one body responds later than the other.

#include <map>
#include <vector>

#include "common/measure/screen/noticed.h"

namespace seam {

/// Collects the impacts of all bodies and their responses on each peer's screen.
class Blows {
 public:
  /// `h`: s per tick.
  explicit Blows(double h) : h_(h) {}

  /// Finds the oracle's impacts on a body. The following calls of Show are for that body.
  void Begin(PartId id, const BodyPath& truth, double radius);
  /// Records when the body responds to each of its impacts on that peer's screen.
  void Show(int peer, const ShownBody& body);
  /// Marks, in `seconds`, the later of two bodies that respond to the same impact more than
  /// kContactDelay apart. Two impacts are the same if they are in the same or successive ticks of
  /// the oracle and the bodies are as near as their radii let them touch. A body that never
  /// responds is later than one that does.
  void Notice(BodySeconds* seconds) const;

 private:
  struct Blow {
    PartId id = 0;
    std::int64_t tick = 0;
    Eigen::Vector2d position{0, 0};    // m
    Eigen::Vector2d before{0, 0};      // m/s, velocity before it
    Eigen::Vector2d change{0, 0};      // m/s
    double radius = 0;                 // m
    std::int64_t answer_due = 0;       // tick of the oracle's own response
    std::map<int, std::int64_t> late;  // ticks after answer_due, by peer; kNever: no response
  };
  /// Returns the tick at which a path has half of the impact's velocity change; nullopt: never.
  std::optional<std::int64_t> Answer(const Blow& blow, const BodyPath& path) const;

  double h_;
  std::vector<Blow> blows_;
  std::size_t begin_ = 0;  // first index of the present body
};

}  // namespace seam
