#include "server/server_commands.h"

#include "common/physics/part_places.h"
#include "server/script/script_host.h"

namespace seam {

void ServerCommands::RemovePart(PartId part) {
  Edit edit;
  edit.kind = EditKind::kRemove;
  edit.a = part;
  Ask(edit);
}

void ServerCommands::BreakJoint(int joint) {
  Edit edit;
  edit.kind = EditKind::kBreak;
  edit.joint = joint;
  Ask(edit);
}

void ServerCommands::Bond(PartId a, PartId b, float strength) {
  Ask(BondAsTheyAre(replica_.world(), a, b, strength));
}

void ServerCommands::Push(PartId part, const Vec2& impulse) {
  Edit edit;
  edit.kind = EditKind::kPush;
  edit.a = part;
  edit.x = impulse.x();
  edit.y = impulse.y();
  Ask(edit);
}

void ServerCommands::Blast(const Vec2& centre, float radius, float speed) {
  Edit edit;
  edit.kind = EditKind::kBlast;
  edit.x = centre.x();
  edit.y = centre.y();
  edit.amount = radius;
  edit.angle = speed;
  Ask(edit);
}

void ServerCommands::Insert(const std::string& text) {
  Edit edit;
  edit.kind = EditKind::kInsert;
  edit.text = text;
  Ask(edit);
}

void ServerCommands::Say(const std::string& text) { said_.push_back(text); }

bool ServerCommands::Present(int player) const {
  return sessions_.PeerOfPlayer()[static_cast<std::size_t>(player)] >= 0;
}

Input ServerCommands::ReadInput(int player) const {
  return replica_.inputs(player).At(replica_.tick());
}

void ServerCommands::Ask(Edit edit) {
  edit.cause = EditCause::kOutside;
  const std::string complaint = replica_.world().topology().Complaint(edit);
  if (!complaint.empty()) throw ScriptRefusal(complaint);
  edits_.Add(edit);
}

}  // namespace seam
