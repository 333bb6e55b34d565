#pragma once
/// Events that must happen in a session of this scene for its measurements to be meaningful.

namespace seam {

struct Expected {
  bool contact = false;    ///< bodies of two players touch
  bool hand_over = false;  ///< authority over a mechanism changes, with methods that change it
  bool edit = false;       ///< bodies or joints change at run time
};

}  // namespace seam
