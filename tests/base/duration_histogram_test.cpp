/// Compares percentiles from buckets with those of the sorted values.

#include "common/base/duration_histogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "common/base/random.h"

namespace seam {
namespace duration_histogram_test {

TEST(DurationHistogram, IsZeroWhenEmpty) {
  const DurationHistogram none;
  EXPECT_EQ(none.count(), 0);
  EXPECT_EQ(none.PercentileUs(0.5), 0);
  EXPECT_EQ(none.max_us(), 0);
}

TEST(DurationHistogram, PercentilesAreAtMostSixPercentAboveTheSortedValue) {
  Random random(7);
  DurationHistogram all, half;
  std::vector<std::int64_t> values;
  for (int i = 0; i < 20000; ++i) {
    // From 1 us to a quarter of an hour, as many in each doubling.
    const auto value = static_cast<std::int64_t>(random.Next() >> (34 + random.Next() % 30));
    values.push_back(value);
    (i % 2 == 0 ? all : half).Add(value);
  }
  all.Add(half);
  std::sort(values.begin(), values.end());
  EXPECT_EQ(all.count(), 20000);
  EXPECT_EQ(all.max_us(), values.back());
  for (const double share : {0.001, 0.1, 0.5, 0.9, 0.99, 0.999, 1.0}) {
    const auto rank = static_cast<std::size_t>(share * 20000) - 1;
    EXPECT_GE(all.PercentileUs(share), values[rank]) << share;
    EXPECT_LE(all.PercentileUs(share), values[rank] + values[rank] / 16) << share;
  }
}

TEST(DurationHistogram, CountsSeveralEqualDurationsAtOnce) {
  DurationHistogram histogram;
  histogram.Add(1000, 98);
  histogram.Add(5000, 2);
  histogram.Add(9000, 0);
  EXPECT_EQ(histogram.count(), 100);
  EXPECT_EQ(histogram.max_us(), 5000);
  EXPECT_NEAR(static_cast<double>(histogram.PercentileUs(0.98)), 1000, 63);
  EXPECT_EQ(histogram.PercentileUs(0.99), 5000);
}

TEST(DurationHistogram, NegativeTimesCountAsZeroAndHugeOnesAreKept) {
  DurationHistogram histogram;
  histogram.Add(-5);
  EXPECT_EQ(histogram.PercentileUs(1), 0);
  histogram.Add(INT64_MAX);
  EXPECT_GT(histogram.max_us(), std::int64_t{1} << 39);
  EXPECT_EQ(histogram.PercentileUs(0.5), 0);
}

}  // namespace duration_histogram_test
}  // namespace seam
