/// The page for Prometheus: a written page is read back, and it follows the exposition format.

#include "common/record/load_page.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>
#include <sstream>

#include "common/base/random.h"
#include "common/codec/message_list.h"
#include "tests/support/random_messages.h"
#include "tests/support/source_tree.h"

namespace seam {
namespace load_page_test {

/// A Load of numbers that a page can hold, with each kind of traffic at most once.
Load RandomLoad(RandomMessages* random) {
  Load load;
  random->Fill(load);
  load.utime = load.sequence = 0;
  load.kind.clear(), load.bytes_out.clear(), load.bytes_in.clear();
  for (std::int8_t kind = 0; kind <= kTrafficOther; ++kind) {
    load.kind.push_back(kind);
    load.bytes_out.push_back(1000 * kind + 7);
    load.bytes_in.push_back(3 * kind);
  }
  return load;
}

/// Ticks as they may have been, of any length.
BucketHistogram RandomTicks(Random* random) {
  BucketHistogram ticks;
  for (int i = 0; i < 200; ++i) {
    ticks.Add(static_cast<std::int64_t>(random->Next() >> (44 + random->Next() % 16)));
  }
  return ticks;
}

RoomLoad RandomRoom(const std::string& name, RandomMessages* messages, Random* ticks) {
  Connections connections;
  for (auto* histogram :
       {&connections.round_trip, &connections.queue, &connections.loss, &connections.corrected}) {
    *histogram = RandomTicks(ticks);
  }
  for (auto* n : {&connections.compositions, &connections.rests, &connections.least_line,
                  &connections.thin_lines, &connections.doubts, &connections.distrusted,
                  &connections.unkept}) {
    *n = static_cast<std::int64_t>(ticks->Next() >> 30);
  }
  return {name, RandomLoad(messages), RandomTicks(ticks), RandomTicks(ticks), connections};
}

TEST(LoadPage, ReadsBackAWrittenPage) {
  RandomMessages random(3);
  Random ticks(4);
  for (int i = 0; i < 50; ++i) {
    std::vector<RoomLoad> loads = {RandomRoom("main-1", &random, &ticks),
                                   RandomRoom("b_2", &random, &ticks)};
    for (RoomLoad& room : loads) {  // a page has 15 digits
      for (auto* n :
           {&room.load.cpu_us, &room.load.tick, &room.load.hand_overs, &room.load.jumps,
            &room.load.dropped_malformed, &room.load.dropped_stale, &room.load.dropped_right,
            &room.load.dropped_implausible, &room.load.dropped_budget}) {
        *n %= 1000000000000;
      }
    }
    const std::vector<RoomLoad> read = ReadLoadPage(WriteLoadPage(loads));
    ASSERT_EQ(read.size(), 2u);
    for (std::size_t r = 0; r < 2; ++r) {
      EXPECT_EQ(read[r].room, loads[r].room);
      EXPECT_EQ(MessageTraits<Load>::Fields(read[r].load),
                MessageTraits<Load>::Fields(loads[r].load));
      const Connections &back = read[r].connections, &written = loads[r].connections;
      for (const auto of : {&Connections::round_trip, &Connections::queue, &Connections::loss,
                            &Connections::corrected}) {
        EXPECT_EQ((back.*of).at_most, (written.*of).at_most);
        EXPECT_EQ((back.*of).sum_us, (written.*of).sum_us);
      }
      for (const auto of : {&Connections::compositions, &Connections::rests,
                            &Connections::least_line, &Connections::thin_lines,
                            &Connections::doubts, &Connections::distrusted, &Connections::unkept}) {
        EXPECT_EQ(back.*of, written.*of);
      }
      for (const auto of : {&RoomLoad::tick, &RoomLoad::late}) {
        EXPECT_EQ((read[r].*of).at_most, (loads[r].*of).at_most);
        EXPECT_EQ((read[r].*of).count, 200);
        EXPECT_EQ((read[r].*of).sum_us, (loads[r].*of).sum_us);
      }
    }
  }
}

/// "" if the text keeps to the rules of the text format, else the first line that does not.
std::string BrokenLine(const std::string& text) {
  const Regex help("# HELP [a-z_0-9]+ .+"), type("# TYPE ([a-z_0-9]+) (counter|gauge|histogram)");
  const Regex sample(
      "([a-zA-Z_:][a-zA-Z0-9_:]*)"
      "[{][a-zA-Z_][a-zA-Z0-9_]*=\"[^\"\\]*\"(,[a-zA-Z_][a-zA-Z0-9_]*=\"[^\"\\]*\")*[}]"
      " -?[0-9]+([.][0-9]+)?(e[-+][0-9]+)?");
  std::map<std::string, std::string> types;
  std::set<std::string> seen;
  std::string now;  // the metric whose samples stand together
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (help.Matches(line)) continue;
    if (type.Matches(line)) {
      now = type.Group(line);
      const bool total = now.size() > 6 && now.substr(now.size() - 6) == "_total";
      const std::string kind = line.substr(line.rfind(' ') + 1);
      if (!types.emplace(now, kind).second || total != (kind == "counter")) return line;
      continue;
    }
    if (!sample.Matches(line)) return line;
    const std::string name = sample.Group(line);
    const bool part = types[now] == "histogram" &&
                      (name == now + "_bucket" || name == now + "_sum" || name == now + "_count");
    if (!part && (name != now || types[now] == "histogram")) return line;
    if (!seen.insert(line.substr(0, line.find("} "))).second) return line;
  }
  return text.empty() || text.back() != '\n' ? "the last line has no end" : "";
}

TEST(LoadPage, KeepsToTheExpositionFormat) {
  RandomMessages random(5);
  Random ticks(6);
  const std::string page =
      WriteLoadPage({RandomRoom("main-1", &random, &ticks), RandomRoom("main-2", &random, &ticks)});
  EXPECT_EQ(BrokenLine(page), "");
  EXPECT_GT(std::count(page.begin(), page.end(), '\n'), 100);
  // And this test can fail.
  EXPECT_EQ(BrokenLine("# TYPE a gauge\nb{room=\"x\"} 1\n"), "b{room=\"x\"} 1");
  EXPECT_EQ(BrokenLine("# TYPE a counter\na{room=\"x\"} 1\n"), "# TYPE a counter");
  EXPECT_EQ(BrokenLine("# TYPE a histogram\na{room=\"x\"} 1\n"), "a{room=\"x\"} 1");
  EXPECT_EQ(BrokenLine("# TYPE a gauge\na_sum{room=\"x\"} 1\n"), "a_sum{room=\"x\"} 1");
  EXPECT_EQ(BrokenLine("# TYPE a gauge\na{room=\"x\"} nan\n"), "a{room=\"x\"} nan");
}

/// The text after the last `before` in the line, as a number; "+Inf" is infinity.
double NumberAfter(const std::string& line, const std::string& before) {
  return std::strtod(line.c_str() + line.rfind(before) + before.size(), nullptr);
}

TEST(LoadPage, BucketsGrowInBoundAndCountAndTheLastIsTheCount) {
  RandomMessages random(7);
  Random ticks(8);
  std::istringstream page(WriteLoadPage(
      {RandomRoom("main-1", &random, &ticks), RandomRoom("main-2", &random, &ticks)}));
  int histograms = 0;
  double bound = -1, count = 0;
  for (std::string line; std::getline(page, line);) {
    if (line.find("_seconds_bucket{") != std::string::npos) {
      EXPECT_GT(NumberAfter(line, "le=\""), bound) << line;
      EXPECT_GE(NumberAfter(line, "} "), count) << line;
      bound = NumberAfter(line, "le=\"");
      count = NumberAfter(line, "} ");
    } else if (line.find("_seconds_count{") != std::string::npos) {
      EXPECT_TRUE(std::isinf(bound)) << line;
      EXPECT_EQ(NumberAfter(line, "} "), count) << line;
      EXPECT_EQ(count, 200) << line;
      bound = -1, count = 0;
      ++histograms;
    }
  }
  EXPECT_EQ(histograms, 8);
}

TEST(LoadPage, ForeignAndBrokenPagesAreReadWithoutHarm) {
  EXPECT_TRUE(ReadLoadPage("").empty());
  EXPECT_TRUE(ReadLoadPage("<html>{\n}{} \n# HELP\nseam_tick 3\nseam_tick{room=\"\"} 3\n").empty());
  const std::vector<RoomLoad> read = ReadLoadPage(
      "seam_tick{room=\"a\"} 7\nseam_clients{room=\"a\"} 1e14\nother{room=\"a\"} 1\n"
      "seam_late_seconds_bucket{room=\"a\",le=\"1e-4\"} 5\n"
      "seam_late_seconds_bucket{room=\"a\",le=\"many\"} 6\n"
      "seam_late_seconds_bucket{room=\"a\"} 7\nseam_late_seconds_other{room=\"a\"} 8\n"
      "seam_tick{room=\"a\"} nan\nseam_bodies{room=\"a\"} 1e99\nseam_dropped_total{room=\"a\"} "
      "1\n");
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(read[0].load.tick, 7);
  EXPECT_EQ(read[0].load.clients, INT32_MAX);
  EXPECT_EQ(read[0].load.bodies, 0);
  EXPECT_EQ(read[0].late.at_most[0], 5);
  EXPECT_EQ(read[0].late.at_most[1], 0);
  EXPECT_EQ(read[0].late.count, 0);
}

}  // namespace load_page_test
}  // namespace seam
