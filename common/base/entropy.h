#pragma once
/// The source of secrets and session numbers: the operating system in programs, a seed in tests
/// and the lab, so that a run repeats.

#include <cstdint>

#include "common/base/random.h"

namespace seam {

class Entropy {
 public:
  virtual ~Entropy() = default;
  /// Returns 64 random bits.
  virtual std::uint64_t Next() = 0;
};

/// Unpredictable random numbers from the system. Asserts that the system has them.
class OsEntropy : public Entropy {
 public:
  std::uint64_t Next() override;
};

/// The same numbers for the same seed; not secret.
class SeededEntropy : public Entropy {
 public:
  explicit SeededEntropy(std::uint64_t seed) : random_(seed) {}
  std::uint64_t Next() override { return random_.Next(); }

 private:
  Random random_;
};

}  // namespace seam
