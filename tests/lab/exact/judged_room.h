#pragma once
/// Read-only access of a script to a judged world. There is no room around it.

#include <map>
#include <string>

#include "common/physics/world.h"
#include "server/script/script_host.h"

namespace seam {

/// Changes by a script are ignored while it is loaded, since a game's script may begin with them;
/// afterwards they throw ScriptRefusal. No player has joined; values are 0.
class JudgedRoom : public ScriptHost {
 public:
  /// `scene`: its parts and players. It must outlive the room.
  explicit JudgedRoom(const Scene& scene);

  /// Sets the world to read; nullptr: none, there are no parts then.
  void Look(const World* world) { world_ = world; }
  void EndLoading() { loading_ = false; }
  /// -1 when there is none of this name.
  PartId FindPart(const std::string& name) const;

  std::int64_t Tick() const override { return world_ != nullptr ? world_->tick() : 0; }
  float dt() const override { return 1.0f / static_cast<float>(scene_.solver.tick_hz); }
  bool ReadPart(const std::string& part, BodyState* state) const override;
  std::size_t PartCount() const override { return scene_.parts.size(); }
  const std::string& PartName(std::size_t index) const override { return scene_.parts[index].name; }
  std::size_t PlayerCount() const override { return scene_.players.size(); }
  const std::string& PlayerName(std::size_t player) const override {
    return scene_.players[player].name;
  }
  bool Present(const std::string& /*player*/) const override { return false; }
  Input ReadInput(const std::string& /*player*/) const override { return {}; }
  const std::string& SeatOf(const std::string& /*player*/) const override { return none_; }
  float Get(const std::string& /*subject*/, const std::string& /*key*/) const override { return 0; }
  void Say(const std::string& /*text*/) override {}

  void Push(const std::string&, const Vec2&, const std::string&) override { Refuse(); }
  void Limp(const std::string&, float) override { Refuse(); }
  void Unseat(const std::string&) override { Refuse(); }
  void Blast(const Vec2&, float, float, float) override { Refuse(); }
  void AddPart(const TomlNode&) override { Refuse(); }
  void AddJoint(const TomlNode&) override { Refuse(); }
  void Weld(const std::string&, const std::string&, float) override { Refuse(); }
  void Unweld(const std::string&, const std::string&) override { Refuse(); }
  void RemovePart(const std::string&) override { Refuse(); }
  void RemoveJoint(const std::string&) override { Refuse(); }
  void Set(const std::string&, const std::string&, float) override { Refuse(); }

 private:
  void Refuse() const;

  const Scene& scene_;
  const World* world_ = nullptr;
  bool loading_ = true;
  const std::string none_;
  std::map<std::string, PartId> part_of_name_;
};

}  // namespace seam
