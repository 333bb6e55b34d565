#pragma once
/// Commands of a room's rules. Each becomes an edit in the server's order, with an outside cause,
/// since an oracle cannot find it by itself.

#include <string>
#include <utility>
#include <vector>

#include "common/sync/replica.h"
#include "server/edits/edit_log.h"
#include "server/rules/rules.h"
#include "server/sessions/session_table.h"

namespace seam {

class ServerCommands : public RoomCommands {
 public:
  /// All must outlive this object.
  ServerCommands(Replica& replica, EditLog& edits, const SessionTable& sessions)
      : replica_(replica), edits_(edits), sessions_(sessions) {}

  void RemovePart(PartId part) override;
  void BreakJoint(int joint) override;
  void Bond(PartId a, PartId b, float strength) override;
  void Push(PartId part, const Vec2& impulse) override;
  void Limp(PartId part, float seconds) override;
  void LeaveSeat(int seat) override;
  void Blast(const Vec2& centre, float radius, float speed, float impulse) override;
  void Insert(const std::string& text) override;
  void Say(const Event& event) override;
  void Warn(const std::string& text) override;
  bool Present(int player) const override;
  Input ReadInput(int player) const override;

  /// Makes these players present besides those with a session, until the next call.
  void AssumePresent(const std::vector<int>& players) { assumed_ = players; }
  /// Returns the events said since the last call, warnings included.
  std::vector<Event> TakeSaid() { return std::exchange(said_, {}); }
  std::vector<std::string> TakeWarnings() { return std::exchange(warnings_, {}); }

 private:
  void Ask(AnyEdit what);
  void Ask(const Edit& edit);

  Replica& replica_;
  EditLog& edits_;
  const SessionTable& sessions_;
  std::vector<Event> said_;
  std::vector<std::string> warnings_;
  std::vector<int> assumed_;  // players
};

}  // namespace seam
