/// `seam-lab schema`: all scenes are valid by it, it has every key of the loader, and it finds
/// mistakes.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/program.h"
#include "tests/support/source_tree.h"

namespace seam {
namespace schema_test {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

/// All scenes of the project.
Words Scenes() {
  Words scenes;
  for (const char* folder : {"scenes", "scenes/hard", "scenes/exact"}) {
    for (const auto& entry : fs::directory_iterator(Root() / folder)) {
      if (entry.path().extension() == ".toml") scenes.push_back(entry.path().string());
    }
  }
  return scenes;
}

/// The schema, made once.
class Schema : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<Workspace>();
    Words words{BuiltProgram("seam-lab"), "schema"};
    for (const std::string& scene : Scenes()) words.push_back(scene);
    Program lab(words, Root().string());
    ASSERT_TRUE(lab.Wait(120) && lab.status() == 0) << lab.Story();
    text_ = lab.output();
    folder_->Write("seam.schema.json", text_);
  }
  static void TearDownTestSuite() { folder_.reset(); }
  /// Returns the validator's complaints about these files.
  static std::string Complaints(const Words& files) {
    Words words{"/usr/bin/python3", (Root() / "tests/process/check_schema.py").string(),
                *folder_ / "seam.schema.json"};
    words.insert(words.end(), files.begin(), files.end());
    Program check(words);
    EXPECT_TRUE(check.Wait(120));
    EXPECT_LE(check.status(), 1) << check.Story();
    return check.output();
  }
  static std::string ComplaintAbout(const std::string& scene) {
    folder_->Write("s.toml", scene);
    return Complaints({*folder_ / "s.toml"});
  }

  inline static std::unique_ptr<const Workspace> folder_;
  inline static std::string text_;
};

TEST_F(Schema, EveryScenesFileIsValid) {
  ASSERT_GT(Scenes().size(), 30u);
  EXPECT_EQ(Complaints(Scenes()), "");
}

TEST_F(Schema, FindsKeysTypesAndRangesThatTheLoaderRefuses) {
  const std::string part = "[[part]]\nname = \"a\"\n";
  EXPECT_NE(ComplaintAbout(part + "bxo = [1, 1]\n").find("no key bxo"), std::string::npos);
  EXPECT_NE(ComplaintAbout(part + "box = [1, 1, 1]\n").find("3 items"), std::string::npos);
  EXPECT_NE(ComplaintAbout(part + "box = \"wide\"\n").find("is no array"), std::string::npos);
  EXPECT_NE(ComplaintAbout(part + "angle = 180\n").find("too large"), std::string::npos);
  EXPECT_NE(ComplaintAbout(part + "anchored = 1\n").find("is no boolean"), std::string::npos);
  EXPECT_NE(ComplaintAbout("[solver]\ntick_hz = 60.5\n").find("is no integer"), std::string::npos);
  EXPECT_NE(ComplaintAbout("[[player]]\nname = 5\n").find("is no string"), std::string::npos);
  EXPECT_EQ(ComplaintAbout(part + "box = [1, 1]\n"), "");
}

TEST_F(Schema, HasEveryKeyThatTheLoaderKnows) {
  std::ifstream file(Root() / "tests/process/interface.txt");
  ASSERT_TRUE(file.good());
  int keys = 0;
  for (std::string line; std::getline(file, line);) {
    const std::string mark = "scene key ";
    if (line.rfind(mark, 0) != 0) continue;
    std::istringstream words(line);
    Words all;
    for (std::string word; words >> word;) all.push_back(word);
    const std::string& key = all.back();
    ++keys;
    EXPECT_NE(text_.find("\"" + key + "\":"), std::string::npos) << line;
  }
  EXPECT_GT(keys, 150);
}

}  // namespace schema_test
}  // namespace seam
