#include "common/base/entropy.h"

#include <sys/random.h>

#include <cerrno>

#include "common/base/check.h"

namespace seam {

std::uint64_t OsEntropy::Next() {
  std::uint64_t bits = 0;
  ssize_t got = -1;
  do {  // up to 256 bytes are never split once the system is seeded; a signal may end the wait
    got = getrandom(&bits, sizeof bits, 0);
  } while (got < 0 && errno == EINTR);
  SEAM_ASSERT(got == static_cast<ssize_t>(sizeof bits));
  return bits;
}

}  // namespace seam
