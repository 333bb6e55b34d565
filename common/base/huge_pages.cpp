#include "common/base/huge_pages.h"

#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace seam {
namespace {

bool HugePagesOnRequest() {
  std::FILE* const file = std::fopen("/sys/kernel/mm/transparent_hugepage/enabled", "re");
  if (file == nullptr) return false;
  std::array<char, 128> text{};
  const std::size_t bytes = std::fread(text.data(), 1, text.size(), file);
  std::fclose(file);
  return std::string(text.data(), bytes).find("[madvise]") != std::string::npos;
}

/// Returns the running program's path, "" if unknown. Started by this path instead of
/// /proc/self/exe, the process keeps its name in process lists.
std::string OwnPath() {
  std::array<char, 4096> path{};
  const ssize_t bytes = readlink("/proc/self/exe", path.data(), path.size());
  const bool whole = bytes > 0 && static_cast<std::size_t>(bytes) < path.size();
  return whole ? std::string(path.data(), static_cast<std::size_t>(bytes)) : "";
}

}  // namespace

void UseHugePages(char** argv) {
  if (std::getenv("GLIBC_TUNABLES") != nullptr || !HugePagesOnRequest()) return;
  const std::string path = OwnPath();
  if (path.empty()) return;
  const char* const tunables = "glibc.malloc.hugetlb=1:glibc.malloc.arena_max=1";
  if (setenv("GLIBC_TUNABLES", tunables, 0) != 0) return;
  execv(path.c_str(), argv);
  // The restart failed (the program's file was replaced meanwhile): this process just goes on.
}

}  // namespace seam
