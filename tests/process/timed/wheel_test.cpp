/// `make wheel`: a wheel that pip installs into an environment of its own, and of which each file
/// is as its record says.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "common/base/version.h"
#include "tests/support/program.h"
#include "tests/support/source_tree.h"

namespace seam {
namespace wheel_test {

namespace fs = std::filesystem;

TEST(Wheel, IsInstalledByPipAndImportedOutsideOfTheSource) {
  const fs::path module = fs::path(BuiltProgram("seam")).parent_path() / "python";
  if (!fs::exists(module / "seam/_seam.so")) GTEST_SKIP() << "make python is not done";
  const Workspace folder;
  Program made({"/usr/bin/python3", "client/python/make_wheel.py", module.string(), kVersion,
                folder / "dist"},
               Root().string());
  ASSERT_TRUE(made.Wait(120) && made.status() == 0) << made.Story();
  std::string wheel = made.output();
  wheel.pop_back();
  ASSERT_TRUE(fs::exists(wheel)) << made.Story();
  // The record, by Python's own zip and hashes (PEP 376 and 427).
  folder.Write("check.py", R"(
import base64, csv, hashlib, sys, zipfile
pack = zipfile.ZipFile(sys.argv[1])
record = next(name for name in pack.namelist() if name.endswith("/RECORD"))
rows = {row[0]: row[1:] for row in csv.reader(pack.read(record).decode().splitlines())}
assert sorted(rows) == sorted(pack.namelist()), (sorted(rows), pack.namelist())
for name, (digest, size) in rows.items():
    if name == record:
        continue
    data = pack.read(name)
    made = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
    assert digest == "sha256=" + made and int(size) == len(data), name
print(len(rows), "files")
)");
  Program checked({"/usr/bin/python3", folder / "check.py", wheel});
  ASSERT_TRUE(checked.Wait(60) && checked.status() == 0) << checked.Story();
  if (std::system("/usr/bin/python3 -c 'import ensurepip, venv' > /dev/null 2>&1") != 0) {
    GTEST_SKIP() << "python3-venv is not here: the wheel is only looked through";
  }
  // NumPy is Debian's; nothing comes from the network.
  Program installed({"sh", "-ec",
                     "unset PYTHONPATH\n/usr/bin/python3 -m venv --system-site-packages " +
                         (folder / "venv") + "\n" + (folder / "venv") +
                         "/bin/pip install --no-index --quiet --disable-pip-version-check " +
                         wheel + "\ncd /\n" + (folder / "venv") +
                         "/bin/python -c 'import seam; print(seam.__version__, seam.__file__);"
                         "print(len(seam.World(text=\"[[part]]\\nname = \\\"a\\\"\\nbox = [1, "
                         "1]\").step().names))'"});
  ASSERT_TRUE(installed.Wait(180));
  EXPECT_EQ(installed.status(), 0) << installed.Story();
  EXPECT_EQ(installed.output().rfind(std::string(kVersion) + " " + (folder / "venv"), 0), 0u)
      << installed.Story();
  EXPECT_NE(installed.output().find("\n1\n"), std::string::npos) << installed.Story();
}

}  // namespace wheel_test
}  // namespace seam
