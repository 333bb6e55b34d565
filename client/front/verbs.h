#pragma once
/// The verbs of `seam`, the program in front of all others.

#include <string>
#include <vector>

namespace seam {

/// A verb that another program does.
struct Verb {
  const char* name;     ///< "measure"
  const char* program;  ///< "seam-measure"
  const char* about;    ///< one line
};

const std::vector<Verb>& Verbs();
/// Returns the verb of that name; nullptr if there is none.
const Verb* FindVerb(const std::string& name);

/// Returns the program beside this one, or its bare name, to be looked up in PATH.
std::string ProgramPath(const std::string& name);
/// Becomes the verb's program, with these arguments behind its name. Throws OperatorError if that
/// cannot be started.
[[noreturn]] void Become(const Verb& verb, const std::vector<std::string>& arguments);

}  // namespace seam
