#pragma once
/// Man page and completion scripts (bash, zsh, fish) that are installed with a program. Generated
/// from its table of flags, so that none is missing.

#include <string>

#include "common/base/command/command_table.h"

namespace seam {

/// Text of a man page besides the flags.
struct PageText {
  std::string version;  ///< "0.7.0"
  std::string footer;   ///< the last lines of --help: examples, lists
};

/// Returns the man page in roff's man macros, section 1.
std::string ManPage(const CommandEntry& program, const PageText& text);

/// Return scripts for the shell to source. Files complete a flag whose values are not a list.
std::string BashCompletion(const CommandEntry& program);
std::string ZshCompletion(const CommandEntry& program);
std::string FishCompletion(const CommandEntry& program);

/// Returns one of the above by name: "man", "bash", "zsh" or "fish". Throws OperatorError for any
/// other name.
std::string GeneratedPage(const std::string& kind, const CommandEntry& program,
                          const PageText& text);

}  // namespace seam
