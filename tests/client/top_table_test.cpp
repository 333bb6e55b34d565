/// seam-top's table: rates between two load messages, and rooms that fall silent.

#include "client/top/top_table.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace seam {
namespace top_table_test {

RoomLoad LoadOf(const std::string& room, std::int64_t seconds) {
  RoomLoad told;
  told.room = room;
  Load& load = told.load;
  load.speed_ppm = 470000;
  load.players = 3;
  load.clients = 5;
  load.moving = 8;
  load.moving_held = 6;
  load.bodies = 40;
  load.hand_overs = 2 * seconds;
  load.cpu_us = 250000 * seconds;
  load.dropped_stale = 7 * seconds;
  load.kind = {kTrafficStates, kTrafficClock};
  load.bytes_out = {10000 * seconds, 2000 * seconds};
  load.bytes_in = {3000 * seconds, 500 * seconds};
  return told;
}

/// The words of the line that begins with `room`.
std::vector<std::string> Row(const std::string& text, const std::string& room) {
  const std::size_t begin = text.find("\n" + room + " ");
  if (begin == std::string::npos) return {};
  std::vector<std::string> words;
  std::string word;
  for (const char c : text.substr(begin + 1, text.find('\n', begin + 1) - begin)) {
    if (c != ' ' && c != '\n') {
      word += c;
    } else if (!word.empty()) {
      words.push_back(word);
      word.clear();
    }
  }
  return words;
}

TEST(TopTable, RatesAreTakenBetweenTheLastTwoMessages) {
  TopTable table;
  EXPECT_EQ(table.Text(0), "no room was heard yet\n");
  table.Take(1000000, LoadOf("hall", 10));
  table.Take(3000000, LoadOf("hall", 12));
  const std::vector<std::string> row = Row(table.Text(3000000), "hall");
  ASSERT_EQ(row.size(), 20u) << table.Text(3000000);
  EXPECT_EQ(row[1], "47") << "% of its speed";
  EXPECT_EQ(row[2], "3/5");
  EXPECT_EQ(row[7], "25.0") << "% of a core";
  EXPECT_EQ(row[8], "8/40");
  EXPECT_EQ(row[9], "75") << "% of what moves is held by clients";
  EXPECT_EQ(row[11], "120") << "hand-overs a minute";
  EXPECT_EQ(row[13], "12.0") << "kB/s out";
  EXPECT_EQ(row[14], "3.5") << "kB/s in";
  EXPECT_EQ(row[15], "7.0") << "dropped a second";
  EXPECT_EQ(row[16], "-") << "the bus does not tell of round trips";
  EXPECT_NE(table.Text(3000000).find("sent, kB/s: states 10.0 clock 2.0\n"), std::string::npos);
}

TEST(TopTable, ShowsTheLinesSinceTheLastLook) {
  RoomLoad told = LoadOf("hall", 10);
  for (int i = 0; i < 100; ++i) told.connections.round_trip.Add(400000);
  for (int i = 0; i < 100; ++i) told.connections.loss.Add(500000);
  TopTable table;
  table.Take(1000000, told);
  for (int i = 0; i < 10; ++i) told.connections.round_trip.Add(90000);
  for (int i = 0; i < 10; ++i) told.connections.loss.Add(20000);
  told.connections.thin_lines = 2;
  told.connections.least_line = 4500;
  table.Take(2000000, told);
  const std::vector<std::string> row = Row(table.Text(2000000), "hall");
  ASSERT_EQ(row.size(), 20u) << table.Text(2000000);
  EXPECT_NEAR(std::stod(row[16]), 99, 2) << "ms, in the bucket of 68 to 100";
  EXPECT_EQ(row[17], "2.0") << "% lost";
  EXPECT_EQ(row[18], "2") << "thin lines";
  EXPECT_EQ(row[19], "4.5") << "kB/s";
}

TEST(TopTable, ASilentRoomIsLeftOut) {
  TopTable table;
  table.Take(1000000, LoadOf("hall", 10));
  table.Take(6000000, LoadOf("yard", 10));
  EXPECT_FALSE(Row(table.Text(6000000), "hall").empty());
  EXPECT_TRUE(Row(table.Text(6500000), "hall").empty());
  EXPECT_FALSE(Row(table.Text(6500000), "yard").empty());
}

}  // namespace top_table_test
}  // namespace seam
