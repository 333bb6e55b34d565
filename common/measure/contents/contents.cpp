#include "common/measure/contents/contents.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "common/base/check.h"
#include "common/measure/contents/partial_views.h"
#include "common/measure/revisions.h"
#include "common/record/time_range.h"
#include "common/scene/assembly.h"
#include "common/scene/toml/scene_text.h"
#include "common/sync/method.h"

namespace seam {
namespace {

constexpr std::size_t kEventsShown = 20;

/// Formats a line of the list: "label      text".
std::string Line(const char* label, const std::string& text) {
  return fmt::format("  {:<10} {}\n", label, text);
}

/// Formats a count with its noun: "3 crates", "1 crate".
std::string Count(std::size_t count, const char* one, const char* many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string Views(const Scene& scene, const Recording& recording) {
  std::string text;
  for (const auto& [peer, views] : recording.views) {
    text += fmt::format("{}{} {} ({} to {})", text.empty() ? "" : ", ", ViewNameOf(scene, peer),
                        views.size(), views.begin()->first, views.rbegin()->first);
  }
  return text.empty() ? "none" : text + " by tick";
}

/// Lists the players with a view, and the first of those without.
std::string Players(const Scene& scene, const Recording& recording) {
  constexpr int kAbsentNamed = 8;
  std::string text;
  int absent = 0;
  for (std::size_t p = 0; p < scene.players.size(); ++p) {
    const bool seen = recording.views.count(static_cast<int>(p) + 1) != 0;
    if (!seen && ++absent > kAbsentNamed) continue;
    text += (text.empty() ? "" : ", ") + scene.players[p].name + (seen ? "" : " (no view)");
  }
  if (absent > kAbsentNamed) {
    text += fmt::format(" and {} more without a view", absent - kAbsentNamed);
  }
  return text.empty() ? "none" : text;
}

std::string Bodies(const Scene& scene, const Recording& recording) {
  std::size_t most = 0, first = 0;
  for (const auto& [peer, views] : recording.views) {
    if (first == 0 && !views.empty()) first = views.begin()->second.id.size();
    for (const auto& [tick, view] : views) most = std::max(most, view.id.size());
  }
  const std::string more = most > first ? fmt::format(", {} at most", most) : "";
  return fmt::format("{} moving at first{}; the scene has {} and {}", first, more,
                     Count(scene.parts.size(), "part", "parts"),
                     Count(scene.joints.size(), "joint", "joints"));
}

std::string Messages(const Recording& recording) {
  std::size_t inputs = 0, stats = 0;
  for (const auto& [player, messages] : recording.inputs) inputs += messages.size();
  for (const auto& [peer, messages] : recording.stats) stats += messages.size();
  return fmt::format("{} states, {} inputs, {} grants, {} edits, {} values, {} impacts, {} stats",
                     recording.states.size(), inputs, recording.grants.size(),
                     recording.edits.size(), recording.meta.size(), recording.impacts.size(),
                     stats);
}

std::string Method(const Room& room) {
  const std::string variant = VariantOf(room);
  return fmt::format("{}{}{}, network {}, seed {}, {} states/s, input delay {} ticks",
                     Printable(room.mode), variant.empty() ? "" : "/", Printable(variant),
                     Printable(room.impair), room.seed, room.send_hz, room.input_delay_ticks);
}

std::string Events(const Recording& recording, int tick_hz) {
  if (recording.events.empty()) return Line("events", "none");
  std::string text = Line("events", std::to_string(recording.events.size()));
  for (std::size_t i = 0; i < std::min(kEventsShown, recording.events.size()); ++i) {
    const Event& event = recording.events[i];
    const double now_s = static_cast<double>(event.tick) / tick_hz;
    text += fmt::format("    {:8.2f} s  {}\n", now_s, Printable(event.text));
  }
  if (recording.events.size() > kEventsShown) {
    text += fmt::format("    and {} more\n", recording.events.size() - kEventsShown);
  }
  return text;
}

}  // namespace

std::string ViewNameOf(const Scene& scene, int peer) {
  if (peer == 0) return "server";
  const auto player = static_cast<std::size_t>(peer) - 1;
  return peer > 0 && player < scene.players.size() ? scene.players[player].name
                                                   : fmt::format("peer {}", peer);
}

std::string FormatContents(const std::string& name, const Recording& recording) {
  const Room& room = recording.room;
  const int tick_hz = std::max(1, room.tick_hz);
  const std::int64_t ticks = std::max<std::int64_t>(0, recording.last_tick - recording.first_tick);
  std::string text = fmt::format("{}: {}, {:.2f} s, ticks {} to {} at {} Hz\n", Printable(name),
                                 Printable(room.scene_name), static_cast<double>(ticks) / tick_hz,
                                 recording.first_tick, recording.last_tick, room.tick_hz);
  text += Line("method", Method(room));
  const std::string sessions = ChosenSession(recording);
  if (!sessions.empty()) text += Line("sessions", sessions);
  try {
    const Scene scene = RecordedScene(room);
    if (!scene.title.empty()) text += Line("title", Printable(scene.title));
    text += Line("players", Players(scene, recording));
    text += Line("views", Views(scene, recording));
    text += Line("bodies", Bodies(scene, recording));
    const std::string partial = PartialViewsText(PartialViews(scene, recording),
                                                 [&](int peer) { return ViewNameOf(scene, peer); });
    if (!partial.empty()) text += Line("partial", partial);
  } catch (const OperatorError& error) {
    text += Line("scene", std::string("cannot be read: ") + error.what());
  }
  text += Line("messages", Messages(recording));
  const std::string damage = DamageOf(recording);
  if (!damage.empty()) text += Line("damage", damage);
  return text + Events(recording, tick_hz);
}

}  // namespace seam
