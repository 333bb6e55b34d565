/// The database of past sessions.

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <algorithm>
#include <filesystem>

#include "common/base/check.h"
#include "common/base/plain_file.h"
#include "common/base/process.h"
#include "common/record/store/session_writer.h"
#include "tests/support/lab_workspace.h"

namespace seam {
namespace store_test {

/// A part of the session `of` with two players and a guest.
StoredSession Part(std::int64_t of, float ann, float bob, std::int64_t ticks) {
  StoredSession part;
  part.room = "main";
  part.scene = of < 100 ? "rally" : "seesaw";
  part.method = "buffer/rollback";
  part.now_us = 1700000000000000 + 1000000 * of;
  Summary& sum = part.summary;
  sum.of = of;
  sum.ticks = ticks;
  sum.names = "ann bob guest0";
  sum.clients = 3;
  sum.peer = {1, 2, 3};
  sum.player = {0, 1, -1};
  sum.joins = {1, 2, 1};
  sum.rejoins = {0, 1, 0};
  sum.present_ticks = {ticks, ticks / 2, 10};
  sum.score = {ann, bob, 0};
  for (auto* v : {&sum.bytes_in, &sum.bytes_out, &sum.corrections, &sum.malformed, &sum.stale,
                  &sum.right, &sum.implausible, &sum.budget, &sum.hand_overs_to}) {
    *v = {1, 2, 3};
  }
  for (auto* v : {&sum.rtt_us, &sum.rtt_worst_us, &sum.loss_ppm}) *v = {1000, 2000, -1};
  sum.trust = {0, 1, 0};
  Event event = MakeEvent(EventKind::kScored, "ann has 7 points; it's \"gold\"", 0);
  part.events = {event, MakeEvent(EventKind::kScript, "x")};
  return part;
}

std::string Failure(const std::string& path, Store::Use use) {
  try {
    const Store store(path, use);
  } catch (const OperatorError& error) {
    return error.what();
  }
  return "";
}

void Execute(const std::string& path, const char* sql) {
  sqlite3* db = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &db), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(db, sql, nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(db);
  sqlite3_close(db);
}

TEST(Store, RanksPlayersByBestScoreOrTimeOverSessions) {
  LabWorkspace folder;
  const std::string path = folder / "a.db";
  {
    Store store(path, Store::Use::kWrite);
    ASSERT_TRUE(store.Put(Part(1, 3, 9, 600)).ok());
    ASSERT_TRUE(store.Put(Part(1, 7, 9, 1200)).ok()) << "the newer part of the same session counts";
    ASSERT_TRUE(store.Put(Part(2, 20, 0, 600)).ok());
    ASSERT_TRUE(store.Put(Part(100, 50, 90, 60)).ok());
  }
  Store store(path, Store::Use::kRead);
  std::vector<StoredRank> ranks = store.Ranks("rally", RankBy::kScore, 10);
  ASSERT_EQ(ranks.size(), 2u) << "guests have no score";
  EXPECT_EQ(ranks[0].name, "ann");
  EXPECT_EQ(ranks[0].best_score, 20);
  EXPECT_EQ(ranks[0].sessions, 2);
  EXPECT_DOUBLE_EQ(ranks[0].time_s, 30);
  EXPECT_EQ(ranks[1].best_score, 9);
  ranks = store.Ranks("", RankBy::kScore, 1);
  ASSERT_EQ(ranks.size(), 1u);
  EXPECT_EQ(ranks[0].name, "bob");
  ranks = store.Ranks("", RankBy::kTime, 10);
  EXPECT_EQ(ranks[0].name, "ann");
  const std::vector<StoredLine> lines = store.Sessions("", 2);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].session, "0000000000000064") << "the newest first";
  EXPECT_EQ(lines[0].players, 2);
  EXPECT_EQ(lines[1].scene, "rally");
}

TEST(Store, AForeignANewerAndADamagedFileAreNamedAndLeftAsTheyAre) {
  LabWorkspace folder;
  Execute(folder / "foreign.db", "CREATE TABLE cats (name TEXT)");
  EXPECT_NE(Failure(folder / "foreign.db", Store::Use::kWrite).find("is not a store"),
            std::string::npos);
  folder.Write("text.db", std::string(5000, 'x'));
  EXPECT_NE(Failure(folder / "text.db", Store::Use::kWrite).find("not a database"),
            std::string::npos);
  EXPECT_EQ(folder.Read("text.db"), std::string(5000, 'x'));
  { Store store(folder / "newer.db", Store::Use::kWrite); }
  Execute(folder / "newer.db", "PRAGMA user_version = 99");
  EXPECT_NE(Failure(folder / "newer.db", Store::Use::kWrite).find("newer version (99"),
            std::string::npos);
  EXPECT_NE(Failure(folder / "absent.db", Store::Use::kRead), "");
  EXPECT_FALSE(std::filesystem::exists(folder / "absent.db")) << "a reader makes no file";
  {
    Store store(folder / "bad.db", Store::Use::kWrite);
    for (int i = 0; i < 200; ++i) ASSERT_TRUE(store.Put(Part(i, 1, 2, 3)).ok());
  }
  std::string bytes = folder.Read("bad.db");
  std::fill(bytes.begin() + 8192, bytes.begin() + 40000, '\xee');
  folder.Write("bad.db", bytes);
  EXPECT_NE(Failure(folder / "bad.db", Store::Use::kWrite), "");
}

TEST(Store, AnOlderFileIsBroughtUpToDate) {
  LabWorkspace folder;
  Execute(folder / "old.db", "PRAGMA application_id = 1395803251; PRAGMA user_version = 0");
  Store store(folder / "old.db", Store::Use::kWrite);
  EXPECT_TRUE(store.Put(Part(1, 3, 9, 600)).ok());
  EXPECT_EQ(store.Ranks("", RankBy::kScore, 10).size(), 2u);
}

TEST(SessionWriter, AFailureIsSaidOnceAndNothingIsWrittenAfterIt) {
  LabWorkspace folder;
  Execute(folder / "foreign.db", "CREATE TABLE cats (name TEXT)");
  const auto writer = WriteIntoStore(folder / "foreign.db");
  writer->Put(Part(1, 1, 1, 1));
  writer->Finish();
  EXPECT_NE(writer->trouble().why().find("foreign.db: is not a store"), std::string::npos);
  const auto good = WriteIntoStore(folder / "good.db");
  for (int i = 0; i < 20; ++i) good->Put(Part(i, 1, 1, 1));
  good->Finish();
  EXPECT_TRUE(good->trouble().ok()) << good->trouble().why();
  EXPECT_EQ(Store(folder / "good.db", Store::Use::kRead).Sessions("", 100).size(), 20u);
}

TEST(SessionWriter, EventsAreALineOfJsonEach) {
  LabWorkspace folder;
  const auto writer = WriteEvents(folder / "events.json");
  StoredSession part = Part(1, 1, 1, 1);
  part.events[1].tick = 90;
  writer->Put(part);
  writer->Finish();
  EXPECT_TRUE(writer->trouble().ok()) << writer->trouble().why();
  // A second server goes on with the file.
  const auto second = WriteEvents(folder / "events.json");
  second->Put(part);
  second->Finish();
  const std::string lines = ReadPlainFile(folder / "events.json", 1 << 20);
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 4) << lines;
  EXPECT_EQ(lines.find("{\"room\":\"main\",\"scene\":\"rally\",\"tick\":"), 0u) << lines;
  EXPECT_NE(lines.find("\"tick\":90,\"time_s\":1.5,\"kind\":\"script\""), std::string::npos)
      << lines;
  EXPECT_NE(lines.find("it\\u0027s \\u0022gold\\u0022"), std::string::npos) << lines;
  // A writer that was killed left half a line.
  folder.Write("cut.json", "{\"room\":");
  const auto third = WriteEvents(folder / "cut.json");
  third->Put(part);
  third->Finish();
  EXPECT_EQ(folder.Read("cut.json").rfind("{\"room\":\n{\"room\":\"main\"", 0), 0u);
  const auto nowhere = WriteEvents(folder / "none/events.json");
  nowhere->Put(part);
  nowhere->Finish();
  EXPECT_NE(nowhere->trouble().why().find("events.json: cannot be written"), std::string::npos);
}

TEST(SessionWriter, PuttingDoesNotWaitForAnotherProgramThatHasTheFile) {
  LabWorkspace folder;
  { Store store(folder / "a.db", Store::Use::kWrite); }
  sqlite3* other = nullptr;
  ASSERT_EQ(sqlite3_open((folder / "a.db").c_str(), &other), SQLITE_OK);
  sqlite3_busy_timeout(other, 10000);  // the writer opens the store on its own thread
  const auto writer = WriteIntoStore(folder / "a.db");
  ASSERT_EQ(sqlite3_exec(other, "BEGIN EXCLUSIVE", nullptr, nullptr, nullptr), SQLITE_OK);
  const std::int64_t begin_us = SteadyClockUs();
  writer->Put(Part(1, 1, 1, 1));
  EXPECT_LT(SteadyClockUs() - begin_us, 2000000) << "a store waits 5 s for the file";
  ASSERT_EQ(sqlite3_exec(other, "COMMIT", nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_close(other);
  writer->Finish();
  EXPECT_TRUE(writer->trouble().ok()) << writer->trouble().why();
}

}  // namespace store_test
}  // namespace seam
