#pragma once
/// Edits as lines of text: of an operator who changes a room, or asks a what-if.

#include <string>

#include "common/topology/topology.h"

namespace seam {

/// Returns the forms of a line, for --help.
std::string EditLineHelp();
/// Parses a line; names are those of the topology's parts. Throws OperatorError, with the line
/// before the reason, for one that is none, or an edit that the topology does not allow.
Edit ParseEditLine(const std::string& line, const Topology& topology);

}  // namespace seam
