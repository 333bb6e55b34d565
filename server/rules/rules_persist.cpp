/// Rules: their state as bytes.

#include "common/scene/charges/charge.h"
#include "common/scene/part_rules.h"
#include "common/scene/saved/persist_state.h"
#include "server/rules/rules.h"
#include "server/rules/script_room.h"
#include "server/script/saved_script.h"
#include "server/script/script.h"

namespace seam {

void Rules::Persist(StateArchive& a) {
  a.Section("rules");
  const std::size_t parts = scene().parts.size();
  const auto part = [&](PartId* id) { a.Int(id, 0, static_cast<std::int64_t>(parts) - 1); };
  const auto players = static_cast<std::int64_t>(scene().players.size());
  triggers_.Persist(a, parts);
  table_.Persist(a);
  a.Int(&parts_noted_, 0, static_cast<std::int64_t>(parts));
  a.Members(&dead_, parts, part);
  a.Entries(
      &stays_, scene().triggers.size() * parts,
      [&](std::pair<int, PartId>* where) {
        a.Int(&where->first, 0, static_cast<std::int64_t>(scene().triggers.size()) - 1);
        part(&where->second);
      },
      [&](Stay* stay) {
        for (std::int64_t* ticks : {&stay->first, &stay->last, &stay->hurt, &stay->silent}) {
          a.Tick(ticks);
        }
      });
  a.List(&charge_due_, scene().charges.size(),
         [&](std::int64_t* tick) { a.Int(tick, -1, INT64_MAX); });
  a.Require(charge_due_.empty() || charge_due_.size() == scene().charges.size(),
            "there are other charges");
  a.List(&player_events_, StateArchive::kListMost, [&](PlayerEvent* event) {
    a.Int(&event->player, 0, players - 1);
    a.Flag(&event->joins);
  });
  a.List(&seat_events_, StateArchive::kListMost, [&](SeatEvent* event) {
    a.Int(&event->player, 0, players - 1);
    a.Int(&event->seat, 0, static_cast<std::int64_t>(scene().seats.size()) - 1);
    auto news = static_cast<int>(event->news);
    a.Int(&news, 0, static_cast<int>(SeatNews::kTaken));
    event->news = static_cast<SeatNews>(news);
  });
  a.List(&seated_, scene().seats.size(), [&](int* player) { a.Int(player, -1, players - 1); });
  PersistScripts(a);
}

void Rules::PersistScripts(StateArchive& a) {
  a.Section("scripts");
  a.Members(&stopped_reported_, scripts_.size(),
            [&](std::string* name) { a.Text(name, kLabelBytesMax); });
  for (std::size_t i = 0; i < scripts_.size(); ++i) {
    SavedScript saved;
    if (!a.reading()) saved = scripts_[i]->Save();
    seam::Persist(a, &saved);
    if (!a.ok()) return;
    if (a.reading()) scripts_[i] = StartScript(i, &saved);
  }
}

}  // namespace seam
