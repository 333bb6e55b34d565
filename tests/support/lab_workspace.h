#pragma once
/// Files of a test of seam-lab: a folder that is removed with the object, and the program's path.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace seam {

class LabWorkspace {
 public:
  LabWorkspace() {
    folder_ = ::testing::TempDir() + "seam-lab-XXXXXX";
    EXPECT_NE(mkdtemp(folder_.data()), nullptr);
  }
  ~LabWorkspace() { std::filesystem::remove_all(folder_); }
  LabWorkspace(const LabWorkspace&) = delete;
  LabWorkspace& operator=(const LabWorkspace&) = delete;

  std::string operator/(const std::string& name) const { return folder_ + "/" + name; }
  std::string Read(const std::string& name) const {
    std::ifstream file(*this / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(*this / name, std::ios::binary) << text;
  }
  /// Lists all files, in order.
  std::vector<std::string> Names() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

 private:
  std::string folder_;
};

/// Returns the path of the seam-lab built with these tests: in $SEAM_BIN, or beside them.
inline std::string LabProgram() {
  const char* const folder = std::getenv("SEAM_BIN");
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe");
  return ((folder != nullptr ? std::filesystem::path(folder) : self.parent_path()) / "seam-lab")
      .string();
}

}  // namespace seam
