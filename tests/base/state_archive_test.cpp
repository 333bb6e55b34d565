/// Objects as bytes.

#include "common/base/state_archive.h"

#include <gtest/gtest.h>

namespace seam {
namespace state_archive_test {

void PersistPair(StateArchive& a, int* x, int* y) {
  a.Section("pair");
  a.Int(x, 0, 9);
  a.Int(y, 0, 9);
}

/// Writes 1 to 6, the middle ones later if `later`.
StateDraft Write(bool later) {
  StateArchive a;
  int one = 1, two = 2, three = 3, four = 4, five = 5, six = 6;
  PersistPair(a, &one, &two);
  if (later) {
    a.Later([three, four](StateArchive& out) {
      int x = three, y = four;
      PersistPair(out, &x, &y);
    });
  } else {
    PersistPair(a, &three, &four);
  }
  PersistPair(a, &five, &six);
  return a.TakeDraft();
}

TEST(StateArchive, BytesThatAreWrittenLaterLieInTheirPlace) {
  StateDraft draft = Write(true);
  const Bytes at_once = Write(false).Finish();
  EXPECT_LT(draft.size(), at_once.size());
  EXPECT_EQ(draft.Finish(), at_once);
}

TEST(StateArchive, AGapAtEitherEndIsFilled) {
  StateArchive a;
  const auto number = [](int of) {
    return [of](StateArchive& out) {
      int copy = of;
      out.Int(&copy, 0, 9);
    };
  };
  int middle = 5;
  a.Later(number(3));
  a.Later(number(4));
  a.Int(&middle, 0, 9);
  a.Later(number(6));
  const Bytes bytes = a.Take();
  StateArchive read(bytes);
  for (const int expected : {3, 4, 5, 6}) {
    int is = 0;
    read.Int(&is, 0, 9);
    EXPECT_EQ(is, expected);
  }
  EXPECT_TRUE(read.ok());
  EXPECT_EQ(read.left(), 0u);
}

}  // namespace state_archive_test
}  // namespace seam
