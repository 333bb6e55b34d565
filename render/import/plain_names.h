#pragma once
/// Names and texts as a scene may have them.

#include <fmt/format.h>

#include <Eigen/Core>
#include <cctype>
#include <set>
#include <string>

namespace seam {

/// Returns "[x, y]".
inline std::string Pair(const Eigen::Vector2d& v) {
  return fmt::format("[{:.9g}, {:.9g}]", v.x(), v.y());
}

/// Returns up to 100 characters, with `?` for all that needs an escape in TOML.
inline std::string PlainText(const std::string& text) {
  std::string plain;
  for (const char c : text.substr(0, 100)) {
    plain += c < ' ' || c > '~' || c == '"' || c == '\\' ? '?' : c;
  }
  return plain;
}

class UniqueNames {
 public:
  /// Returns `name`, or `otherwise` if nothing of it is left, as a scene may have it and as no
  /// other thing has it.
  std::string Take(const std::string& name, const std::string& otherwise) {
    std::string plain;
    for (const char c : name) {
      const bool kept = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
      plain += kept ? c : '-';
    }
    while (!plain.empty() && (plain[0] == '-' || plain[0] == '_')) plain.erase(0, 1);
    if (plain.empty()) plain = otherwise;
    plain = plain.substr(0, 24);
    std::string unique = plain;
    for (int i = 2; !taken_.insert(unique).second; ++i) unique = plain + "-" + std::to_string(i);
    return unique;
  }

 private:
  std::set<std::string> taken_;
};

}  // namespace seam
