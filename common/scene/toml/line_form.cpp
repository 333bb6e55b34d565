#include "common/scene/toml/line_form.h"

#include <regex.h>

#include "common/base/check.h"

namespace seam {

std::optional<FormMatch> FindForm(const char* form, const std::string& masked,
                                  const std::string& text) {
  regex_t compiled;
  SEAM_ASSERT(regcomp(&compiled, form, REG_EXTENDED) == 0);
  regmatch_t places[kFormParts];
  const bool found = regexec(&compiled, masked.c_str(), kFormParts, places, 0) == 0;
  regfree(&compiled);
  if (!found) return std::nullopt;
  FormMatch match;
  for (std::size_t i = 0; i < kFormParts; ++i) {
    if (places[i].rm_so < 0) continue;
    match.parts[i].assign(text, static_cast<std::size_t>(places[i].rm_so),
                          static_cast<std::size_t>(places[i].rm_eo - places[i].rm_so));
  }
  return match;
}

std::string Filled(const char* remedy, const FormMatch& match) {
  std::string text;
  for (const char* c = remedy; *c != '\0'; ++c) {
    if (*c == '$') {
      text += match.parts[*++c - '0'];
    } else {
      text += *c;
    }
  }
  return text;
}

}  // namespace seam
