#pragma once
/// The version of Seam2D: what `--version` says, what is installed, what the lab's rows carry.

namespace seam {

/// Raised with every release, and with a commit that changes what a session does or how it is
/// measured: the lab's tables hold only rows of one version (docs/lab.md).
constexpr const char* kVersion = "0.22.2";

}  // namespace seam
