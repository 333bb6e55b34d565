#include "common/measure/screen/own.h"

#include <algorithm>
#include <set>

#include "common/scene/ownership.h"

namespace seam {

OwnBodies::OwnBodies(const Recording& recording, const RevisionHistory* revisions)
    : revisions_(revisions) {
  const std::vector<Edit> edits = EditsOf(recording);
  for (std::size_t n = 0; n < edits.size(); ++n) {
    const SeatEdit* sat = edits[n].As<SeatEdit>();
    if (sat != nullptr) sittings_.push_back({static_cast<int>(n), sat->seat, sat->player});
  }
}

bool OwnBodies::Has(const View& view, std::size_t i) {
  if (view.peer < 1 || revisions_ == nullptr) return false;
  const std::vector<PartId>& own = ByScene(view.revision, view.peer - 1);
  return std::binary_search(own.begin(), own.end(), PartId{view.id[i]});
}

const std::vector<PartId>& OwnBodies::ByScene(int edits, int player) {
  // Seating changes no body, so the revision's key does not distinguish it.
  const auto [place, made] = own_.try_emplace({edits, player});
  if (made && revisions_ != nullptr) place->second = Find(edits, player);
  return place->second;
}

std::vector<PartId> OwnBodies::Find(int edits, int player) const {
  const auto revision = revisions_->At(edits);
  const Scene& scene = revision->scene();
  const Composition& composition = revision->composition();
  if (player < 0 || static_cast<std::size_t>(player) >= scene.players.size()) return {};
  std::set<int> mechanisms;
  const auto sitter = [&](std::size_t seat) {
    int player_there = revisions_->At(0)->scene().seats[seat].player;
    for (const Sitting& sitting : sittings_) {
      const bool here = sitting.number < edits && sitting.seat == static_cast<int>(seat);
      if (here) player_there = sitting.player;
    }
    return player_there;
  };
  EachOwnPart(scene, player, sitter, [&](PartId part) {
    const int mechanism = MechanismIn(composition, part);
    if (mechanism >= 0) mechanisms.insert(mechanism);
  });
  std::vector<PartId> ids;
  for (const Assembly& assembly : composition.assemblies) {
    if (!assembly.anchored && mechanisms.count(assembly.mechanism) > 0) ids.push_back(assembly.id);
  }
  return ids;
}

}  // namespace seam
