#pragma once
/// What is installed beside a program for people and shells: its man page, and what completes its
/// flags and words in bash, zsh and fish. Made from its table of flags, so that none is missing.

#include <string>

#include "common/base/command/command_table.h"

namespace seam {

/// What a page says besides the flags.
struct PageText {
  std::string version;  ///< "0.7.0"
  std::string footer;   ///< the last lines of --help: examples, lists
};

/// In roff's man macros, section 1.
std::string ManPage(const CommandEntry& program, const PageText& text);

/// Scripts that the shell sources. Where a flag's values are no list, files are completed.
std::string BashCompletion(const CommandEntry& program);
std::string ZshCompletion(const CommandEntry& program);
std::string FishCompletion(const CommandEntry& program);

/// One of the above by its name: "man", "bash", "zsh" or "fish". Throws OperatorError for another.
std::string GeneratedPage(const std::string& kind, const CommandEntry& program,
                          const PageText& text);

}  // namespace seam
