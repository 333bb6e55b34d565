#include "common/record/store/store.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include "common/base/check.h"
#include "common/base/plain_file.h"
#include "common/record/events/event_text.h"
#include "common/record/events/summary_text.h"

namespace seam {
namespace {

/// PRAGMA application_id of our files: "S2Ds".
constexpr std::int64_t kApplicationId = 0x53324473;
/// Longest wait for another program that has the file locked, ms.
constexpr int kLockedMs = 5000;

/// Migration n brings a file of version n to n + 1. Never changed once released.
constexpr const char* kMigrations[] = {
    "CREATE TABLE sessions (id INTEGER PRIMARY KEY, session TEXT NOT NULL UNIQUE,"
    " room TEXT NOT NULL, scene TEXT NOT NULL, method TEXT NOT NULL, tick_hz INTEGER NOT NULL,"
    " began_us INTEGER NOT NULL, newest_us INTEGER NOT NULL, ended TEXT NOT NULL,"
    " time_s REAL NOT NULL, ticks INTEGER NOT NULL, late_ticks INTEGER NOT NULL,"
    " edits INTEGER NOT NULL, hand_overs INTEGER NOT NULL, events INTEGER NOT NULL,"
    " events_dropped INTEGER NOT NULL);"
    "CREATE TABLE players (session_id INTEGER NOT NULL REFERENCES sessions(id),"
    " name TEXT NOT NULL, player INTEGER, joins INTEGER NOT NULL, rejoins INTEGER NOT NULL,"
    " time_s REAL NOT NULL, bytes_in INTEGER NOT NULL, bytes_out INTEGER NOT NULL,"
    " rtt_us INTEGER, loss_ppm INTEGER, corrections INTEGER NOT NULL, dropped INTEGER NOT NULL,"
    " hand_overs INTEGER NOT NULL, trust TEXT NOT NULL, PRIMARY KEY (session_id, name));"
    "CREATE TABLE scores (session_id INTEGER NOT NULL REFERENCES sessions(id),"
    " name TEXT NOT NULL, score REAL NOT NULL, PRIMARY KEY (session_id, name));"
    "CREATE TABLE events (session_id INTEGER NOT NULL REFERENCES sessions(id),"
    " tick INTEGER NOT NULL, kind TEXT NOT NULL, client INTEGER, player INTEGER, body INTEGER,"
    " other INTEGER, \"index\" INTEGER, value REAL NOT NULL, text TEXT NOT NULL);"
    "CREATE INDEX events_of ON events (session_id, tick);"};

const char* EndText(std::int8_t ended) {
  return ended == static_cast<std::int8_t>(Ended::kNot)     ? "running"
         : ended == static_cast<std::int8_t>(Ended::kEnded) ? "ended"
                                                            : "killed";
}

}  // namespace

const int Store::kSchema = sizeof kMigrations / sizeof kMigrations[0];

/// A statement. Throws OperatorError, with the file's name, for every failure.
class Store::Query {
 public:
  Query(const Store& store, const std::string& sql) : store_(store) {
    Check(sqlite3_prepare_v2(store.db_, sql.c_str(), -1, &statement_, nullptr));
  }
  ~Query() { sqlite3_finalize(statement_); }
  Query(const Query&) = delete;
  Query& operator=(const Query&) = delete;

  Query& Bind(std::int64_t value) {
    Check(sqlite3_bind_int64(statement_, ++bound_, value));
    return *this;
  }
  Query& Bind(double value) {
    Check(sqlite3_bind_double(statement_, ++bound_, value));
    return *this;
  }
  Query& Bind(const std::string& text) {
    Check(sqlite3_bind_text(statement_, ++bound_, text.c_str(), static_cast<int>(text.size()),
                            SQLITE_TRANSIENT));
    return *this;
  }
  /// Binds NULL if the value is -1.
  Query& BindKnown(std::int64_t value) {
    if (value >= 0) return Bind(value);
    Check(sqlite3_bind_null(statement_, ++bound_));
    return *this;
  }
  /// Returns true if there is a row.
  bool Step() {
    const int result = sqlite3_step(statement_);
    if (result != SQLITE_ROW && result != SQLITE_DONE) Check(result);
    return result == SQLITE_ROW;
  }
  std::int64_t Integer(int column) const { return sqlite3_column_int64(statement_, column); }
  double Real(int column) const { return sqlite3_column_double(statement_, column); }
  std::string Text(int column) const {
    const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement_, column));
    return text == nullptr ? "" : text;
  }

 private:
  void Check(int result) const {
    if (result != SQLITE_OK) throw OperatorError(store_.path_ + ": " + sqlite3_errmsg(store_.db_));
  }

  const Store& store_;
  sqlite3_stmt* statement_ = nullptr;
  int bound_ = 0;
};

Store::Store(const std::string& path, Use use) : path_(path) {
  RequirePlainFile(path);
  const int flags = SQLITE_OPEN_READWRITE | (use == Use::kWrite ? SQLITE_OPEN_CREATE : 0);
  const auto fail = [&](const std::string& why) {
    sqlite3_close(db_);
    throw OperatorError(why);
  };
  if (sqlite3_open_v2(path.c_str(), &db_, flags, nullptr) != SQLITE_OK) {
    fail(path + ": " + (db_ != nullptr ? sqlite3_errmsg(db_) : "no memory"));
  }
  sqlite3_busy_timeout(db_, kLockedMs);
  try {
    const std::int64_t tables = Number("SELECT count(*) FROM sqlite_master");
    const std::int64_t program = Number("PRAGMA application_id");
    const std::int64_t version = Number("PRAGMA user_version");
    const bool empty = tables == 0 && program == 0 && version == 0;
    if (program != kApplicationId && !(empty && use == Use::kWrite)) {
      throw OperatorError(path + ": is not a store of seam-server");
    }
    if (version > kSchema) {
      throw OperatorError(fmt::format("{}: is of a newer version ({}; this program knows {})", path,
                                      version, kSchema));
    }
    Query check(*this, "PRAGMA quick_check(1)");
    if (!check.Step() || check.Text(0) != "ok") {
      throw OperatorError(path + ": is damaged: " + check.Text(0));
    }
  } catch (const OperatorError& error) {
    fail(error.what());
  }
  try {
    if (use == Use::kWrite) Migrate();
  } catch (const OperatorError& error) {
    fail(error.what());
  }
}

Store::~Store() { sqlite3_close(db_); }

void Store::Run(const std::string& sql) {
  if (sqlite3_exec(db_, sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK) return;
  throw OperatorError(path_ + ": " + sqlite3_errmsg(db_));
}

std::int64_t Store::Number(const std::string& sql) {
  Query query(*this, sql);
  return query.Step() ? query.Integer(0) : 0;
}

void Store::Migrate() {
  Run("BEGIN IMMEDIATE");  // of two programs that begin at once, the second one finds it done
  try {
    for (std::int64_t n = Number("PRAGMA user_version"); n < kSchema; ++n) {
      Run(kMigrations[n]);
      Run("PRAGMA user_version = " + std::to_string(n + 1));
    }
    Run("PRAGMA application_id = " + std::to_string(kApplicationId));
    Run("COMMIT");
  } catch (const OperatorError&) {
    sqlite3_exec(db_, "ROLLBACK", nullptr, nullptr, nullptr);
    throw;
  }
}

Status Store::Put(const StoredSession& part) {
  try {
    Run("BEGIN IMMEDIATE");
    PutAll(part);
    Run("COMMIT");
  } catch (const OperatorError& error) {
    const std::string why = error.what();
    sqlite3_exec(db_, "ROLLBACK", nullptr, nullptr, nullptr);
    return Status::Error(why);
  }
  return Status::Ok();
}

void Store::PutAll(const StoredSession& part) {
  const Summary& sum = part.summary;
  const std::string session = fmt::format("{:016x}", static_cast<std::uint64_t>(sum.of));
  Query(*this,
        "INSERT INTO sessions (session, room, scene, method, tick_hz, began_us, newest_us, ended,"
        " time_s, ticks, late_ticks, edits, hand_overs, events, events_dropped)"
        " VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?,?) ON CONFLICT (session) DO UPDATE SET"
        " newest_us = excluded.newest_us, ended = excluded.ended, time_s = excluded.time_s,"
        " ticks = excluded.ticks, late_ticks = excluded.late_ticks, edits = excluded.edits,"
        " hand_overs = excluded.hand_overs, events = excluded.events,"
        " events_dropped = excluded.events_dropped")
      .Bind(session)
      .Bind(part.room)
      .Bind(part.scene)
      .Bind(part.method)
      .Bind(std::int64_t{part.tick_hz})
      .Bind(part.now_us)
      .Bind(part.now_us)
      .Bind(std::string(EndText(sum.ended)))
      .Bind(static_cast<double>(sum.ticks) / part.tick_hz)
      .Bind(sum.ticks)
      .Bind(sum.late_ticks)
      .Bind(sum.edits)
      .Bind(sum.hand_overs)
      .Bind(sum.events)
      .Bind(sum.events_dropped)
      .Step();
  Query find(*this, "SELECT id FROM sessions WHERE session = ?");
  find.Bind(session).Step();
  const std::int64_t id = find.Integer(0);
  const std::vector<std::string> names = NamesOf(sum);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::int64_t dropped =
        sum.malformed[i] + sum.stale[i] + sum.right[i] + sum.implausible[i] + sum.budget[i];
    Query(*this, "INSERT OR REPLACE INTO players VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?)")
        .Bind(id)
        .Bind(names[i])
        .BindKnown(sum.player[i])
        .Bind(std::int64_t{sum.joins[i]})
        .Bind(std::int64_t{sum.rejoins[i]})
        .Bind(static_cast<double>(sum.present_ticks[i]) / part.tick_hz)
        .Bind(sum.bytes_in[i])
        .Bind(sum.bytes_out[i])
        .BindKnown(sum.rtt_us[i])
        .BindKnown(sum.loss_ppm[i])
        .Bind(sum.corrections[i])
        .Bind(dropped)
        .Bind(sum.hand_overs_to[i])
        .Bind(std::string(TrustStepName(sum.trust[i])))
        .Step();
    if (sum.player[i] < 0) continue;
    Query(*this, "INSERT OR REPLACE INTO scores VALUES (?,?,?)")
        .Bind(id)
        .Bind(names[i])
        .Bind(double{sum.score[i]})
        .Step();
  }
  for (const Event& event : part.events) {
    Query(*this, "INSERT INTO events VALUES (?,?,?,?,?,?,?,?,?,?)")
        .Bind(id)
        .Bind(event.tick)
        .Bind(std::string(EventKindName(event.kind)))
        .BindKnown(event.client)
        .BindKnown(event.player)
        .BindKnown(event.body)
        .BindKnown(event.other)
        .BindKnown(event.index)
        .Bind(static_cast<double>(event.value_milli) * 1e-3)
        .Bind(event.text)
        .Step();
  }
}

std::vector<StoredRank> Store::Ranks(const std::string& scene, RankBy by, int limit) {
  Query query(*this, std::string("SELECT scores.name, max(score), sum(players.time_s), count(*)"
                                 " FROM scores JOIN players USING (session_id, name)"
                                 " JOIN sessions ON sessions.id = session_id"
                                 " WHERE ?1 = '' OR scene = ?1 GROUP BY scores.name ORDER BY ") +
                         (by == RankBy::kScore ? "2 DESC, 3" : "3 DESC, 2 DESC") + ", 1 LIMIT ?2");
  query.Bind(scene).Bind(std::int64_t{limit});
  std::vector<StoredRank> ranks;
  while (query.Step()) {
    ranks.push_back({query.Text(0), query.Real(1), query.Real(2), query.Integer(3)});
  }
  return ranks;
}

std::vector<StoredLine> Store::Sessions(const std::string& scene, int limit) {
  Query query(*this,
              "SELECT session, room, scene, method, datetime(began_us / 1000000, 'unixepoch'),"
              " ended, time_s, (SELECT count(*) FROM scores WHERE session_id = id), events"
              " FROM sessions WHERE ?1 = '' OR scene = ?1 ORDER BY began_us DESC, id DESC"
              " LIMIT ?2");
  query.Bind(scene).Bind(std::int64_t{limit});
  std::vector<StoredLine> lines;
  while (query.Step()) {
    lines.push_back({query.Text(0), query.Text(1), query.Text(2), query.Text(3), query.Text(4),
                     query.Text(5), query.Real(6), query.Integer(7), query.Integer(8)});
  }
  return lines;
}

}  // namespace seam
