#pragma once
/// A table of words and numbers that becomes Markdown for the docs and HTML for the report.

#include <optional>
#include <string>
#include <vector>

#include "tests/lab/report/statistics.h"

namespace seam {

struct TextTable {
  std::string name;  ///< of its file, and of its place in the docs: a-z, 0-9, -
  std::string title;
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;  ///< each as long as the header
  std::string note;                            ///< below it; may be empty
  bool open = false;                           ///< shown at once, not only when asked for
  std::string command;                         ///< that makes it
  std::string scene;                           ///< that it is of; "" of several
};

/// The table, its note and its command; without the title.
std::string Markdown(const TextTable& table);
std::string Html(const TextTable& table);

/// Text in HTML, also within quotes.
std::string EscapeHtml(const std::string& text);

/// Three significant digits: 0.0123, 12.3, 1230, 1.2e-07; "failed" for infinity and NaN.
std::string Digits(double value);
/// The same, or a dash if there is no value.
std::string DigitsOrDash(const std::optional<double>& value);
/// "median (low–high)", or "–" for nothing.
std::string Digits(const std::optional<Quartiles>& value);

/// `text` with all between `<!-- report:NAME -->` and `<!-- /report:NAME -->` replaced by the
/// table of that name. A place whose table is not among `tables` stays as it is, and is named in
/// `missing`. Throws OperatorError, with `path`, when a place does not end.
std::string FillIn(const std::string& text, const std::string& path,
                   const std::vector<const TextTable*>& tables, std::vector<std::string>* missing);

}  // namespace seam
