#include "render/export/session.h"

#include <algorithm>
#include <cmath>

#include "common/base/check.h"
#include "common/base/nearest.h"
#include "common/measure/contents/partial_views.h"
#include "common/record/damage.h"

namespace seam {
namespace {

std::vector<std::string> RootNames(const ExportSession& session) {
  std::vector<std::string> names;
  for (const auto& [id, name] : session.of) names.push_back(name);
  return names;
}

/// Finds the names of all bodies that any view shows.
void FindBodies(ExportSession* session) {
  std::set<PartId> shown;
  for (const auto& [peer, views] : session->recording.views) {
    for (const auto& [tick, view] : views) shown.insert(view.id.begin(), view.id.end());
  }
  for (const PartId id : shown) session->of[id] = session->PartName(id);
}

void ChooseBodies(const std::vector<std::string>& names, ExportSession* session) {
  if (names.empty()) return;
  const std::vector<std::string> known = RootNames(*session);
  for (const std::string& name : names) {
    if (std::count(known.begin(), known.end(), name) != 0) continue;
    const auto revision = session->revisions->At(0);
    for (const Part& part : revision->scene().parts) {
      const int of = part.name == name ? revision->AssemblyOf(part.id) : -1;
      if (of < 0) continue;
      const Assembly& body = revision->composition().assemblies[static_cast<std::size_t>(of)];
      if (body.anchored) throw OperatorError("--body " + name + ": never moves, no view shows it");
      throw OperatorError("--body " + name + ": is a part of the body '" +
                          session->PartName(body.id) + "': ask for that");
    }
    throw OperatorError("--body " + name + ": no view shows a body of this name (" +
                        Suggestion(name, known) + ")");
  }
  for (auto it = session->of.begin(); it != session->of.end();) {
    const bool chosen = std::count(names.begin(), names.end(), it->second) != 0;
    it = chosen ? std::next(it) : session->of.erase(it);
  }
}

void ChooseViews(const std::vector<std::string>& names, ExportSession* session) {
  if (names.empty()) return;
  auto& views = session->recording.views;
  std::vector<std::string> known;
  for (const auto& [peer, of_peer] : views) known.push_back(session->ViewName(peer));
  for (const std::string& name : names) {
    if (std::count(known.begin(), known.end(), name) != 0) continue;
    throw OperatorError("--view " + name + ": the recording has no view of this name (" +
                        Suggestion(name, known) + ")");
  }
  for (auto it = views.begin(); it != views.end();) {
    const bool chosen = std::count(names.begin(), names.end(), session->ViewName(it->first)) != 0;
    it = chosen ? std::next(it) : views.erase(it);
  }
}

/// True if the selected names exclude this peer's view.
bool LeftOut(const ExportSession& session, const std::vector<std::string>& names, int peer) {
  return !names.empty() && std::count(names.begin(), names.end(), session.ViewName(peer)) == 0;
}

/// Reports ticks that a view lacks between its first and its last, and a start or end that is more
/// than a second late or early.
void FindHoles(const Recording& recording, int peer, const std::map<std::int64_t, View>& views,
               ExportSession* session) {
  const std::string name = session->ViewName(peer);
  const std::int64_t first = views.begin()->first, last = views.rbegin()->first;
  const auto has = static_cast<std::int64_t>(views.size());
  if (has != last - first + 1) {
    session->lacking.push_back(name + " has views of " + std::to_string(has) + " of the " +
                               std::to_string(last - first + 1) + " ticks between its first and " +
                               "its last");
  }
  const int second = recording.room.tick_hz;
  if (first - recording.first_tick > second || recording.last_tick - last > second) {
    session->lacking.push_back(name + " has views of ticks " + std::to_string(first) + " to " +
                               std::to_string(last) + " of " +
                               std::to_string(recording.first_tick) + " to " +
                               std::to_string(recording.last_tick));
  }
}

/// Formats "no view of bob, cid"; of many names the first.
std::string AbsentViews(const ExportOptions& options, const ExportSession& session) {
  constexpr int kNamed = 8;
  std::string text;
  int absent = 0;
  const int players = static_cast<int>(session.scene.players.size());
  for (int peer = 0; peer <= players; ++peer) {
    if (session.recording.views.count(peer) != 0 || LeftOut(session, options.views, peer)) continue;
    if (++absent > kNamed) continue;
    text += (text.empty() ? "no view of " : ", ") + session.ViewName(peer);
  }
  return absent > kNamed ? text + " and " + std::to_string(absent - kNamed) + " more" : text;
}

void FindLacking(const ExportOptions& options, ExportSession* session) {
  const Recording& recording = session->recording;
  const std::string sessions = ChosenSession(recording);
  if (!sessions.empty()) session->lacking.push_back(sessions);
  for (const std::string& line : DamageLines(recording)) session->lacking.push_back(line);
  session->damaged = session->damaged || IsDamaged(recording);
  const std::string absent = AbsentViews(options, *session);
  if (!absent.empty()) session->lacking.push_back(absent);
  const std::string partial = PartialViewsText(PartialViews(session->scene, recording),
                                               [&](int peer) { return session->ViewName(peer); });
  if (!partial.empty()) session->lacking.push_back(partial);
  for (const auto& [peer, views] : recording.views) FindHoles(recording, peer, views, session);
}

/// Finds the oracle of the whole session; without one the rest is still exported.
void FindOracle(const ExportOptions& options, ExportSession* session) {
  const Recording& recording = session->recording;
  if (!options.oracle.empty()) {
    const Recording truth = ReadRecording(options.oracle);
    for (const std::string& line : DamageLines(truth)) {
      session->lacking.push_back(options.oracle + ": " + line);
    }
    session->damaged = IsDamaged(truth);
    RequireOracleOf(truth.room, options.oracle, recording.room, options.log);
    session->oracle = OracleFromRecording(truth);
    return;
  }
  if (recording.views.empty()) return;
  try {
    session->oracle = ComputeOracle(recording, JudgeOf(recording.room));
  } catch (const OperatorError& e) {
    session->lacking.push_back(std::string("no errors: ") + e.what());
  }
}

}  // namespace

std::string ExportSession::ViewName(int peer) const {
  if (peer == 0) return "server";
  if (peer < 1 || static_cast<std::size_t>(peer) > scene.players.size()) {
    return "peer " + std::to_string(peer);
  }
  const std::string& name = scene.players[static_cast<std::size_t>(peer - 1)].name;
  return name == "server" ? "peer " + std::to_string(peer) : name;
}

std::string ExportSession::PlayerName(int index) const {
  const auto i = static_cast<std::size_t>(index);
  if (index >= 0 && i < scene.players.size()) return scene.players[i].name;
  if (index >= 0 && i - scene.players.size() < scene.seats.size()) {
    return scene.seats[i - scene.players.size()].name;
  }
  return "player " + std::to_string(index);
}

std::string ExportSession::PartName(PartId part) const {
  const auto last = revisions->At(std::numeric_limits<int>::max());
  const std::vector<Part>& parts = last->scene().parts;
  const auto i = static_cast<std::size_t>(part);
  if (part < 0 || i >= parts.size() || parts[i].name.empty()) {
    return "part " + std::to_string(part);
  }
  return parts[i].name;
}

ExportSession LoadExport(const ExportOptions& options) {
  ExportSession session;
  session.recording = ReadRecording(options.log, options.room, options.session);
  session.range = options.range;
  const Room& room = session.recording.room;
  if (room.tick_hz < 1) throw OperatorError(options.log + ": the room's tick rate is missing");
  session.scene = ParseScene(room.scene_text, room.scene_name + ".toml");
  session.revisions = std::make_unique<RevisionHistory>(session.scene, session.recording);
  FindBodies(&session);
  ChooseBodies(options.bodies, &session);
  ChooseViews(options.views, &session);
  RequireRange(options.range, session.recording, options.log);
  FindOracle(options, &session);
  KeepRange(options.range, &session.recording);
  FindLacking(options, &session);
  for (const auto& [id, name] : session.of) session.bodies.push_back({id, name});
  return session;
}

std::vector<ExportRow> RowsOf(const ExportSession& session, const View& view) {
  std::vector<ExportRow> rows;
  for (std::size_t i = 0; i < view.id.size(); ++i) {
    if (session.of.count(view.id[i]) == 0) continue;
    ExportRow row{&view, i, view.id[i], std::nullopt};
    const auto truth = session.oracle ? session.oracle->At(view.tick, row.id) : std::nullopt;
    if (truth) {
      row.error_m = std::hypot(double{view.x[i]} - double{truth->position.x()},
                               double{view.y[i]} - double{truth->position.y()});
    }
    rows.push_back(row);
  }
  return rows;
}

void ForEachView(const ExportSession& session, const std::function<void(const View&)>& take) {
  const Recording& recording = session.recording;
  for (std::int64_t tick = recording.first_tick; tick <= recording.last_tick; ++tick) {
    for (const auto& [peer, views] : recording.views) {
      const View* view = FindView(views, tick);
      if (view != nullptr) take(*view);
    }
    session.progress(tick - recording.first_tick + 1,
                     recording.last_tick - recording.first_tick + 1);
  }
}

}  // namespace seam
