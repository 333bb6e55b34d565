/// The report's arithmetic: CSV tables, medians, fronts and ranges of axes, made by hand with known
/// answers.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/base/check.h"
#include "common/measure/table.h"
#include "tests/lab/experiment/csv_table.h"
#include "tests/lab/report/figure.h"
#include "tests/lab/report/statistics.h"
#include "tests/lab/report/text_table.h"

namespace seam {
namespace lab_report_statistics_test {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Returns the error that Parse reports for a text.
std::string Mistake(const std::string& text) {
  try {
    CsvTable::Parse(text, "t.csv");
  } catch (const OperatorError& e) {
    return e.what();
  }
  return "nothing";
}

TEST(CsvTable, FindsColumnsByNameAndReadsQuotedFields) {
  const CsvTable t = CsvTable::Parse(
      "scene,impair,error_m\na,\"delay=1ms,loss=1%\",0.5\nb,\"say \"\"no\"\"\nor yes\",\r\n",
      "t.csv");
  ASSERT_EQ(t.rows(), 2u);
  EXPECT_EQ(t.Text(0, "impair"), "delay=1ms,loss=1%");
  EXPECT_EQ(t.Text(1, "impair"), "say \"no\"\nor yes");
  EXPECT_EQ(t.Number(0, "error_m"), 0.5);
  EXPECT_EQ(t.Number(1, "error_m"), std::nullopt) << "empty is not zero";
  EXPECT_EQ(t.Number(0, "penetration_m"), std::nullopt) << "nor is a column that is not there";
  EXPECT_EQ(t.Text(0, "penetration_m"), "");
  EXPECT_TRUE(t.Has("scene"));
  EXPECT_FALSE(t.Has("penetration_m"));
}

TEST(CsvTable, NamesTheDamagedLine) {
  EXPECT_EQ(Mistake("a,b\n1,2\n1,2,3\n"), "t.csv:3: 3 fields, but the header has 2");
  EXPECT_EQ(Mistake("a,b\n1,2\n1,"),
            "t.csv:3: the line has no end: its writer was interrupted, or still writes");
  EXPECT_EQ(Mistake("a,b\n\"1\n2\",3\n1,\"2\n\n"), "t.csv:4: a quote does not close");
  EXPECT_EQ(Mistake("a,b,a\n"), "t.csv:1: the column a is there twice");
  EXPECT_EQ(Mistake(""), "t.csv: is empty");
  EXPECT_EQ(Mistake("a,b\n1,2\n"), "nothing");
}

TEST(CsvTable, RefusesTextForANumberAndAcceptsInfinity) {
  const CsvTable t = CsvTable::Parse("error\ninf\n1.5x\n-2e-3\n", "t.csv");
  EXPECT_EQ(t.Number(0, "error"), kInfinity);
  EXPECT_EQ(t.Number(2, "error"), -0.002);
  try {
    t.Number(1, "error");
    FAIL();
  } catch (const OperatorError& e) {
    EXPECT_STREQ(e.what(), "t.csv:3: error is not a number: 1.5x");
  }
  EXPECT_THROW(t.Require({"error", "floor"}), OperatorError);
  EXPECT_THROW(CsvTable::Load("/nowhere/t.csv"), OperatorError);
}

TEST(Quartiles, AreTheNearestRanks) {
  EXPECT_FALSE(FindQuartiles({}));
  const auto one = FindQuartiles({7});
  EXPECT_EQ(one->low, 7);
  EXPECT_EQ(one->median, 7);
  EXPECT_EQ(one->high, 7);
  // For 1..20: numbers 5, 10 and 15. For 1..5: ceil(1.25) = 2, ceil(2.5) = 3, ceil(3.75) = 4.
  const auto twenty =
      FindQuartiles({20, 1, 19, 2, 18, 3, 17, 4, 16, 5, 15, 6, 14, 7, 13, 8, 12, 9, 11, 10});
  EXPECT_EQ(twenty->low, 5);
  EXPECT_EQ(twenty->median, 10);
  EXPECT_EQ(twenty->high, 15);
  EXPECT_EQ(twenty->count, 20u);
  const auto five = FindQuartiles({5, 3, 1, 4, 2});
  EXPECT_EQ(five->low, 2);
  EXPECT_EQ(five->median, 3);
  EXPECT_EQ(five->high, 4);
}

TEST(Quartiles, CountRunsThatFailedAsTheLargest) {
  const auto q = FindQuartiles({std::nan(""), 1, kInfinity, 2});
  EXPECT_EQ(q->low, 1);
  EXPECT_EQ(q->median, 2);
  EXPECT_EQ(q->high, kInfinity);
}

TEST(ParetoFront, HoldsEveryTrialThatNoOtherBeats) {
  // (1, 10) and (3, 4) and (8, 1) are on it; (2, 10) costs more for the same, (4, 4) too.
  const std::vector<CostError> trials = {{8, 1}, {2, 10}, {3, 4}, {4, 4}, {1, 10}, {9, 2}, {3, 6}};
  EXPECT_EQ(ParetoFront(trials), (std::vector<std::size_t>{4, 2, 0}));
}

TEST(ParetoFront, LeavesOutFailuresAndKeepsTheFirstOfEquals) {
  const std::vector<CostError> trials = {{1, kInfinity}, {2, 3}, {2, 3}, {std::nan(""), 0}, {5, 0}};
  EXPECT_EQ(ParetoFront(trials), (std::vector<std::size_t>{1, 4}));
  EXPECT_TRUE(ParetoFront({{1, kInfinity}}).empty());
  EXPECT_TRUE(ParetoFront({}).empty());
}

TEST(Range, PutsZeroAndInfinityAtTheEdgesOfALogarithmicAxis) {
  const PlotRange range = FindRange({0, 0.01, 1, kInfinity}, true);
  EXPECT_TRUE(range.zero);
  EXPECT_TRUE(range.infinity);
  EXPECT_LT(range.low, range.zero_at);
  EXPECT_LT(range.zero_at, 0.01);
  EXPECT_GT(range.infinity_at, 1);
  EXPECT_GT(range.high, range.infinity_at);
  EXPECT_EQ(PlaceOn(range, 0, true), range.zero_at);
  EXPECT_EQ(PlaceOn(range, std::nan(""), true), range.infinity_at);
  EXPECT_EQ(PlaceOn(range, 0.5, true), 0.5);
  for (const double tic : LogTics(range)) {
    EXPECT_GT(tic, range.zero_at) << "a tic would be written over the 0";
    EXPECT_LT(tic, range.infinity_at);
  }
  const PlotRange nothing = FindRange({}, true);
  EXPECT_GT(nothing.low, 0);
  EXPECT_GT(nothing.high, nothing.low);
}

TEST(Range, ALinearAxisBeginsAtZeroUnlessAValueIsNegative) {
  EXPECT_EQ(FindRange({3, 10}, false).low, 0);
  EXPECT_GT(FindRange({3, 10}, false).high, 10);
  EXPECT_LT(FindRange({-1, 10}, false).low, -1);
  EXPECT_GT(FindRange({0, 0}, false).high, 0) << "all values equal";
}

TEST(Digits, AreThreeSignificantOnes) {
  EXPECT_EQ(Digits(0), "0");
  EXPECT_EQ(Digits(0.0123456), "0.0123");
  EXPECT_EQ(Digits(12.345), "12.3");
  EXPECT_EQ(Digits(12345.0), "12300");
  EXPECT_EQ(Digits(-99.96), "-100");
  EXPECT_EQ(Digits(1.28e-5), "1.3e-05");
  EXPECT_EQ(Digits(kInfinity), "failed");
  EXPECT_EQ(Digits(Quartiles{1, 2, 3.5, 20}), "2 (1–3.5)");
  EXPECT_EQ(Digits(Quartiles{2, 2, 2, 20}), "2");
  EXPECT_EQ(Digits(std::optional<Quartiles>()), "–");
}

TEST(Csv, ReadsBackAWrittenLine) {
  const std::vector<std::string> fields = {"a", "", "b, c", "say \"no\"", "two\nlines", "1.5"};
  std::string line;
  for (const std::string& field : fields) line += (line.empty() ? "" : ",") + CsvField(field);
  EXPECT_EQ(CsvFields(line), fields);
  EXPECT_EQ(CsvFields(""), std::vector<std::string>{""});
  EXPECT_THROW(CsvFields("a,\"b"), OperatorError) << "the quote does not close";
  EXPECT_THROW(CsvFields("a\nb"), OperatorError) << "two lines";
}

}  // namespace lab_report_statistics_test
}  // namespace seam
