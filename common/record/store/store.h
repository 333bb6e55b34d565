#pragma once
/// A database of past sessions, their players, scores and events (SQLite). docs/persistence.md
/// describes the tables.

#include <cstdint>
#include <string>
#include <vector>

#include "common/base/status.h"
#include "common/codec/messages.h"

struct sqlite3;

namespace seam {

/// Part of a session to be kept. Everything in it must own its memory.
struct StoredSession {
  std::string room, scene, method;
  int tick_hz = 60;
  std::int64_t now_us = 0;    ///< since 1970
  Summary summary;            ///< the session's so far; takes the place of an earlier one
  std::vector<Event> events;  ///< since the last part
};

/// A line of a leaderboard: a name's sessions together.
struct StoredRank {
  std::string name;
  double best_score = 0, time_s = 0;
  std::int64_t sessions = 0;
};

/// A past session.
struct StoredLine {
  std::string session, room, scene, method, began, ended;  ///< began: UTC, "2026-11-29 07:00:00"
  double time_s = 0;
  std::int64_t players = 0, events = 0;
};

enum class RankBy { kScore, kTime };

class Store {
 public:
  enum class Use { kRead, kWrite };
  /// Opens a file; kWrite makes it if it is absent or empty, and brings an older one up to date.
  /// Throws OperatorError "PATH: ..." if it is another program's, of a newer version, or damaged.
  Store(const std::string& path, Use use);
  ~Store();
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;

  /// Adds a part of a session, all or nothing. Returns one line if it cannot be written.
  Status Put(const StoredSession& part);
  /// Return what seam-log top prints, the first `limit` lines. `scene` "": of all scenes. Throw
  /// OperatorError if the file cannot be read.
  std::vector<StoredRank> Ranks(const std::string& scene, RankBy by, int limit);
  std::vector<StoredLine> Sessions(const std::string& scene, int limit);

  /// Number of the newest migration (PRAGMA user_version).
  static const int kSchema;

 private:
  class Query;

  void Run(const std::string& sql);
  std::int64_t Number(const std::string& sql);
  void Migrate();
  void PutAll(const StoredSession& part);

  const std::string path_;
  sqlite3* db_ = nullptr;
};

}  // namespace seam
