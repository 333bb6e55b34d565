#pragma once
/// What a scene is about: what must have happened in a session for its figures to mean something.

namespace seam {

struct Expected {
  bool contact = false;    ///< bodies of two players touch
  bool hand_over = false;  ///< authority over a mechanism changes, where methods change it
  bool edit = false;       ///< bodies or joints change at run time
};

}  // namespace seam
