#include "tests/support/source_tree.h"

namespace seam {

namespace fs = std::filesystem;

std::pair<bool, std::string> Regex::Find(const std::string& text, std::size_t group) const {
  regmatch_t match[3];
  if (regexec(&compiled_, text.c_str(), 3, match, 0) != 0) return {false, ""};
  const regmatch_t& m = match[group + 1];  // [1] is the whole: the parentheses of the constructor
  if (m.rm_so < 0) return {true, ""};
  return {true, text.substr(static_cast<std::size_t>(m.rm_so),
                            static_cast<std::size_t>(m.rm_eo - m.rm_so))};
}

fs::path Root() {
  for (fs::path p = fs::current_path(); p != p.root_path(); p = p.parent_path()) {
    if (fs::exists(p / "Makefile") && fs::exists(p / "lcmtypes")) return p;
  }
  return {};
}

std::vector<std::string> Lines(const fs::path& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

std::vector<Source> Sources(const std::vector<std::string>& folders,
                            const std::vector<std::string>& extensions) {
  const Regex include(R"( *# *include *["<]([^">]+)[">].*)");
  std::vector<Source> sources;
  for (const std::string& folder : folders) {
    if (!fs::exists(Root() / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(Root() / folder)) {
      const std::string extension = entry.path().extension().string();
      if (std::count(extensions.begin(), extensions.end(), extension) == 0) continue;
      Source source;
      source.path = fs::relative(entry.path(), Root()).generic_string();
      source.lines = Lines(entry.path());
      for (const std::string& line : source.lines) {
        const std::string name = include.Group(line);
        if (!name.empty()) source.includes.push_back(name);
      }
      sources.push_back(std::move(source));
    }
  }
  std::sort(sources.begin(), sources.end(),
            [](const Source& a, const Source& b) { return a.path < b.path; });
  return sources;
}

}  // namespace seam
