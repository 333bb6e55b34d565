/// A log of --publish own suffices to measure, to draw and to export: each result is compared with
/// the log of --publish all of the same session.

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>

#include "client/embed/cluster.h"
#include "common/measure/contents/contents.h"
#include "common/measure/contents/partial_views.h"
#include "common/measure/measure.h"
#include "common/measure/revisions.h"
#include "common/record/log_file.h"
#include "tests/support/lab_workspace.h"
#include "tests/support/plan/plain_scene.h"
#include "tests/support/program.h"

namespace seam {
namespace publish_own_test {

/// Three players far from each other, each with a cart and crates of its own.
Recording Played(Publish publish, Recorder* recorder = nullptr) {
  PlainScene plain;
  plain.players = 3;
  ClusterConfig config;
  config.scene = "plain";
  config.scene_text = PlainText(plain);
  config.drive = Drive::kBot;
  config.duration_s = 4;
  config.publish = publish;
  config.recorder = recorder;
  return RunCluster(config);
}

class PublishOwn : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    all_ = std::make_unique<Recording>(Played(Publish::kAll));
    own_ = std::make_unique<Recording>(Played(Publish::kOwn));
  }
  static void TearDownTestSuite() {
    all_.reset();
    own_.reset();
  }
  static std::unique_ptr<Recording> all_, own_;
};
std::unique_ptr<Recording> PublishOwn::all_, PublishOwn::own_;

/// A recording with, of each view, only the bodies that another one's view has.
Recording Cut(const Recording& all, const Recording& to) {
  Recording cut = all;
  for (auto& [peer, views] : cut.views) {
    for (auto& [tick, view] : views) {
      const auto& mine = to.views.at(peer).at(tick).id;
      View kept = view;
      kept.id.clear();
      kept.role.clear();
      kept.authority.clear();
      for (auto* column :
           {&kept.x, &kept.y, &kept.angle, &kept.vx, &kept.vy, &kept.spin, &kept.age}) {
        column->clear();
      }
      for (std::size_t i = 0; i < view.id.size(); ++i) {
        if (std::find(mine.begin(), mine.end(), view.id[i]) == mine.end()) continue;
        kept.id.push_back(view.id[i]);
        kept.role.push_back(view.role[i]);
        kept.authority.push_back(view.authority[i]);
        kept.x.push_back(view.x[i]);
        kept.y.push_back(view.y[i]);
        kept.angle.push_back(view.angle[i]);
        kept.vx.push_back(view.vx[i]);
        kept.vy.push_back(view.vy[i]);
        kept.spin.push_back(view.spin[i]);
        kept.age.push_back(view.age[i]);
      }
      view = kept;
    }
  }
  return cut;
}

TEST_F(PublishOwn, ShowsOnlyAPartOfEachViewOfTheSameSession) {
  ASSERT_EQ(all_->views.size(), 4u);
  ASSERT_EQ(own_->views.size(), 4u);
  std::size_t shown_all = 0, shown_own = 0;
  for (const auto& [peer, views] : own_->views) {
    ASSERT_EQ(views.size(), all_->views.at(peer).size());
    for (const auto& [tick, view] : views) {
      const View& whole = all_->views.at(peer).at(tick);
      shown_all += whole.id.size();
      shown_own += view.id.size();
      for (std::size_t i = 0; i < view.id.size(); ++i) {
        const int at = IndexOf(whole, view.id[i]);
        ASSERT_GE(at, 0);
        const auto j = static_cast<std::size_t>(at);
        EXPECT_EQ(view.x[i], whole.x[j]);
        EXPECT_EQ(view.y[i], whole.y[j]);
        EXPECT_EQ(view.authority[i], whole.authority[j]);
        EXPECT_EQ(view.role[i], whole.role[j]);
      }
    }
  }
  EXPECT_LT(shown_own, shown_all) << "it saves nothing";
}

TEST_F(PublishOwn, EveryBodyIsInTheViewOfItsAuthority) {
  std::size_t missing = 0, bodies = 0;
  for (const auto& [tick, whole] : all_->views.at(0)) {
    if (tick == 0) continue;  // the clients' first views are of tick 1
    std::set<PartId> held;
    for (const auto& [peer, views] : own_->views) {
      const auto view = views.find(tick);
      if (view == views.end()) continue;
      held.insert(view->second.id.begin(), view->second.id.end());
    }
    bodies += whole.id.size();
    for (const PartId id : whole.id) missing += held.count(id) == 0 ? 1 : 0;
  }
  EXPECT_GT(bodies, 3000u);
  EXPECT_EQ(missing, 0u);
}

TEST_F(PublishOwn, MeasuresEqualThoseOfTheSameBodiesInFullViews) {
  const Oracle oracle = ComputeOracle(*all_, JudgeOf(all_->room));
  const Oracle from_own = ComputeOracle(*own_, JudgeOf(own_->room));
  ASSERT_EQ(from_own.ids, oracle.ids);
  const Measures all = Measure(*all_, oracle);
  const Measures cut = Measure(Cut(*all_, *own_), oracle);
  const Measures own = Measure(*own_, from_own);
  EXPECT_GT(own.compared, 1000);
  EXPECT_LT(own.compared, all.compared);
  EXPECT_EQ(own.compared, cut.compared);
  EXPECT_EQ(own.error_rms_m, cut.error_rms_m);
  EXPECT_EQ(own.error_max_m, cut.error_max_m);
  EXPECT_EQ(own.stutter_mps2, cut.stutter_mps2);
  // A player's own vehicle and its costs are complete.
  EXPECT_EQ(own.error_own_m, all.error_own_m);
  EXPECT_EQ(own.bytes_per_s, all.bytes_per_s);
}

TEST_F(PublishOwn, TheListAndTheExportReportMissingBodies) {
  const Scene scene = ParseScene(own_->room.scene_text, "plain.toml");
  EXPECT_TRUE(PartialViews(scene, *all_).empty());
  const auto partial = PartialViews(scene, *own_);
  ASSERT_FALSE(partial.empty());
  const auto [peer, bodies] = *partial.begin();
  const auto whole = static_cast<double>(all_->views.at(peer).begin()->second.id.size());
  EXPECT_EQ(bodies.of, whole);
  EXPECT_LT(bodies.shown, whole);
  const std::string list = FormatContents("own.lcm", *own_);
  EXPECT_NE(list.find("views with a part of the bodies only"), std::string::npos) << list;
  EXPECT_EQ(FormatContents("all.lcm", *all_).find("a part of the bodies"), std::string::npos);
}

/// The logs as files, for the programs.
class PublishOwnPrograms : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    files_ = std::make_unique<LabWorkspace>();
    for (const auto& [publish, name] :
         {std::pair(Publish::kAll, "all"), std::pair(Publish::kOwn, "own")}) {
      LogWriter log(At(std::string(name) + ".lcm"));
      Played(publish, &log);
    }
  }
  static void TearDownTestSuite() { files_.reset(); }
  static std::string At(const std::string& name) { return *files_ / name; }
  static std::string Run(std::vector<std::string> words) {
    words[0] = BuiltProgram(words[0]);
    Program program(words);
    EXPECT_TRUE(program.Wait(120));
    EXPECT_EQ(program.status(), 0) << program.Story();
    errors_ = program.errors();
    return program.output();
  }
  static std::unique_ptr<LabWorkspace> files_;
  static std::string errors_;
};
std::unique_ptr<LabWorkspace> PublishOwnPrograms::files_;
std::string PublishOwnPrograms::errors_;

TEST_F(PublishOwnPrograms, TheRowsOfAnExportAreRowsOfTheWholeOne) {
  const auto rows = [](const std::string& csv) {
    std::set<std::string> lines;
    for (std::size_t at = 0, end = 0; (end = csv.find('\n', at)) != std::string::npos; at = end + 1)
      lines.insert(csv.substr(at, end - at));
    return lines;
  };
  const auto all = rows(Run({"seam-export", At("all.lcm"), "--csv"}));
  EXPECT_EQ(errors_.find("a part of the bodies"), std::string::npos) << errors_;
  const auto own = rows(Run({"seam-export", At("own.lcm"), "--csv"}));
  EXPECT_NE(errors_.find("a part of the bodies only"), std::string::npos) << errors_;
  EXPECT_GT(own.size(), 1000u);
  EXPECT_LT(own.size(), all.size());
  for (const std::string& row : own) ASSERT_EQ(all.count(row), 1u) << row;
}

TEST_F(PublishOwnPrograms, APageAPictureAndOtherFormatsAreMadeOfIt) {
  Run({"seam-render", "--page", At("own.lcm"), At("all.lcm"), "-o", At("page.html")});
  Run({"seam-render", At("own.lcm"), "-o", At("own.png"), "--sheet", "4", "--view", "all"});
  Run({"seam-render", At("own.lcm"), "-o", At("frames"), "--view", "p1", "--from", "1", "--to",
       "1.2"});
  for (const char* format : {"--json", "--mcap", "--trace"}) {
    Run({"seam-export", At("own.lcm"), format, "-o", At("own") + (format + 1)});
  }
  const std::string table = Run({"seam-measure", At("own.lcm"), At("all.lcm")});
  EXPECT_NE(errors_.find("own.lcm: views with a part"), std::string::npos) << errors_;
  EXPECT_EQ(errors_.find("all.lcm: views with a part"), std::string::npos) << errors_;
}

}  // namespace publish_own_test
}  // namespace seam
