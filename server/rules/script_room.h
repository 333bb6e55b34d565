#pragma once
/// A room for its scripts: uses names instead of numbers; throws ScriptRefusal for wrong requests.

#include <map>
#include <string>

#include "server/rules/rules.h"
#include "server/script/script_host.h"

namespace seam {

class ScriptRoom : public ScriptHost {
 public:
  explicit ScriptRoom(Rules& rules) : rules_(rules) {}

  std::int64_t Tick() const override { return rules_.world_.tick(); }
  float dt() const override { return rules_.world_.dt(); }
  bool ReadPart(const std::string& part, BodyState* state) const override;
  std::size_t PartCount() const override { return rules_.scene().parts.size(); }
  const std::string& PartName(std::size_t index) const override {
    return rules_.scene().parts[index].name;
  }
  std::size_t PlayerCount() const override { return rules_.scene().players.size(); }
  const std::string& PlayerName(std::size_t player) const override {
    return rules_.scene().players[player].name;
  }
  bool Present(const std::string& player) const override;
  Input ReadInput(const std::string& player) const override;
  const std::string& SeatOf(const std::string& player) const override;
  void Unseat(const std::string& player) override;
  void Push(const std::string& part, const Vec2& impulse, const std::string& why) override;
  void Limp(const std::string& character, float seconds) override;
  void Blast(const Vec2& centre, float radius, float speed, float impulse) override;
  void AddPart(const TomlNode& table) override;
  void AddJoint(const TomlNode& table) override;
  void Weld(const std::string& a, const std::string& b, float strength) override;
  void Unweld(const std::string& a, const std::string& b) override;
  void RemovePart(const std::string& part) override;
  void RemoveJoint(const std::string& joint) override;
  float Get(const std::string& subject, const std::string& key) const override;
  void Set(const std::string& subject, const std::string& key, float value) override;
  void Say(const std::string& text) override;

 private:
  /// Returns -1 if there is no part of this name now.
  PartId FindPart(const std::string& name) const;
  PartId NeedPart(const std::string& name) const;
  int NeedPlayer(const std::string& name) const;
  int FindSeat(int player) const;  ///< -1: it sits in none
  MetaKey KeyOf(const std::string& subject, const std::string& key) const;

  Rules& rules_;
  const std::string none_;
  // Names found so far; parts are only ever appended.
  mutable std::map<std::string, PartId> part_of_name_;
  mutable std::size_t parts_known_ = 0;
};

}  // namespace seam
