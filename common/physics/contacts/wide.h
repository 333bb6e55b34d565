#pragma once
/// Four numbers that are computed together, each as if alone: results are the same on any machine.

#include <cstddef>
#include <cstring>
#include <vector>

#include "common/physics/contacts/soft_contact.h"

#define SEAM_WIDE __attribute__((always_inline)) inline

namespace seam {

constexpr int kBlockLanes = 4;
using Wide = float __attribute__((vector_size(16)));

SEAM_WIDE Wide All(float x) { return Wide{x, x, x, x}; }
SEAM_WIDE Wide Less(Wide a, Wide b) { return a < b ? a : b; }
SEAM_WIDE Wide More(Wide a, Wide b) { return a > b ? a : b; }

/// Four numbers of four bodies: row k has the k-th number of each.
struct WideRows {
  Wide row[4];

  /// Reads the four numbers from `first` on.
  SEAM_WIDE WideRows(const std::vector<SoftBody>& bodies, const int* of, float SoftBody::*first) {
    for (int i = 0; i < kBlockLanes; ++i) {
      std::memcpy(&row[i], &(bodies[static_cast<std::size_t>(of[i])].*first), sizeof(Wide));
    }
    Turn();
  }
  SEAM_WIDE void Write(const int* of, float SoftBody::*first, std::vector<SoftBody>* bodies) {
    Turn();
    for (int i = 0; i < kBlockLanes; ++i) {
      std::memcpy(&((*bodies)[static_cast<std::size_t>(of[i])].*first), &row[i], sizeof(Wide));
    }
  }

 private:
  /// Exchanges rows and columns.
  SEAM_WIDE void Turn() {
    const Wide a = __builtin_shufflevector(row[0], row[1], 0, 4, 1, 5);
    const Wide b = __builtin_shufflevector(row[2], row[3], 0, 4, 1, 5);
    const Wide c = __builtin_shufflevector(row[0], row[1], 2, 6, 3, 7);
    const Wide d = __builtin_shufflevector(row[2], row[3], 2, 6, 3, 7);
    row[0] = __builtin_shufflevector(a, b, 0, 1, 4, 5);
    row[1] = __builtin_shufflevector(a, b, 2, 3, 6, 7);
    row[2] = __builtin_shufflevector(c, d, 0, 1, 4, 5);
    row[3] = __builtin_shufflevector(c, d, 2, 3, 6, 7);
  }
};

}  // namespace seam
