#include "common/physics/outline/line_outline.h"

#include <cmath>
#include <cstdint>

#include "common/base/geometry.h"
#include "common/base/spatial/box_sweep.h"
#include "common/base/trig.h"

namespace seam {
namespace {

using Eigen::Vector2d;

/// Cosine below which two lines lie on each other.
constexpr double kFolded = -0.99;

struct LineExtent {
  Eigen::Vector2f min{0, 0}, max{0, 0};
};

/// Returns the lines near each one.
std::vector<std::vector<std::size_t>> NeighboursOf(const std::vector<OutlineLine>& lines,
                                                   double gap) {
  std::vector<LineExtent> extents;
  for (const OutlineLine& line : lines) {
    extents.push_back(
        {line.from.cwiseMin(line.to).cast<float>(), line.from.cwiseMax(line.to).cast<float>()});
  }
  std::vector<std::vector<std::size_t>> near(lines.size());
  const auto grow = [gap](std::size_t) { return static_cast<float>(gap); };
  BoxSweep(extents, grow).EachPair([&](std::uint32_t a, std::uint32_t b) {
    near[a].push_back(b);
    near[b].push_back(a);
  });
  return near;
}

/// The line that an edge goes on along, at one of its ends.
struct NextLine {
  bool found = false;
  Vector2d out{0, 0};  // unit direction, away from the end
  Vector2d at{0, 0};   // its end, m
  double turn = 0;     // rad, to the left for one who walks out
};

/// Finds the next line at the end `end` of a line that comes along `along`: of several, the one
/// with air between on the edge's right (`forward`: the edge walks out there, else in).
NextLine FindNext(const std::vector<OutlineLine>& lines, const std::vector<std::size_t>& near,
                  const Vector2d& end, const Vector2d& along, bool forward, int group, double gap) {
  NextLine best;
  for (const std::size_t index : near) {
    const OutlineLine& other = lines[index];
    if (other.group < 0 && other.group != group) continue;  // some collide with one of them alone
    for (const bool by_from : {true, false}) {
      const Vector2d at = by_from ? other.from : other.to;
      if ((at - end).norm() > gap) continue;
      const Vector2d out = ((by_from ? other.to : other.from) - at).normalized();
      if (along.dot(out) < kFolded) continue;
      const double turn = Atan2(Cross(along, out), along.dot(out)) * (forward ? 1 : -1);
      if (!best.found || turn < best.turn) best = {true, out, at, turn};
    }
  }
  return best;
}

/// Returns the point at which a line is prolonged to meet the next one.
Vector2d MeetingPoint(const Vector2d& end, const Vector2d& along, const NextLine& next) {
  return end + along.dot(next.at - end) / 2 * along;
}

}  // namespace

std::vector<SolidOutline> LineOutlinesOf(const std::vector<OutlineLine>& lines, double gap) {
  std::vector<SolidOutline> outlines(lines.size());
  const std::vector<std::vector<std::size_t>> near = NeighboursOf(lines, gap);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (near[i].empty()) continue;
    SolidOutline& outline = outlines[i];
    for (const bool turned : {false, true}) {
      const Vector2d from = turned ? lines[i].to : lines[i].from;
      const Vector2d to = turned ? lines[i].from : lines[i].to;
      const Vector2d along = (to - from).normalized(), left(-along.y(), along.x());
      const NextLine after = FindNext(lines, near[i], to, along, true, lines[i].group, gap);
      const NextLine before = FindNext(lines, near[i], from, -along, false, lines[i].group, gap);
      OutlineEdge edge{from, to, -left, left};
      if (after.found) edge = {edge.from, MeetingPoint(to, along, after), edge.before, after.out};
      if (before.found)
        edge = {MeetingPoint(from, -along, before), edge.to, -before.out, edge.after};
      outline.edges.push_back(edge);
      outline.alone = outline.alone && !after.found && !before.found;
    }
    if (outline.alone) outline.edges.clear();
  }
  return outlines;
}

}  // namespace seam
