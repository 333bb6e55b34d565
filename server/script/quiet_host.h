#pragma once
/// A host that answers a script's questions and ignores its requests: for the code of a script that
/// runs again when a saved room continues.

#include "server/script/script_host.h"

namespace seam {

class QuietHost : public ScriptHost {
 public:
  /// `host`, which answers, must outlive this.
  explicit QuietHost(const ScriptHost& host) : host_(host) {}

  std::int64_t Tick() const override { return host_.Tick(); }
  float dt() const override { return host_.dt(); }
  bool ReadPart(const std::string& part, BodyState* state) const override {
    return host_.ReadPart(part, state);
  }
  std::size_t PartCount() const override { return host_.PartCount(); }
  const std::string& PartName(std::size_t index) const override { return host_.PartName(index); }
  std::size_t PlayerCount() const override { return host_.PlayerCount(); }
  const std::string& PlayerName(std::size_t player) const override {
    return host_.PlayerName(player);
  }
  bool Present(const std::string& player) const override { return host_.Present(player); }
  Input ReadInput(const std::string& player) const override { return host_.ReadInput(player); }
  const std::string& SeatOf(const std::string& player) const override {
    return host_.SeatOf(player);
  }
  float Get(const std::string& subject, const std::string& key) const override {
    return host_.Get(subject, key);
  }

  void Push(const std::string&, const Vec2&, const std::string&) override {}
  void Limp(const std::string&, float) override {}
  void Unseat(const std::string&) override {}
  void Blast(const Vec2&, float, float, float) override {}
  void AddPart(const TomlNode&) override {}
  void AddJoint(const TomlNode&) override {}
  void Weld(const std::string&, const std::string&, float) override {}
  void Unweld(const std::string&, const std::string&) override {}
  void RemovePart(const std::string&) override {}
  void RemoveJoint(const std::string&) override {}
  void Set(const std::string&, const std::string&, float) override {}
  void Say(const std::string&) override {}

 private:
  const ScriptHost& host_;
};

}  // namespace seam
