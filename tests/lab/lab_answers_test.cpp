/// "Your latency and loss: use this": the scenes that each answer covers.

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <variant>

#include "tests/lab/report/html/answers.h"

namespace seam {
namespace lab_answers_test {

TEST(Answers, ASceneWithFewMethodsDoesNotJudgeTheOthers) {
  // In wall three methods, fade with the least error; in stack strict alone.
  std::string csv =
      "version,scene,mode,reconcile,impair,send_hz,drive,smooth,duration_s,seed,error_rms_m,"
      "stutter_mps2,rebound,handover_jump_m,floor_m,bytes_per_s,cpu_s\n";
  for (const auto& [run, error] :
       {std::pair{"wall.toml,buffer,fade", "0.02"}, std::pair{"wall.toml,buffer,snap", "0.5"},
        std::pair{"wall.toml,strict,", "0.4"}, std::pair{"stack.toml,strict,", "0.001"}}) {
    for (const char* ms : {"50", "100"}) {
      csv += std::string("v,scenes/") + run + ",\"delay=" + ms + "ms,loss=2%\",30,script,on,10,1," +
             error + ",8,1,0,1e-06,2000,0.05\n";
    }
  }
  CsvTable table = CsvTable::Parse(csv, "latency.csv");
  SweepView view = ViewSweep(table);
  const Section section =
      AnswersSection({{"latency", "seam-lab sweep x", std::move(table), std::move(view)}});
  const TextTable* answers = nullptr;
  for (const PageItem& item : section.items) {
    if (const auto* found = std::get_if<TextTable>(&item)) answers = found;
  }
  ASSERT_NE(answers, nullptr);
  ASSERT_EQ(answers->rows.size(), 2u);
  EXPECT_EQ(answers->rows[0][0], "50 ms, 2 % loss");
  EXPECT_EQ(answers->rows[0][1], "fade") << "although only strict ran in both scenes";
  EXPECT_EQ(answers->rows[0].back(), "1");
}

}  // namespace lab_answers_test
}  // namespace seam
