#pragma once
/// The sources of this repository as data, for tests of their style and structure.

#include <gtest/gtest.h>
#include <regex.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace seam {

/// A POSIX extended regular expression. (std::regex does not compile without warnings everywhere.)
class Regex {
 public:
  explicit Regex(const std::string& text) {
    EXPECT_EQ(regcomp(&compiled_, ("^(" + text + ")$").c_str(), REG_EXTENDED), 0) << text;
  }
  ~Regex() { regfree(&compiled_); }
  Regex(const Regex&) = delete;
  Regex& operator=(const Regex&) = delete;

  bool Matches(const std::string& text) const { return Find(text, 0).first; }
  /// Returns the first group of the match in `text`; "" if it does not match.
  std::string Group(const std::string& text) const { return Find(text, 1).second; }

 private:
  std::pair<bool, std::string> Find(const std::string& text, std::size_t group) const;
  regex_t compiled_;
};

/// Returns the repository's root: the nearest folder upwards with the Makefile and lcmtypes/.
std::filesystem::path Root();

struct Source {
  std::string path;  ///< relative to the root, with slashes
  std::vector<std::string> lines;
  std::vector<std::string> includes;  ///< texts between the quotes or brackets
};

std::vector<std::string> Lines(const std::filesystem::path& path);

/// Returns all our files with one of `extensions` below `folders`, in order.
std::vector<Source> Sources(const std::vector<std::string>& folders,
                            const std::vector<std::string>& extensions);

inline const std::vector<std::string> kCode = {"common", "server", "client", "render", "tests"};
inline const std::vector<std::string> kProduct = {"common", "server", "client", "render"};

inline std::vector<Source> Code() { return Sources(kCode, {".h", ".cpp"}); }

/// Returns the number of characters on the screen: UTF-8 continuation bytes take no column.
inline std::size_t Columns(const std::string& line) {
  const auto begins = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; };
  return static_cast<std::size_t>(std::count_if(line.begin(), line.end(), begins));
}

}  // namespace seam
