/// Quantiles of known counts, computed as Prometheus computes them.

#include "common/base/bucket_histogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "common/base/random.h"

namespace seam {
namespace bucket_histogram_test {

TEST(BucketHistogram, IsZeroWhenEmpty) {
  const BucketHistogram none;
  EXPECT_EQ(none.QuantileUs(0.5), 0);
  EXPECT_EQ(none.Since(none).QuantileUs(0.99), 0);
  EXPECT_EQ(none.count, 0);
}

TEST(BucketHistogram, BucketsAreOneFourthToTwoThirdsApart) {
  const auto& bounds = BucketHistogram::kBoundsUs;
  EXPECT_EQ(bounds.front(), 100);
  EXPECT_EQ(bounds.back(), 1000000);
  for (std::size_t i = 1; i < bounds.size(); ++i) {
    EXPECT_GE(4 * bounds[i], 5 * bounds[i - 1]) << bounds[i];
    EXPECT_LE(3 * bounds[i], 5 * bounds[i - 1]) << bounds[i];
  }
}

TEST(BucketHistogram, InterpolatesLinearlyWithinABucket) {
  BucketHistogram h;
  for (int i = 0; i < 10; ++i) h.Add(1200);  // between 1000 and 1500
  EXPECT_EQ(h.count, 10);
  EXPECT_EQ(h.sum_us, 12000);
  EXPECT_DOUBLE_EQ(h.QuantileUs(0), 1000);
  EXPECT_DOUBLE_EQ(h.QuantileUs(0.5), 1250);
  EXPECT_DOUBLE_EQ(h.QuantileUs(0.99), 1495);
  EXPECT_DOUBLE_EQ(h.QuantileUs(1), 1500);
  BucketHistogram first;  // the first begins at 0
  first.Add(-5);
  first.Add(100);
  EXPECT_EQ(first.at_most[0], 2) << "a bound belongs to its bucket, and less than 0 is 0";
  EXPECT_EQ(first.sum_us, 100);
  EXPECT_DOUBLE_EQ(first.QuantileUs(0.5), 50);
}

TEST(BucketHistogram, RankChoosesTheBucketAndTheLastBoundCapsTheRest) {
  BucketHistogram h;
  for (int i = 0; i < 90; ++i) h.Add(120);
  for (int i = 0; i < 8; ++i) h.Add(4000);
  h.Add(250001), h.Add(90000000);
  EXPECT_DOUBLE_EQ(h.QuantileUs(0.45), 125);
  EXPECT_DOUBLE_EQ(h.QuantileUs(0.9), 150) << "just the last of the first bucket";
  EXPECT_DOUBLE_EQ(h.QuantileUs(0.94), 4000) << "four of eight between 3300 and 4700";
  EXPECT_DOUBLE_EQ(h.QuantileUs(0.99), 330000);
  EXPECT_DOUBLE_EQ(h.QuantileUs(1), 1000000);
  EXPECT_EQ(h.at_most.back(), 99);
  EXPECT_EQ(h.count, 100);
}

TEST(BucketHistogram, QuantileLiesInTheBucketOfTheSortedValue) {
  Random random(3);
  BucketHistogram h;
  std::vector<std::int64_t> values;
  for (int i = 0; i < 5000; ++i) {
    values.push_back(100 + static_cast<std::int64_t>(random.Next() >> (47 + random.Next() % 10)));
    h.Add(values.back());
  }
  std::sort(values.begin(), values.end());
  for (const double share : {0.01, 0.1, 0.5, 0.9, 0.99}) {
    const auto value = static_cast<double>(values[static_cast<std::size_t>(share * 5000) - 1]);
    EXPECT_GE(h.QuantileUs(share), value * 0.59) << share;
    EXPECT_LE(h.QuantileUs(share), value * 1.67) << share;
  }
}

TEST(BucketHistogram, SinceIsTheDifferenceAndEverythingAfterARestart) {
  BucketHistogram before, more, sum;
  for (int i = 0; i < 100; ++i) before.Add(200000);
  for (int i = 0; i < 10; ++i) more.Add(500);
  sum = before;
  sum.Add(more);
  const BucketHistogram since = sum.Since(before);
  EXPECT_EQ(since.at_most, more.at_most);
  EXPECT_EQ(since.count, 10);
  EXPECT_EQ(since.sum_us, 5000);
  EXPECT_EQ(more.Since(before).at_most, more.at_most);
  EXPECT_EQ(more.Since(more).count, 0);
}

}  // namespace bucket_histogram_test
}  // namespace seam
