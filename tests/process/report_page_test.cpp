/// The report's page in a browser: the first answer follows the choices, figures answer the mouse,
/// methods and scenes can be hidden, and there is no error in the console.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>

#include "tests/support/browser/browser.h"
#include "tests/support/render_synthetic.h"

namespace seam {
namespace report_page_test {

/// A table of two scenes at two latencies: in wall fade errs less, at 100 ms in stack strict does.
std::string LatencyCsv() {
  std::string text =
      "version,scene,mode,reconcile,impair,send_hz,drive,smooth,duration_s,seed,"
      "error_rms_m,stutter_mps2,bytes_per_s,cpu_s\n";
  const auto add = [&](const char* scene, const char* method, int ms, const char* error) {
    for (const char* seed : {"1", "2", "3"})
      text += std::string("v,scenes/") + scene + ".toml," + method +
              ",\"delay=" + std::to_string(ms) + "ms,loss=2%\",30,script,on,10," + seed + ',' +
              error + ",8,2000,0.05\n";
  };
  for (const int ms : {50, 100}) {
    add("wall", "buffer,fade", ms, "0.002");
    add("wall", "strict,", ms, "0.03");
    add("stack", "buffer,fade", ms, ms == 50 ? "0.004" : "0.5");
    add("stack", "strict,", ms, "0.06");
  }
  return text;
}

class ReportInBrowser : public ::testing::Test {
 protected:
  void SetUp() override {
    if (Browser::Find().empty()) GTEST_SKIP() << "no chromium here: apt-get install chromium";
    std::filesystem::create_directory(folder_ / "data");
    std::ofstream(folder_ / "data/latency.csv") << LatencyCsv();
    Program report({BuiltProgram("seam-lab"), "report", folder_ / "data", "-o", folder_ / "out"});
    ASSERT_TRUE(report.Wait(120) && report.status() == 0) << report.Story();
    browser_ = std::make_unique<Browser>(1300, 1000);
    Open("answers");
  }
  void Open(const std::string& chapter) {
    ASSERT_TRUE(browser_->Open(folder_ / "out/index.html", chapter,
                               "document.querySelector('.chapter.shown')"));
  }
  void TearDown() override {
    if (browser_ == nullptr) return;
    for (const std::string& complaint : browser_->complaints()) {
      const bool picture = complaint.find("/plots/") != std::string::npos;
      if (!picture) ADD_FAILURE() << complaint;
    }
  }
  void Ask(const std::string& field, const std::string& value) {
    browser_->Evaluate("(() => { const f = document.querySelector('.ask'); f." + field +
                       ".value = '" + value +
                       "'; f.dispatchEvent(new Event('input')); return 1; })()");
  }
  std::string Verdict() {
    return browser_->Evaluate("document.querySelector('.verdict').textContent");
  }

  const Workspace folder_;
  std::unique_ptr<Browser> browser_;
};

TEST_F(ReportInBrowser, RecommendsAMethodForTheChosenLatencyAndScene) {
  Ask("latency", "60");
  Ask("scene", "stack");
  EXPECT_EQ(Verdict(), "Use fade: error 0.004 m, 5 ms of CPU per second, 2 kB/s.");
  Ask("latency", "90");
  EXPECT_EQ(Verdict(), "Use strict: error 0.06 m, 5 ms of CPU per second, 2 kB/s.");
  Ask("scene", "wall");
  EXPECT_EQ(Verdict(), "Use fade: error 0.002 m, 5 ms of CPU per second, 2 kB/s.");
}

TEST_F(ReportInBrowser, AFigureAnswersTheMouseAndHidesDisabledMethods) {
  Open("latency");
  EXPECT_EQ(browser_->Number("document.querySelectorAll('.chapter.shown').length"), 1);
  const std::string curves = "document.querySelectorAll('.shown .plot [data-curve=fade]').length";
  EXPECT_GT(browser_->Number(curves), 0);
  const std::string tip = browser_->Evaluate(
      "(() => { const dot = document.querySelector('.shown "
      "[data-curve=fade] circle').getBoundingClientRect();"
      "document.querySelector('.shown .plot').dispatchEvent(new PointerEvent("
      "'pointermove', {clientX: dot.x + 3, clientY: dot.y + 3}));"
      "return document.querySelector('.tip').textContent; })()");
  EXPECT_EQ(tip.rfind("fade", 0), 0u) << tip;
  EXPECT_NE(tip.find("one-way latency (ms): 50"), std::string::npos) << tip;
  browser_->Click(".shown .legend button");  // strict, the first
  EXPECT_EQ(browser_->Number("document.querySelectorAll('.shown [data-curve=strict]').length"), 0);
  EXPECT_GT(browser_->Number(curves), 0);
}

TEST_F(ReportInBrowser, ASceneCanBeChosenAndTheScaleMadeLinear) {
  Open("latency");
  const auto choose = [&](const char* select, const char* value) {
    browser_->Evaluate(std::string("(() => { const s = document.querySelector('") + select +
                       "'); s.value = '" + value +
                       "'; s.dispatchEvent(new Event('input')); return 1; })()");
  };
  const std::string high = "document.querySelector('.shown [data-curve=strict] circle').cy.baseVal";
  const double before = browser_->Number(high + ".value");
  choose("#scale", "linear");
  EXPECT_NE(browser_->Number(high + ".value"), before);
  choose("#scene-filter", "stack");
  EXPECT_EQ(browser_->Number("[...document.querySelectorAll('.shown [data-scene]')].filter("
                             "i => !i.hidden && i.dataset.scene !== 'stack').length"),
            0);
  EXPECT_GT(browser_->Number("[...document.querySelectorAll('.shown [data-scene=stack]')].filter("
                             "i => !i.hidden).length"),
            0);
}

}  // namespace report_page_test
}  // namespace seam
