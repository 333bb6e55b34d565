#pragma once
/// Cures of usual slips in Lua, of which Lua's own messages say little.

#include <string>

#include "common/scene/part_rules.h"

namespace seam {

/// Returns " (not equal is ~= in Lua)" for an error "FILE:LINE: MESSAGE" of the script; "" if no
/// slip is known there.
std::string LuaHint(const ScriptSource& source, const std::string& error);

}  // namespace seam
