#pragma once
/// A temporary file for a test.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

#include "common/base/bytes.h"

namespace seam {

/// A file name in a directory of this test alone; the directory is removed with the object.
class TemporaryFile {
 public:
  TemporaryFile() {
    folder_ = ::testing::TempDir() + "seam-log-XXXXXX";
    EXPECT_NE(mkdtemp(folder_.data()), nullptr);
  }
  ~TemporaryFile() {
    std::remove(path().c_str());
    rmdir(folder_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  std::string path() const { return folder_ + "/a.lcm"; }

  void Write(const Bytes& bytes) const {
    std::ofstream(path(), std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<long>(bytes.size()));
  }
  Bytes Read() const {
    std::ifstream file(path(), std::ios::binary);
    return Bytes(std::istreambuf_iterator<char>(file), {});
  }

 private:
  std::string folder_;
};

}  // namespace seam
