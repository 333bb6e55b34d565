#pragma once
/// A fake room for scripts: parts and players by name, and a list of the requested actions.

#include <map>
#include <string>
#include <vector>

#include "common/scene/part_rules.h"
#include "server/script/script.h"

namespace seam {

class FakeHost : public ScriptHost {
 public:
  std::int64_t tick = 0;
  std::vector<std::string> parts{"ball", "crate.0", "crate.1"};
  std::map<std::string, BodyState> states{
      {"ball", {{1, 2}, 0.5f, {3, 4}, 5}}, {"crate.0", {}}, {"crate.1", {}}};
  const std::string seat = "cab", none;
  std::vector<std::string> players{"ann", "bob"};
  std::map<std::string, float> values;
  std::vector<std::string> asked;  ///< in order
  std::vector<std::string> said;

  std::int64_t Tick() const override { return tick; }
  float dt() const override { return 1.0f / 60; }
  bool ReadPart(const std::string& part, BodyState* state) const override {
    const auto found = states.find(part);
    if (found == states.end()) return false;
    *state = found->second;
    return true;
  }
  std::size_t PartCount() const override { return parts.size(); }
  const std::string& PartName(std::size_t index) const override { return parts[index]; }
  std::size_t PlayerCount() const override { return players.size(); }
  const std::string& PlayerName(std::size_t player) const override { return players[player]; }
  bool Present(const std::string& player) const override { return player == "ann"; }
  Input ReadInput(const std::string& player) const override {
    if (player != "ann") throw ScriptRefusal("there is no player '" + player + "'");
    return Input{127, -127, 5};
  }
  const std::string& SeatOf(const std::string& player) const override {
    return player == "ann" ? seat : none;
  }
  void Unseat(const std::string& player) override { asked.push_back("unseat " + player); }
  void Push(const std::string& part, const Vec2& impulse, const std::string& why) override {
    if (states.count(part) == 0) throw ScriptRefusal("there is no part '" + part + "'");
    asked.push_back("push " + part + " " + Text(impulse.x()) + " " + Text(impulse.y()) + " " + why);
  }
  void Limp(const std::string& character, float seconds) override {
    asked.push_back("limp " + character + " " + std::to_string(seconds));
  }
  void Blast(const Vec2& centre, float radius, float speed, float impulse) override {
    asked.push_back("blast " + Text(centre.x()) + " " + Text(centre.y()) + " " + Text(radius) +
                    " " + Text(speed) + " " + Text(impulse));
  }
  void AddPart(const TomlNode& table) override { asked.push_back("add part " + Text(table)); }
  void AddJoint(const TomlNode& table) override { asked.push_back("add joint " + Text(table)); }
  void Weld(const std::string& a, const std::string& b, float strength) override {
    asked.push_back("weld " + a + " " + b + " " + Text(static_cast<double>(strength)));
  }
  void Unweld(const std::string& a, const std::string& b) override {
    asked.push_back("unweld " + a + " " + b);
  }
  void RemovePart(const std::string& part) override {
    states.erase(part);
    asked.push_back("remove part " + part);
  }
  void RemoveJoint(const std::string& joint) override { asked.push_back("remove joint " + joint); }
  float Get(const std::string& subject, const std::string& key) const override {
    const auto found = values.find(subject + "." + key);
    return found != values.end() ? found->second : 0;
  }
  void Set(const std::string& subject, const std::string& key, float value) override {
    values[subject + "." + key] = value;
  }
  void Say(const std::string& text) override { said.push_back(text); }

  static std::string Text(double number) {
    char text[40];
    std::snprintf(text, sizeof text, "%g", number);
    return text;
  }
  static std::string Text(const TomlNode& node) {
    switch (node.kind) {
      case TomlNode::Kind::kBoolean: return node.boolean ? "true" : "false";
      case TomlNode::Kind::kInteger:
      case TomlNode::Kind::kNumber: return Text(node.number);
      case TomlNode::Kind::kText: return node.text;
      case TomlNode::Kind::kArray: {
        std::string all = "[";
        for (const TomlNode& item : node.items) all += Text(item) + " ";
        return all + "]";
      }
      default: break;
    }
    std::string all = "{";
    for (const auto& [key, member] : node.members) all += key + "=" + Text(member) + " ";
    return all + "}";
  }
};

/// A script whose code begins on line 10 of s.toml.
struct FakeRoom {
  explicit FakeRoom(const std::string& code, const ScriptLimits& limits = {})
      : script({"test", code, 10, limits}, "s.toml", 1, host) {}
  void Step() {
    script.BeginTick();
    ++host.tick;
    script.OnTick(static_cast<double>(host.tick) / 60);
  }
  FakeHost host;
  Script script;
};

}  // namespace seam
