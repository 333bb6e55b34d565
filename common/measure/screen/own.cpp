#include "common/measure/screen/own.h"

#include <algorithm>
#include <set>

#include "common/scene/character.h"

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
  const auto add = [&](PartId part) {
    const int of = revision->AssemblyOf(part);
    if (of < 0) return;
    const int mechanism = composition.assemblies[static_cast<std::size_t>(of)].mechanism;
    if (mechanism >= 0) mechanisms.insert(mechanism);
  };
  add(scene.players[static_cast<std::size_t>(player)].vehicle);
  for (const Part& part : scene.parts) {
    if (part.owner == player && !part.gone) add(part.id);
  }
  for (const Character& character : scene.characters) {
    if (character.player == player) add(character.parts[kTorso]);
  }
  for (std::size_t s = 0; s < scene.seats.size(); ++s) {
    int who = revisions_->At(0)->scene().seats[s].player;
    for (const Sitting& sitting : sittings_) {
      if (sitting.number < edits && sitting.seat == static_cast<int>(s)) who = sitting.player;
    }
    if (who == player) add(scene.seats[s].part);
  }
  std::vector<PartId> ids;
  for (const Assembly& assembly : composition.assemblies) {
    if (!assembly.anchored && mechanisms.count(assembly.mechanism) > 0) ids.push_back(assembly.id);
  }
  return ids;
}

}  // namespace seam
