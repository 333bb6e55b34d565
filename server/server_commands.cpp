#include "server/server_commands.h"

#include <algorithm>
#include <utility>

#include "common/physics/part_places.h"
#include "server/rules/seats.h"
#include "server/script/script_host.h"

namespace seam {

void ServerCommands::RemovePart(PartId part) { Ask(RemoveEdit{part}); }

void ServerCommands::BreakJoint(int joint) { Ask(BreakEdit{joint}); }

void ServerCommands::Bond(PartId a, PartId b, float strength) {
  Ask(BondAsTheyAre(replica_.world(), a, b, strength));
}

void ServerCommands::Push(PartId part, const Vec2& impulse) { Ask(PushEdit{part, impulse}); }

void ServerCommands::Limp(PartId part, float seconds) {
  Ask(PushEdit{part, Vec2(0, 0), 0, seconds});
}

void ServerCommands::LeaveSeat(int seat) {
  for (const Edit& edit : seam::LeaveSeat(replica_.world(), seat)) Ask(edit);
}

void ServerCommands::Blast(const Vec2& centre, float radius, float speed, float impulse) {
  Ask(BlastEdit{centre, radius, speed, impulse});
}

void ServerCommands::Insert(const std::string& text) { Ask(InsertEdit{text}); }

void ServerCommands::Say(const Event& event) { said_.push_back(event); }

void ServerCommands::Warn(const std::string& text) {
  said_.push_back(MakeEvent(EventKind::kWarning, text));
  warnings_.push_back(text);
}

bool ServerCommands::Present(int player) const {
  return sessions_.PeerOfPlayer()[static_cast<std::size_t>(player)] >= 0 ||
         std::count(assumed_.begin(), assumed_.end(), player) > 0;
}

Input ServerCommands::ReadInput(int player) const {
  return replica_.inputs(player).At(replica_.tick());
}

void ServerCommands::Ask(AnyEdit what) { Ask(Edit(std::move(what), EditCause::kOutside)); }

void ServerCommands::Ask(const Edit& edit) {
  const Status status = replica_.world().topology().Validate(edit);
  if (!status.ok()) throw ScriptRefusal(status.why());
  if (!edits_.Add(edit)) throw ScriptRefusal("too many edits are waiting");
}

}  // namespace seam
