/// The directory in a file, where that is damaged or lost.

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

#include "common/base/plain_file.h"
#include "common/fleet/directory.h"
#include "common/fleet/key_store.h"
#include "tests/fleet/server_of.h"
#include "tests/support/program.h"

namespace seam {
namespace directory_file_test {

TEST(DirectoryFile, ADamagedFileIsOneErrorAndStaysAsItIs) {
  Workspace folder;
  for (const char* text : {"{", "[]", R"({"revision": 1})", R"({"revision": "1"})"}) {
    folder.Write("directory.json", text);
    Directory directory(OpenKeyStore("file:" + folder.path()), "test");
    const Status status = directory.Register(ServerOf("a"));
    EXPECT_EQ(status.why(), folder / "directory.json" + ": is damaged");
    EXPECT_EQ(ReadPlainFile(folder / "directory.json", 100), text);
  }
}

TEST(DirectoryFile, OneThatIsLostGivesNobodyTheLeaseOfAnother) {
  Workspace folder;
  const auto open = [&] {
    return std::make_unique<Directory>(OpenKeyStore("file:" + folder.path()), "test");
  };
  const auto a = open(), b = open();
  ASSERT_TRUE(a->Register(ServerOf("a")).ok());
  ASSERT_TRUE(b->Register(ServerOf("b")).ok());
  std::filesystem::remove(folder / "directory.json");
  bool kept = true;
  ASSERT_TRUE(b->Renew(&kept).ok());
  EXPECT_FALSE(kept);
  ASSERT_TRUE(b->Register(ServerOf("b")).ok());  // the first lease of the new file
  ASSERT_TRUE(a->Renew(&kept).ok());
  EXPECT_FALSE(kept) << "a had the first lease of the old one";
  ASSERT_TRUE(a->Register(ServerOf("a")).ok());
  FleetListing listing;
  ASSERT_TRUE(a->List(&listing).ok());
  EXPECT_NE(listing.FindServer("a"), nullptr);
  EXPECT_NE(listing.FindServer("b"), nullptr);
}

}  // namespace directory_file_test
}  // namespace seam
