#pragma once
/// Forms of lines that people write by mistake, and remedies with parts of the line.

#include <cstddef>
#include <optional>
#include <string>

namespace seam {

/// The whole of what has a form, and its parts $1 to $9.
constexpr std::size_t kFormParts = 10;
struct FormMatch {
  std::string parts[kFormParts];
};

/// Looks for a form, a POSIX extended regular expression with GNU's \w, \s and \b, in `masked`,
/// and takes the parts from `text`, which is as long.
std::optional<FormMatch> FindForm(const char* form, const std::string& masked,
                                  const std::string& text);
/// Returns the remedy with the parts for $1 to $9.
std::string Filled(const char* remedy, const FormMatch& match);

}  // namespace seam
