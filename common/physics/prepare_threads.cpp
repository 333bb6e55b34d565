#include "common/physics/prepare_threads.h"

#include "common/base/check.h"
#include "common/physics/world.h"

namespace seam {

void PrepareForThreads() {
  World world(ParseScene(R"(
[[part]]
name = "a"
circle = 1
[[part]]
name = "b"
circle = 1
position = [1.9, 0]
)",
                         "two-discs"));
  for (int i = 0; i < 2; ++i) world.Step();
  SEAM_ASSERT(!world.touches().empty());
}

}  // namespace seam
