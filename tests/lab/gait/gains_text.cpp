#include "tests/lab/gait/gains_text.h"

#include <fmt/format.h>

#include "common/base/check.h"

namespace seam {
namespace {

/// The shortest decimal that is the same float, as a literal: "0.45f", "25.0f".
std::string Literal(float value) {
  std::string digits = fmt::format("{}", value);
  if (digits.find_first_of(".e") == std::string::npos) digits += ".0";
  return digits + "f";
}

}  // namespace

std::string WithGains(const std::string& before, const CharacterGains& gains) {
  std::string text = before;
  CharacterGains values = gains;
  for (const std::string& name : GainNames()) {
    const std::string head = "SEAM_GAIN(" + name + ", ";
    const std::size_t at = text.find(head);
    const std::size_t end = at == std::string::npos ? at : text.find(')', at);
    if (end == std::string::npos) throw OperatorError("no line '" + head + "...)' to put a value");
    const std::size_t from = at + head.size();
    text.replace(from, end - from, Literal(*FindGain(&values, name)));
  }
  return text;
}

}  // namespace seam
