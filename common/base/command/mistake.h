#pragma once
/// A mistake on a command line, said in one line with what was probably meant.

#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace seam {

/// "there is no flag --ipmair (did you mean --impair?)". `app` has just failed to parse with `e`;
/// where nothing better is known it is e's own text.
std::string CommandMistake(const CLI::App& app, const CLI::ParseError& e);

}  // namespace seam
