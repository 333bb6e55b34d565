/// Checks that files which fail cannot throw out of a tick or a thread.

#include <gtest/gtest.h>

#include "tests/support/source_tree.h"

namespace seam {
namespace throwing_test {

/// Returns the first call of std::filesystem in a line that throws: without an error_code, which is
/// its last argument. A file_status is asked by a call named `status`, which cannot fail.
std::string ThrowingCall(const std::string& line) {
  static const Regex iterator(".*[^_](directory_iterator).*");
  static const Regex call(
      ".*(fs|std::filesystem)::((exists|is_[a-z_]+|file_size|last_write_time|create_director[a-z]+|"
      "remove|remove_all|rename|copy|copy_file|status|symlink_status|read_symlink|canonical|"
      "equivalent|space|resize_file|permissions|temp_directory_path)\\([^;]*).*");
  static const Regex safe(
      ".*(::(exists|is_[a-z_]+)\\(status\\)|[(, ](error|ignored|none|unknown)\\)).*");
  if (iterator.Matches(line)) return "directory_iterator";
  return call.Matches(line) && !safe.Matches(line) ? line : "";
}

TEST(Throwing, ACallOfTheFileSystemWithoutAnErrorCodeIsFound) {
  EXPECT_NE(ThrowingCall("  if (!fs::exists(path_)) return;"), "");
  EXPECT_NE(ThrowingCall("  for (const auto& e : fs::directory_iterator(folder, error)) {"), "");
  EXPECT_NE(ThrowingCall("  std::filesystem::remove(path);"), "");
  EXPECT_NE(ThrowingCall("  while (fs::file_size(other.path) > 0) {"), "");
  EXPECT_EQ(ThrowingCall("  if (!fs::exists(path_, error)) return;"), "");
  EXPECT_EQ(ThrowingCall("  return fs::exists(status) && !fs::is_directory(status);"), "");
  EXPECT_EQ(ThrowingCall("  return fs::path(segment.path).filename().string();"), "");
}

/// A file system that fails for a moment (EIO, ESTALE, ELOOP) ended servers with all their rooms.
TEST(Throwing, NoCallOfTheFileSystemThrows) {
  std::string offenders;
  int read = 0;
  for (const Source& source : Sources({"common", "server", "client"}, {".h", ".cpp"})) {
    ++read;
    const bool reads_folders = source.path == "common/base/files/list_folder.cpp" ||
                               source.path == "common/base/files/list_folder.h";
    if (reads_folders || source.path.rfind("client/front/", 0) == 0) continue;
    for (std::size_t i = 0; i < source.lines.size(); ++i) {
      const std::string call = ThrowingCall(source.lines[i]);
      if (call.empty()) continue;
      offenders += source.path + ":" + std::to_string(i + 1) + ": " + call + "\n";
    }
  }
  EXPECT_GT(read, 400);
  EXPECT_EQ(offenders, "") << "ListFolder, or an error_code as the last argument";
}

}  // namespace throwing_test
}  // namespace seam
