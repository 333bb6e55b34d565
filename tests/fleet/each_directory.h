#pragma once
/// Tests that hold for each kind of directory of a fleet: a file, and etcd.

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "common/fleet/directory.h"
#include "tests/fleet/etcd_here.h"
#include "tests/fleet/server_of.h"

namespace seam {
namespace directory_test {

constexpr const char* kSpec = R"({"folder": "/var/rooms"})";

/// `GetParam()`: file or etcd.
class EachDirectory : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (GetParam() == std::string("file")) {
      text_ = "file:" + folder_.path();
      return;
    }
    if (!EtcdHere::Installed()) GTEST_SKIP() << "etcd is not installed: make build/.deps-fleet";
    etcd_ = std::make_unique<EtcdHere>();
    ASSERT_TRUE(etcd_->WaitUntilUp()) << etcd_->Story();
    text_ = etcd_->Text();
  }
  std::unique_ptr<Directory> Open(const std::string& id) const {
    auto directory = std::make_unique<Directory>(OpenKeyStore(text_), "test");
    const Status status = directory->Register(ServerOf(id));
    EXPECT_TRUE(status.ok()) << status.why();
    return directory;
  }
  /// Claims; -1 after an error.
  static std::int32_t Claimed(Directory& directory, const std::string& room,
                              std::int32_t least = 1) {
    std::int32_t epoch = -1;
    const Status status = directory.Claim(room, kSpec, least, &epoch);
    EXPECT_TRUE(status.ok()) << status.why();
    return status.ok() ? epoch : -1;
  }
  static std::int32_t TakenOver(Directory& directory, const std::string& room) {
    std::int32_t epoch = -1;
    const Status status = directory.TakeOver(room, 1, &epoch);
    EXPECT_TRUE(status.ok()) << status.why();
    return status.ok() ? epoch : -1;
  }
  static FleetListing Listed(Directory& directory) {
    FleetListing listing;
    const Status status = directory.List(&listing);
    EXPECT_TRUE(status.ok()) << status.why();
    return listing;
  }

  Workspace folder_;
  std::unique_ptr<EtcdHere> etcd_;
  std::string text_;
};

}  // namespace directory_test
}  // namespace seam
