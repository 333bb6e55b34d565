#pragma once
/// A seeded random generator that gives the same numbers on every machine. The few distributions we
/// need are here too, because those of std:: differ between libraries.

#include <cmath>
#include <cstdint>

namespace seam {

/// SplitMix64 (Steele, Lea, Flood: "Fast splittable pseudorandom number generators", 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t Next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }

  /// Uniform in [0, 1).
  double Uniform() { return static_cast<double>(Next() >> 11) * 0x1.0p-53; }

  /// Uniform in [low, high).
  double Uniform(double low, double high) { return low + (high - low) * Uniform(); }

  /// True with probability `p`.
  bool Chance(double p) { return Uniform() < p; }

  /// Exponential with the given mean.
  double Exponential(double mean) { return -mean * std::log1p(-Uniform()); }

  /// Returns an independent generator for another purpose; does not advance this one.
  Random Fork(std::uint64_t purpose) const {
    Random child(state_ ^ (purpose * 0xd1342543de82ef95ULL + 0x2545f4914f6cdd1dULL));
    child.Next();
    return child;
  }

 private:
  std::uint64_t state_;
};

}  // namespace seam
