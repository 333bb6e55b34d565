#include "common/measure/contents/partial_views.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "common/measure/revisions.h"

namespace seam {

std::map<int, ShownBodies> PartialViews(const Scene& scene, const Recording& recording) {
  const RevisionHistory revisions(scene, recording);
  std::map<int, std::size_t> bodies;  // by key of the revision
  const auto bodies_at = [&](int edits) {
    const int key = revisions.Key(edits);
    const auto known = bodies.find(key);
    if (known != bodies.end()) return known->second;
    return bodies[key] = revisions.At(key)->ids.size();
  };
  std::map<int, ShownBodies> partial;
  for (const auto& [peer, views] : recording.views) {
    std::size_t shown = 0, of = 0;
    for (const auto& [tick, view] : views) {
      shown += view.id.size();
      of += bodies_at(view.revision);
    }
    const auto ticks = static_cast<double>(std::max<std::size_t>(1, views.size()));
    if (shown < of) {
      partial[peer] = {static_cast<double>(shown) / ticks, static_cast<double>(of) / ticks};
    }
  }
  return partial;
}

std::string PartialViewsText(const std::map<int, ShownBodies>& partial,
                             const std::function<std::string(int)>& name_of) {
  constexpr std::size_t kNamedPeers = 3;
  std::vector<std::string> names;
  for (const auto& [peer, shown] : partial) {
    if (names.size() == kNamedPeers) break;
    names.push_back(fmt::format("{} ({:.0f} of {:.0f})", name_of(peer), shown.shown, shown.of));
  }
  if (names.empty()) return "";
  const std::size_t more = partial.size() - names.size();
  return fmt::format(
      "views with a part of the bodies only, as of --publish own: {}{}; nothing "
      "is known of what they show of the others",
      fmt::join(names, ", "), more > 0 ? fmt::format(" and {} more", more) : "");
}

}  // namespace seam
