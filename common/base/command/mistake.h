#pragma once
/// Describes a mistake on a command line in one line with the probable correction.

#include <string>

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace seam {

/// Returns "there is no flag --ipmair (did you mean --impair?)" after `app` failed to parse with
/// `e`. Falls back to the text of `e`.
std::string CommandMistake(const CLI::App& app, const CLI::ParseError& e);

}  // namespace seam
