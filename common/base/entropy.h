#pragma once
/// Where secrets and session numbers come from: the operating system for programs, a seed for
/// tests and the lab, so that a run repeats.

#include <cstdint>

#include "common/base/random.h"

namespace seam {

class Entropy {
 public:
  virtual ~Entropy() = default;
  /// 64 random bits.
  virtual std::uint64_t Next() = 0;
};

/// Nobody can guess it. The process ends (asserted) where the system has no random numbers.
class OsEntropy : public Entropy {
 public:
  std::uint64_t Next() override;
};

/// The same numbers for the same seed: no secret.
class SeededEntropy : public Entropy {
 public:
  explicit SeededEntropy(std::uint64_t seed) : random_(seed) {}
  std::uint64_t Next() override { return random_.Next(); }

 private:
  Random random_;
};

}  // namespace seam
