#include "render/page/strands.h"

#include <map>

#include "common/base/json_text.h"
#include "common/scene/strand.h"

namespace seam {
namespace {

/// The points of one strand over time.
struct StrandPath {
  std::vector<std::int64_t> ticks;
  std::vector<std::vector<std::int64_t>> columns;  ///< mm: x and y of each point, by tick
};

using Points = std::map<int, std::vector<std::int64_t>>;  // by strand: x, y, x, y, ...

Points PointsOf(const Strands& strands) {
  Points points;
  for (std::size_t i = 0; i < strands.strand.size(); ++i) {
    std::vector<std::int64_t>& of = points[strands.strand[i]];
    of.push_back(Thousandths(double{strands.x[i]}));
    of.push_back(Thousandths(double{strands.y[i]}));
  }
  return points;
}

void Add(const Points& points, std::int64_t tick, std::map<int, StrandPath>* paths) {
  for (const auto& [index, numbers] : points) {
    StrandPath& path = (*paths)[index];
    if (path.ticks.empty()) path.columns.resize(numbers.size());
    if (path.columns.size() != numbers.size()) continue;  // another number of points than before
    path.ticks.push_back(tick);
    for (std::size_t i = 0; i < numbers.size(); ++i) path.columns[i].push_back(numbers[i]);
  }
}

}  // namespace

PageBytes EncodeStrands(const Playback& playback, int peer) {
  PageBytes out;
  const auto& strands = playback.recording().strands;
  const auto of_peer = strands.find(peer);
  if (of_peer == strands.end()) return out;
  std::map<int, StrandPath> paths;
  for (const auto& [tick, message] : of_peer->second) Add(PointsOf(message), tick, &paths);
  const auto& known = playback.scene().strands;
  for (auto path = paths.begin(); path != paths.end();) {
    const bool in_scene = path->first >= 0 && static_cast<std::size_t>(path->first) < known.size();
    path = in_scene ? std::next(path) : paths.erase(path);
  }
  PutUnsigned(&out, paths.size());
  for (const auto& [index, path] : paths) {
    const Strand& strand = known[static_cast<std::size_t>(index)];
    PutUnsigned(&out, static_cast<std::uint64_t>(index));
    PutSigned(&out, strand.part);
    PutSigned(&out, Thousandths(double{strand.width}));
    PutUnsigned(&out, path.columns.size() / 2);
    PutUnsigned(&out, path.ticks.size());
    PutFirstDifferences(&out, path.ticks);
    for (const auto& column : path.columns) PutFirstDifferences(&out, column);
  }
  return out;
}

}  // namespace seam
