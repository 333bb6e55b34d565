/// Server, what it decides beyond motion: triggers, damage, scores, scripts, permissions.

#include <cmath>

#include "common/codec/codec.h"
#include "common/physics/part_places.h"
#include "common/scene/part_rules.h"
#include "server/rules/rules.h"
#include "server/script/script_host.h"
#include "server/server.h"

namespace seam {

/// What the rules ask for becomes edits, in the server's order and for outside causes: an oracle
/// cannot find them out by itself.
class Server::Commands : public RoomCommands {
 public:
  explicit Commands(Server& server) : server_(server) {}

  void RemovePart(PartId part) override {
    Edit edit;
    edit.kind = EditKind::kRemove;
    edit.a = part;
    Ask(edit);
  }
  void BreakJoint(int joint) override {
    Edit edit;
    edit.kind = EditKind::kBreak;
    edit.joint = joint;
    Ask(edit);
  }
  void Bond(PartId a, PartId b, float strength) override {
    Ask(BondAsTheyAre(server_.replica_.world(), a, b, strength));
  }
  void Push(PartId part, const Vec2& impulse) override {
    Edit edit;
    edit.kind = EditKind::kPush;
    edit.a = part;
    edit.x = impulse.x();
    edit.y = impulse.y();
    Ask(edit);
  }
  void Blast(const Vec2& centre, float radius, float speed) override {
    Edit edit;
    edit.kind = EditKind::kBlast;
    edit.x = centre.x();
    edit.y = centre.y();
    edit.amount = radius;
    edit.angle = speed;
    Ask(edit);
  }
  void Insert(const std::string& text) override {
    Edit edit;
    edit.kind = EditKind::kInsert;
    edit.text = text;
    Ask(edit);
  }
  void Say(const std::string& text) override { server_.Say(server_.rules_us_, text); }
  bool Present(int player) const override {
    return server_.PeerOfPlayer()[static_cast<std::size_t>(player)] >= 0;
  }
  Input ReadInput(int player) const override {
    return server_.replica_.inputs(player).At(server_.replica_.tick());
  }

 private:
  void Ask(Edit edit) {
    edit.cause = EditCause::kOutside;
    const std::string complaint = server_.replica_.world().topology().Complaint(edit);
    if (!complaint.empty()) throw ScriptRefusal(complaint);
    server_.Order(edit);
  }

  Server& server_;
};

void Server::MakeRules() {
  if (!Rules::Needed(scene_)) return;
  commands_ = std::make_unique<Commands>(*this);
  rules_ = std::make_unique<Rules>(replica_.world(), config_.seed, *commands_);
}

void Server::RunRules(std::int64_t now_us) {
  if (rules_ == nullptr) return;
  rules_us_ = now_us;
  rules_->AfterTick();
  for (const Meta& meta : rules_->TakeChanges(now_us)) {
    publisher_.Publish(meta);
    SendToAll(Encode(meta));
  }
}

void Server::SendRules(std::int64_t now_us, Session& session) {
  if (rules_ == nullptr) return;
  for (const Meta& meta : rules_->metadata().Export(now_us, replica_.tick())) {
    session.link.SendReliable(Encode(meta));
  }
}

}  // namespace seam
