#pragma once
/// The version of Seam2D, printed by `--version`, installed, and stored in the lab's rows.

namespace seam {

/// Raised with every release and with each commit that changes a session's behaviour or its
/// measures: the lab's tables hold only rows of one version (docs/lab.md).
constexpr const char* kVersion = "0.34.0";

}  // namespace seam
