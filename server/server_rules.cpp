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

  void RemovePart(PartId part) override { Ask(RemoveEdit{part}); }
  void BreakJoint(int joint) override { Ask(BreakEdit{joint}); }
  void Bond(PartId a, PartId b, float strength) override {
    Ask(BondAsTheyAre(server_.replica_.world(), a, b, strength));
  }
  void Push(PartId part, const Vec2& impulse) override { Ask(PushEdit{part, impulse}); }
  void Blast(const Vec2& centre, float radius, float speed) override {
    Ask(BlastEdit{centre, radius, speed});
  }
  void Insert(const std::string& text) override { Ask(InsertEdit{text}); }
  void Say(const std::string& text) override { server_.Say(server_.rules_us_, text); }
  bool Present(int player) const override {
    return server_.PeerOfPlayer()[static_cast<std::size_t>(player)] >= 0;
  }
  Input ReadInput(int player) const override {
    return server_.replica_.inputs(player).At(server_.replica_.tick());
  }

 private:
  void Ask(AnyEdit what) {
    const Edit edit(std::move(what), EditCause::kOutside);
    const Status status = server_.replica_.world().topology().Validate(edit);
    if (!status.ok()) throw ScriptRefusal(status.why());
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

void Server::ForbidPlanned() {
  const std::vector<Part>& parts = replica_.world().scene().parts;
  const std::vector<int> peers = PeerOfPlayer();
  for (const Part& part : parts) {
    if (part.rules->push == kEveryPlayer) continue;
    const int mechanism = MechanismOf(replica_.world(), part.id);
    if (mechanism < 0 || static_cast<std::size_t>(mechanism) >= plan_.size()) continue;
    PlannedAuthority& planned = plan_[static_cast<std::size_t>(mechanism)];
    for (std::size_t p = 0; p < peers.size(); ++p) {
      const bool has = planned.authority > 0 && peers[p] == planned.authority;
      if (has && !Allows(part.rules->push, static_cast<int>(p))) planned.authority = 0;
    }
  }
}

}  // namespace seam
