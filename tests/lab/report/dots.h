#pragma once
/// One dot for each method of a group: what a viewer would notice, against its bytes and its CPU.

#include "tests/lab/report/sweep_section.h"

namespace seam {

/// In the middle of the axis, medians: `seen` against bytes and against CPU, and the error of
/// others' bodies likewise. Methods without valid runs are left out and named in the caption; a
/// measure that no run has gives no panel.
Figure DotsOf(const Sweep& sweep, const SweepGroup& group);

}  // namespace seam
