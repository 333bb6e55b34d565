/// docs/how-to.md works: its files and shell blocks run in order in an empty folder.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/support/program.h"
#include "tests/support/source_tree.h"

namespace seam {
namespace how_to_test {

/// A block of the page that is marked: a file to write, or commands to run.
struct Block {
  std::string file;  ///< "": commands
  std::string text;
};

std::vector<Block> BlocksOf(const std::string& page) {
  std::vector<Block> blocks;
  for (std::size_t at = 0; (at = page.find("\n<!-- ", at)) != std::string::npos; ++at) {
    const std::size_t mark = at + 6, mark_end = page.find(" -->", mark);
    const std::string says = page.substr(mark, mark_end - mark);
    const std::size_t fence = page.find("```", mark_end);
    const std::size_t begin = page.find('\n', fence) + 1, end = page.find("\n```", begin) + 1;
    EXPECT_EQ(fence, mark_end + 5) << says << ": a block must follow at once";
    Block block;
    if (says.rfind("file: ", 0) == 0) {
      block.file = says.substr(6);
    } else {
      EXPECT_EQ(says, "run");
    }
    block.text = page.substr(begin, end - begin);
    blocks.push_back(block);
  }
  return blocks;
}

TEST(HowTo, EachMarkedBlockRunsInAnEmptyFolder) {
  std::ifstream file(Root() / "docs/how-to.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  const std::vector<Block> blocks = BlocksOf(page);
  ASSERT_GE(blocks.size(), 8u);
  const Workspace folder;
  const std::string programs =
      std::filesystem::absolute(BuiltProgram("seam-lab")).parent_path().string();
  for (const Block& block : blocks) {
    if (!block.file.empty()) {
      std::ofstream(folder / block.file) << block.text;
      continue;
    }
    const std::string script = "cd '" + (folder / ".") + "' && PATH='" + programs +
                               "':$PATH && export PATH && set -e\n" + block.text;
    Program shell({"sh", "-c", script});
    ASSERT_TRUE(shell.Wait(120)) << block.text;
    EXPECT_EQ(shell.status(), 0) << block.text << shell.Story();
  }
  for (const char* made : {"throw.html", "difference.png", "both.html", "sweep.csv", "losses.csv",
                           "throw.mcap", "throw.json"}) {
    EXPECT_GT(std::filesystem::file_size(folder / made), 20u) << made;
  }
}

TEST(HowTo, ReportsABlockThatFails) {
  const std::vector<Block> blocks =
      BlocksOf("# x\n<!-- run -->\n```sh\nfalse\ntrue\n```\n<!-- file: a -->\n```toml\nb\n```\n");
  ASSERT_EQ(blocks.size(), 2u);
  EXPECT_EQ(blocks[0].text, "false\ntrue\n");
  EXPECT_EQ(blocks[1].file, "a");
  Program shell({"sh", "-c", "set -e\n" + blocks[0].text});
  ASSERT_TRUE(shell.Wait(10));
  EXPECT_NE(shell.status(), 0);
}

}  // namespace how_to_test
}  // namespace seam
