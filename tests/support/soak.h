#pragma once
/// Number of random seeds: `make soak` runs the seeded tests with many times their usual number,
/// and several machines may share them.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace seam {

/// Returns `count`, times the environment's SEAM_SOAK if that is a number above 1.
inline int Soak(int count) {
  const char* const factor = std::getenv("SEAM_SOAK");
  const int times = factor == nullptr ? 1 : std::atoi(factor);
  return times > 1 ? count * times : count;
}

/// Returns the seeds `first`, `first` + 1 ... of a test: Soak(count) of them, at most `most`. With
/// SEAM_SOAK_SHARD=I/N (0/N..N-1/N, as `seam-lab sweep --shard` has it) every N-th one alone, so
/// that N processes run each seed once between them. Another text there ends the program.
inline std::vector<int> SoakSeeds(int first, int count, int most = 1 << 30) {
  int index = 0, shards = 1;
  if (const char* const share = std::getenv("SEAM_SOAK_SHARD")) {
    char rest = 0;
    const int read = std::sscanf(share, "%d/%d%c", &index, &shards, &rest);
    if (read != 2 || index < 0 || index >= shards) {
      std::fprintf(stderr, "SEAM_SOAK_SHARD: \"%s\" is not I/N with 0 <= I < N\n", share);
      std::exit(2);
    }
  }
  std::vector<int> seeds;
  for (int n = index; n < std::min(Soak(count), most); n += shards) seeds.push_back(first + n);
  return seeds;
}

}  // namespace seam
