#include "common/base/huge_pages.h"

#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace seam {
namespace {

bool GivenToWhoAsks() {
  std::FILE* const file = std::fopen("/sys/kernel/mm/transparent_hugepage/enabled", "re");
  if (file == nullptr) return false;
  std::array<char, 128> text{};
  const std::size_t bytes = std::fread(text.data(), 1, text.size(), file);
  std::fclose(file);
  return std::string(text.data(), bytes).find("[madvise]") != std::string::npos;
}

/// Of the running program: by it, not by /proc/self/exe, it keeps its name among the processes. "":
/// not known.
std::string OwnPath() {
  std::array<char, 4096> path{};
  const ssize_t bytes = readlink("/proc/self/exe", path.data(), path.size());
  const bool whole = bytes > 0 && static_cast<std::size_t>(bytes) < path.size();
  return whole ? std::string(path.data(), static_cast<std::size_t>(bytes)) : "";
}

}  // namespace

void UseHugePages(char** argv) {
  if (std::getenv("GLIBC_TUNABLES") != nullptr || !GivenToWhoAsks()) return;
  const std::string path = OwnPath();
  if (path.empty()) return;
  const char* const tunables = "glibc.malloc.hugetlb=1:glibc.malloc.arena_max=1";
  if (setenv("GLIBC_TUNABLES", tunables, 0) != 0) return;
  execv(path.c_str(), argv);
  // It could not be started (its file was replaced meanwhile): this one runs on as it is.
}

}  // namespace seam
