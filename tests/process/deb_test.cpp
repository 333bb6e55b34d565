/// `make deb`: packages that are whole when unpacked, and enough to build the embedding page's
/// programs.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "common/base/version.h"
#include "tests/support/program.h"
#include "tests/support/source_tree.h"

namespace seam {
namespace deb_test {

namespace fs = std::filesystem;

TEST(DebianPackages, UnpackedTheyHoldAllThatIsNeededToRunAndToBuild) {
  const fs::path bin = fs::path(BuiltProgram("seam-server")).parent_path();
  if (!fs::exists(bin / "python/seam/_seam.so")) GTEST_SKIP() << "make python is not done";
  if (std::system("dpkg-shlibdeps --version > /dev/null 2>&1") != 0) {
    GTEST_SKIP() << "dpkg-dev is not here";
  }
  const Workspace folder;
  const std::string script = "set -e\nBUILD=" + bin.filename().string() + " VERSION=" + kVersion +
                             " client/embed/make_deb.sh " + (folder / "deb") + "\nfor deb in " +
                             (folder / "deb") + "/*.deb; do dpkg-deb --info $deb; dpkg -x $deb " +
                             (folder / "root") + "; done\n";
  Program made({"sh", "-c", script}, Root().string());
  ASSERT_TRUE(made.Wait(300) && made.status() == 0) << made.Story();
  const std::string told = made.output();
  for (const char* package :
       {"Package: seam2d\n", "Package: seam2d-dev\n", "Package: python3-seam2d\n", "liblcm1",
        "libbox2d2", "python3-numpy", "libeigen3-dev"}) {
    EXPECT_NE(told.find(package), std::string::npos) << package << " is not in\n" << told;
  }
  const std::string usr = (folder / "root") + "/usr/";
  for (const char* file :
       {"bin/seam", "bin/seam-server", "lib/libseam2d.so.1", "lib/libseam2d.so", "lib/libseam.a",
        "include/seam2d/world.h", "share/doc/seam2d/copyright", "share/doc/seam2d-dev/copyright",
        "share/doc/python3-seam2d/copyright", "share/seam2d/lcmtypes/view_t.lcm",
        "lib/cmake/seam2d/seam2d-config.cmake", "lib/python3/dist-packages/seam/__init__.py",
        "lib/python3/dist-packages/seam/lcm.py", "share/seam2d/lcmtypes/fingerprints.txt"}) {
    EXPECT_TRUE(fs::exists(usr + file)) << file;
  }
  // Containerfile installs packages that there are.
  int copied = 0;
  for (const std::string& line : Lines(Root() / "Containerfile")) {
    std::istringstream words(line);
    const std::string packages = "/source/out/deb/";
    for (std::string word; words >> word;) {
      if (word.rfind(packages, 0) != 0) continue;
      const std::string pattern = (folder / "deb/") + word.substr(packages.size());
      EXPECT_EQ(std::system(("ls " + pattern + " > /dev/null").c_str()), 0) << pattern;
      ++copied;
    }
  }
  EXPECT_EQ(copied, 2);
  // The C program of docs/embedding.md and a line of Python, from the unpacked files alone.
  std::ifstream page_file(Root() / "docs/embedding.md");
  const std::string page{std::istreambuf_iterator<char>(page_file), {}};
  const std::size_t begin = page.find("```c\n") + 5;
  folder.Write("slide.c", page.substr(begin, page.find("```", begin) - begin));
  Program run({"sh", "-ec",
               "export PKG_CONFIG_PATH=" + usr + "lib/pkgconfig LD_LIBRARY_PATH=" + usr +
                   "lib PYTHONPATH=" + usr + "lib/python3/dist-packages\n" +
                   "gcc slide.c $(pkg-config --cflags --libs seam2d-c) -o slide && ./slide\n" +
                   usr + "bin/seam-server --version\n" +
                   "/usr/bin/python3 -c 'import seam; print(seam.__version__)'\n"},
              folder.path());
  ASSERT_TRUE(run.Wait(120));
  EXPECT_EQ(run.status(), 0) << run.Story();
  EXPECT_NE(run.output().find(std::string("\n") + kVersion + "\n"), std::string::npos)
      << run.Story();
}

}  // namespace deb_test
}  // namespace seam
