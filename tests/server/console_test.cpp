/// Texts for the operator of a server: players in the room, and the account of each client.

#include "server/console.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "client/embed/cluster.h"
#include "common/record/events/summary_text.h"

namespace seam {
namespace console_test {

using Lines = std::vector<std::string>;

TEST(AccountBook, ManyNamesShareTheLastAccountAndCostNoMoreMemory) {
  AccountBook book;
  for (int i = 0; i < 3000; ++i) ++book.Of("name" + std::to_string(i)).sessions;
  EXPECT_EQ(book.List().size(), AccountBook::kAccountsMax);
  EXPECT_EQ(book.Of("name3").sessions, 1) << "the early ones keep theirs";
  EXPECT_EQ(book.Of("others").sessions, 3000 - static_cast<int>(AccountBook::kAccountsMax) + 1);
}

TEST(AccountBook, AnUnknownRoundTripIsNoReading) {
  ClientAccount account;
  EXPECT_EQ(account.rtt_us(), -1);
  account.Read(-1, 0);
  account.Read(40000, 10000);
  account.Read(60000, 0);
  EXPECT_EQ(account.rtt_us(), 50000);
  EXPECT_EQ(account.rtt_us_max, 60000);
  EXPECT_EQ(account.loss_ppm(), 5000);
}

/// A session whose second client dies.
class ServerConsole : public ::testing::Test {
 protected:
  ServerConsole() : cluster_(Config()) { Take(); }
  static ClusterConfig Config() {
    ClusterConfig config;
    config.impair = "delay=40ms,loss=2%";
    config.keep = true;  // somebody looks at what the server shows
    return config;
  }
  void Take() {
    for (const std::string& line : cluster_.server().TakeReports()) news_.push_back(line);
  }
  bool Told(const std::string& line) const {
    return std::find(news_.begin(), news_.end(), line) != news_.end();
  }
  Cluster cluster_;
  Lines news_;
};

TEST_F(ServerConsole, ReportsJoinsLeavesAndMissingPlayers) {
  EXPECT_EQ(MissingPlayers(cluster_.server()), "ann, bob");
  EXPECT_EQ(ServerProgress(cluster_.server(), 360, DurationHistogram()),
            "waiting: 0 of 2 players (ann, bob missing); Ctrl-C stops");
  cluster_.RunToTick(60);
  cluster_.Kill(1);
  cluster_.RunToTick(400);
  Take();
  ASSERT_EQ(news_.size(), 4u) << ::testing::PrintToString(news_);
  EXPECT_TRUE(Told("the room starts; 2 of 2 players"));
  EXPECT_TRUE(Told("bob is gone: not heard for 4 s; 1 of 2 players, missing: bob"))
      << ::testing::PrintToString(news_);
  EXPECT_EQ(MissingPlayers(cluster_.server()), "bob");
  EXPECT_EQ(cluster_.server().TakeReports(), Lines{}) << "taken";
  DurationHistogram times;
  times.Add(1500);
  const std::string line = ServerProgress(cluster_.server(), 1800, times);
  EXPECT_EQ(line.rfind("7 of 30 s, 1 of 2 players (bob missing), rtt ", 0), 0u) << line;
  EXPECT_NE(line.find("tick p99 1.50 ms"), std::string::npos) << line;
  EXPECT_LT(line.size(), 110u) << line;
}

TEST_F(ServerConsole, TheSummaryIncludesClientsThatLeft) {
  cluster_.RunToTick(60);
  cluster_.Kill(1);
  cluster_.RunToTick(400);
  const std::vector<ClientAccount> accounts = cluster_.server().accounts();
  ASSERT_EQ(accounts.size(), 2u);
  std::int64_t in = 0, out = 0;
  for (const ClientAccount& account : accounts) {
    EXPECT_GE(account.player, 0);
    EXPECT_EQ(account.sessions, 1);
    EXPECT_GT(account.readings, 0);
    EXPECT_NEAR(static_cast<double>(account.rtt_us()), 80000, 40000) << account.name;
    EXPECT_GE(account.rtt_us_max, account.rtt_us());
    in += account.bytes_in;
    out += account.bytes_out;
  }
  EXPECT_GT(accounts[0].readings, accounts[1].readings) << "ann stayed";
  EXPECT_GT(accounts[0].loss_ppm(), 0);
  // All but the handshakes, which belong to nobody yet.
  const Stats& stats = cluster_.server().stats();
  EXPECT_GT(in, 0);
  EXPECT_LE(in, stats.bytes_in);
  EXPECT_GT(in, stats.bytes_in - 2000);
  EXPECT_LE(out, stats.bytes_out);
  EXPECT_GT(out, stats.bytes_out - 2000);
  const std::string table = SummaryTable(cluster_.server().Sum(cluster_.now_us()), 60);
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 4) << table;
  EXPECT_NE(table.find("  bob                 2     1 "), std::string::npos) << table;
}

TEST_F(ServerConsole, ACorrectionOfAClientsBodyIsInItsAccount) {
  cluster_.RunToTick(400);
  std::int64_t corrections = 0;
  for (const ClientAccount& account : cluster_.server().accounts()) {
    corrections += account.corrections;
  }
  EXPECT_GT(corrections, 0) << "over 80 ms the server's copies cannot always be right";
  std::int64_t at_clients = 0;
  for (int i = 0; i < 2; ++i) at_clients += cluster_.client(i)->corrections();
  EXPECT_GT(at_clients, 0);
}

TEST_F(ServerConsole, TheSummaryOfAnEmptyRoomHasNoClients) {
  const std::string table = SummaryTable(cluster_.server().Sum(cluster_.now_us()), 60);
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1) << table;
}

TEST_F(ServerConsole, TheSummaryNamesTheReasonsOfDrops) {
  cluster_.RunToTick(10);
  Summary sum = cluster_.server().Sum(cluster_.now_us());
  sum.malformed[0] = sum.right[0] = sum.implausible[0] = 0;
  sum.stale[0] = 8639;
  sum.budget[0] = 2;
  const std::string table = SummaryTable(sum, 60);
  EXPECT_NE(table.find(" 8641 (8639 stale, 2 over budget)\n"), std::string::npos) << table;
  EXPECT_EQ(table.find("malformed"), std::string::npos) << table;
}

TEST(MissingPlayersOfALargeScene, AreCounted) {
  for (const int players : {4, 140}) {
    std::string text;
    for (int i = 0; i < players; ++i) {
      const std::string n = std::to_string(i);
      text += "[[player]]\nname = \"p" + n + "\"\nvehicle = \"v" + n + "\"\n[[part]]\nname = \"v" +
              n + "\"\nbox = [1, 1]\nposition = [" + std::to_string(3 * i) + ", 0]\n";
    }
    ClusterConfig config;
    config.scene_text = text;
    config.players = 1;
    Cluster cluster(config);
    EXPECT_EQ(MissingPlayers(cluster.server()),
              players == 4 ? "p0, p1, p2, p3" : "p0, p1, p2 and 137 more");
  }
}

}  // namespace console_test
}  // namespace seam
