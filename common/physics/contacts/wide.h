#pragma once
/// Eight numbers that are computed together, each as if alone: results are the same on any machine.

#include <cstddef>
#include <cstring>
#include <vector>

#include "common/physics/contacts/soft_contact.h"

// The same source is compiled for processors with wider registers, too, and chosen at the start.
// Sanitizers do not stand the choice. No instruction that rounds otherwise is allowed by it.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && !defined(__AVX2__)
#define SEAM_WIDE_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define SEAM_WIDE_CLONES
#endif
// All that passes these numbers is compiled in place.
#pragma GCC diagnostic ignored "-Wpsabi"
#define SEAM_WIDE __attribute__((always_inline)) inline

namespace seam {

constexpr int kLanes = 8;
using Four = float __attribute__((vector_size(16)));
using Wide = float __attribute__((vector_size(32), aligned(32)));

SEAM_WIDE Wide All(float x) { return Wide{x, x, x, x, x, x, x, x}; }
SEAM_WIDE Wide Less(const Wide& a, const Wide& b) { return a < b ? a : b; }
SEAM_WIDE Wide More(const Wide& a, const Wide& b) { return a > b ? a : b; }

/// Four numbers of eight bodies: row k has the k-th number of each.
struct WideRows {
  Wide row[4];

  /// Reads the four numbers from `first` on.
  SEAM_WIDE WideRows(const std::vector<SoftBody>& bodies, const int* of, float SoftBody::*first) {
    for (int i = 0; i < 4; ++i) {
      Four near, far;
      std::memcpy(&near, &(bodies[static_cast<std::size_t>(of[i])].*first), sizeof near);
      std::memcpy(&far, &(bodies[static_cast<std::size_t>(of[i + 4])].*first), sizeof far);
      row[i] = __builtin_shufflevector(near, far, 0, 1, 2, 3, 4, 5, 6, 7);
    }
    Turn();
  }
  SEAM_WIDE void Write(const int* of, float SoftBody::*first, std::vector<SoftBody>* bodies) {
    Turn();
    for (int i = 0; i < 4; ++i) {
      const Four near = __builtin_shufflevector(row[i], row[i], 0, 1, 2, 3);
      const Four far = __builtin_shufflevector(row[i], row[i], 4, 5, 6, 7);
      std::memcpy(&((*bodies)[static_cast<std::size_t>(of[i])].*first), &near, sizeof near);
      std::memcpy(&((*bodies)[static_cast<std::size_t>(of[i + 4])].*first), &far, sizeof far);
    }
  }

 private:
  /// Exchanges rows and columns in each half.
  SEAM_WIDE void Turn() {
    const Wide a = __builtin_shufflevector(row[0], row[1], 0, 8, 1, 9, 4, 12, 5, 13);
    const Wide b = __builtin_shufflevector(row[2], row[3], 0, 8, 1, 9, 4, 12, 5, 13);
    const Wide c = __builtin_shufflevector(row[0], row[1], 2, 10, 3, 11, 6, 14, 7, 15);
    const Wide d = __builtin_shufflevector(row[2], row[3], 2, 10, 3, 11, 6, 14, 7, 15);
    row[0] = __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13);
    row[1] = __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
    row[2] = __builtin_shufflevector(c, d, 0, 1, 8, 9, 4, 5, 12, 13);
    row[3] = __builtin_shufflevector(c, d, 2, 3, 10, 11, 6, 7, 14, 15);
  }
};

}  // namespace seam
