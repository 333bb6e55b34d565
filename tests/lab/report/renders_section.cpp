#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/lab/report/files.h"
#include "tests/lab/report/report.h"

namespace seam {
namespace {

namespace fs = std::filesystem;

std::string TextOf(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// "00012", as seam-render numbers its frames.
std::string FrameName(std::size_t number) { return fmt::format("frame_{:05}.png", number); }

}  // namespace

std::vector<std::string> FramesOf(const std::string& folder) {
  std::vector<std::string> frames;
  while (fs::exists(fs::path(folder) / FrameName(frames.size()))) {
    frames.push_back(FrameName(frames.size()));
  }
  return frames;
}

Section RendersSection(const std::string& out) {
  Section section;
  section.id = "renders";
  section.title = "Seen: the methods side by side";
  section.intro =
      "Rendered from the recordings of single runs: colour is who has authority, dashed outlines "
      "are where the oracle has the body. Each opens large.";
  const fs::path renders = fs::path(out) / "renders";
  std::error_code error;
  std::vector<fs::path> names;
  for (const fs::path& file : FilesIn(renders, ".txt", &error)) names.push_back(file.stem());
  std::sort(names.begin(), names.end());  // "a" before "a-b", which "a.txt" is not
  for (const fs::path& name : names) {
    Thumbnail thumbnail;
    thumbnail.title = name.string();
    thumbnail.command = TextOf(renders / (name.string() + ".txt"));
    const std::string base = "renders/" + name.string();
    if (fs::exists(renders / (name.string() + ".png"))) {
      thumbnail.file = thumbnail.link = base + ".png";
    } else if (const auto frames = FramesOf((renders / name).string()); !frames.empty()) {
      thumbnail.file = base + '/' + frames[frames.size() / 2];
      thumbnail.link = base + ".html";
    } else {
      continue;
    }
    section.items.emplace_back(std::move(thumbnail));
  }
  return section;
}

}  // namespace seam
