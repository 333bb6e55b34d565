/// Reads [lcm].

#include <algorithm>
#include <set>

#include "common/scene/lcm/lcm_tables.h"
#include "common/scene/scene_draft.h"
#include "common/scene/toml/scene_text.h"

namespace seam {
namespace {

/// Reads the channels of a scene; each may be used once.
class Channels {
 public:
  std::string Read(const SceneReader& r) {
    const std::string channel = r.Text("channel");
    const Status status = CheckLcmChannel(channel);
    if (!status.ok()) r.FailAt("channel", status.why());
    if (!used_.insert(channel).second) {
      r.FailAt("channel",
               "channel '" + channel + "' is used by another table of [lcm]: each has its own");
    }
    return channel;
  }

 private:
  std::set<std::string> used_;
};

LcmPublishing ReadPublishing(const SceneReader& r, const SceneDraft& draft, Channels* channels) {
  LcmPublishing publishing;
  publishing.channel = channels->Read(r);
  for (const std::string& name : r.Texts("parts")) {
    for (const PartId part : FindParts(r, "parts", name, draft)) {
      const auto& parts = publishing.parts;
      if (std::find(parts.begin(), parts.end(), part) != parts.end()) {
        r.FailAt("parts", "parts: '" + name + "' names a part twice");
      }
      publishing.parts.push_back(part);
    }
  }
  if (publishing.parts.empty()) r.FailAt("parts", "needs parts: the names of one or more");
  if (publishing.parts.size() > kLcmPartsMax) r.FailAt("parts", "parts: at most 64 on a channel");
  if (r.Has("player")) publishing.player = FindPlayer(r, "player", r.Text("player"), draft);
  const int ticks = draft.scene.solver.tick_hz;
  publishing.rate_hz =
      static_cast<double>(r.Number("rate_hz", {0.1, kTickHzMax}, static_cast<float>(ticks)));
  if (publishing.rate_hz > ticks) {
    r.FailAt("rate_hz", "rate_hz is above the scene's " + std::to_string(ticks) +
                            " ticks per second (tick_hz)");
  }
  return publishing;
}

LcmDriving ReadDriving(const SceneReader& r, const SceneDraft& draft, const LcmTables& lcm,
                       Channels* channels) {
  LcmDriving driving;
  driving.channel = channels->Read(r);
  driving.player = FindPlayer(r, "player", r.Text("player"), draft);
  for (const LcmDriving& other : lcm.drive) {
    if (other.player == driving.player) {
      r.FailAt("player", "player '" + r.Text("player") + "' is driven by channel '" +
                             other.channel + "' already");
    }
  }
  return driving;
}

}  // namespace

Status CheckLcmChannel(const std::string& channel) {
  const bool plain = std::all_of(channel.begin(), channel.end(), [](unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.' || c == '/';
  });
  if (channel.empty() || channel.size() > kLcmChannelMax || !plain) {
    return Status::Error("channel must be 1 to 63 letters, digits or _ - . /");
  }
  const bool rooms = channel.rfind("SEAM.", 0) == 0;
  if (!rooms && channel != "LCM_SELF_TEST") return Status::Ok();
  return Status::Error("channel '" + channel + "' is used by " +
                       (rooms ? "the rooms themselves" : "LCM itself") + ": choose another name");
}

void ReadLcm(const SceneReader& root, SceneDraft* draft) {
  const TomlNode* const table = root.Table("lcm");
  if (table == nullptr) return;
  const SceneReader r(*table, draft->file, "lcm", {"publish", "drive", "message"});
  LcmTables lcm;
  Channels channels;
  const auto read = [&](const char* kind, const auto& add, auto... keys) {
    const std::vector<const TomlNode*> tables = r.Tables(kind);
    if (tables.size() > kLcmTablesMax) r.FailAt(kind, "at most 16 tables of a kind");
    for (const TomlNode* node : tables) {
      add(SceneReader(*node, draft->file, std::string("lcm.") + kind, {"channel", keys...}));
    }
  };
  read(
      "publish",
      [&](const SceneReader& p) { lcm.publish.push_back(ReadPublishing(p, *draft, &channels)); },
      "parts", "player", "rate_hz");
  read(
      "drive",
      [&](const SceneReader& d) { lcm.drive.push_back(ReadDriving(d, *draft, lcm, &channels)); },
      "player");
  read("message", [&](const SceneReader& m) {
    lcm.message.push_back(channels.Read(m));
    if (draft->scene.scripts.empty()) m.Fail("the scene has no script to get the messages");
  });
  draft->scene.lcm.Set(std::move(lcm));
}

}  // namespace seam
