/// The scenes whose titles are about characters.

#include <algorithm>
#include <cmath>

#include "tests/lab/titles/titles.h"

namespace seam {

void JudgeRagdolls(const Screen& screen, Claims* claims) {
  float top = 0;
  for (const char* name : {"first", "second", "third", "fourth", "struck"}) {
    const std::string torso = std::string(name) + ".torso";
    const BodyState end = screen.AtEnd(torso);
    claims->Between(end.position.x(), -2, 2, torso + " across the bottom, m");
    claims->AtLeast(screen.AtStart(torso).position.y() - end.position.y(), 2, torso + " fell, m");
    claims->Between(end.velocity.norm(), 0, 0.5, torso + " is at rest, m/s");
    top = std::max(top, end.position.y());
  }
  claims->AtLeast(top, 0.4, "height of the heap at the torso on top, m");
  const Vec2 foot = screen.AtEnd("hanging.foot-l").position;
  claims->Between((foot - Vec2(3.4f, 7.9f)).norm(), 0, 0.3, "the foot from its beam, m");
  claims->Between(screen.AtEnd("hanging.head").position.y(), 5.5, 7.4, "the hanging head, m");
}

void JudgeObstacle(const Screen& screen, Claims* claims) {
  const BodyState ann = screen.AtEnd("ann-body.torso"), bob = screen.AtEnd("bob-body.torso");
  const double beach = 8.8;  // m; where the water ends
  claims->AtLeast(ann.position.x(), beach, "ann beyond the pool, m");
  claims->AtLeast(-bob.position.x(), beach, "bob beyond the pool, m");
  for (const char* who : {"ann", "bob"}) {
    const float head = screen.AtEnd(std::string(who) + "-body.head").position.y();
    const float foot = screen.AtEnd(std::string(who) + "-body.foot-l").position.y();
    claims->AtLeast(head - foot, 1.3, std::string(who) + "'s head over the feet, m");
  }
}

void JudgePlayground(const Screen& screen, Claims* claims) {
  const auto from_seat = [&](double time_s) {
    return (screen.At("ann-body.torso", time_s).position - screen.At("buggy", time_s).position)
        .norm();
  };
  claims->Between(from_seat(8), 0, 1.6, "ann from the buggy at 8 s, m");
  claims->AtLeast(screen.Edits<SeatEdit>(), 2, "times that ann got in or out");
  claims->AtLeast(screen.AtEnd("buggy").position.x(), -15, "the buggy beyond the seam, m");
  claims->AtLeast(screen.CountAtEnd("crate.",
                                    [&](const std::string& name, const BodyState& state) {
                                      return std::abs(state.position.x() -
                                                      screen.AtStart(name).position.x()) > 0.5f;
                                    }),
                  2, "crates that the crawler moved");
  claims->AtLeast(screen.AtEnd("boat").position.x(), 15, "the boat in dee's region, m");
  double tower = 0;
  for (const std::string& brick : screen.All("tower")) {
    tower = std::max<double>(tower, screen.AtEnd(brick).position.y());
  }
  claims->Between(tower, -4, 2, "height of the tower, m");
  claims->AtLeast(
      screen.AtStart("limp.torso").position.y() - screen.AtEnd("limp.torso").position.y(), 5,
      "how far the ragdoll came down, m");
  claims->AtLeast(screen.Score(0), 20, "ann's points");
}

}  // namespace seam
