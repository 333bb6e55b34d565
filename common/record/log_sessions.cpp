#include "common/record/log_sessions.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <variant>

#include "common/base/check.h"
#include "common/codec/codec.h"
#include "common/record/log_file.h"
#include "common/record/recorder.h"

namespace seam {
namespace {

/// Returns how a session was played: "crossing, buffer/fade, 4g, seed 2".
std::string HowPlayed(const Room& room) {
  const std::string variant = room.reconcile + room.predict;
  return fmt::format("{}, {}{}{}, {}, seed {}", room.scene_name, room.mode,
                     variant.empty() ? "" : "/", variant, room.impair, room.seed);
}

std::string IdText(const LogSession& session) {
  return fmt::format("{:016x}", static_cast<std::uint64_t>(session.id));
}

}  // namespace

std::vector<LogSession> ListSessions(const std::string& path, const std::string& room) {
  std::vector<LogSession> sessions;
  std::map<std::int64_t, std::size_t> index;
  std::string wanted = room;
  LogReader reader(path);
  for (LogEvent event; reader.Next(&event);) {
    const std::string of = RoomOfChannel(event.channel);
    const auto id = of.empty() ? std::nullopt : SessionOf(event.data);
    if (!id) continue;
    if (wanted.empty()) wanted = of;
    if (of != wanted) continue;
    const auto [place, added] = index.try_emplace(*id, sessions.size());
    if (added) sessions.emplace_back().id = *id;
    LogSession& session = sessions[place->second];
    ++session.events;
    if (!session.room.room.empty()) continue;
    AnyMessage message = Decode(event.data);
    if (auto* found = std::get_if<Room>(&message)) session.room = std::move(*found);
  }
  sessions.erase(std::remove_if(sessions.begin(), sessions.end(),
                                [](const LogSession& s) { return s.room.room.empty(); }),
                 sessions.end());
  return sessions;
}

std::size_t ChooseSession(const std::vector<LogSession>& sessions, const std::string& choice,
                          const std::string& path) {
  if (choice.empty()) return sessions.size() - 1;
  for (std::size_t i = 0; i < sessions.size(); ++i) {
    if (choice == std::to_string(i + 1) || choice == IdText(sessions[i])) return i;
  }
  throw OperatorError("--session " + choice + ": " + path + " has " + SessionsText(sessions));
}

std::string SessionsText(const std::vector<LogSession>& sessions) {
  std::string text = fmt::format("{} session{}:", sessions.size(), sessions.size() == 1 ? "" : "s");
  for (std::size_t i = 0; i < sessions.size(); ++i) {
    text += fmt::format("{} {} ({}, {} events)", i == 0 ? "" : ",", i + 1,
                        HowPlayed(sessions[i].room), sessions[i].events);
  }
  return text;
}

void CheckSessions(const std::vector<std::string>& choices, std::size_t logs) {
  if (choices.empty() || choices.size() == logs) return;
  throw OperatorError(fmt::format("--session has {} value{} for {} log{}: say one for each log",
                                  choices.size(), choices.size() == 1 ? "" : "s", logs,
                                  logs == 1 ? "" : "s"));
}

}  // namespace seam
