/// A review page carries the recording: decoded, it is within half a millimetre, half a milliradian
/// and half a unit of error.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "common/measure/percentile.h"
#include "render/commands.h"
#include "render/page/document.h"
#include "render/page/gzip.h"
#include "common/base/json_text.h"
#include "render/page/tracks.h"
#include "tests/render/page_reader.h"
#include "tests/support/render_fixture.h"

namespace seam {
namespace page_data_test {

/// Floats of metres are not exact to the last digit.
constexpr double kHalf = 0.5 + 1e-3;

PageTracks Decoded(const PageBytes& bytes, bool views) {
  PageReader reader(bytes);
  const PageTracks tracks = reader.Tracks(views);
  EXPECT_TRUE(reader.AtEnd());
  return tracks;
}

void ExpectSame(const std::map<std::int64_t, View>& views, const Oracle& oracle,
                const PageTracks& tracks) {
  std::size_t samples = 0, expected = 0;
  for (const auto& [tick, view] : views) {
    for (std::size_t i = 0; i < view.id.size(); ++i) {
      ++expected;
      const auto& body = tracks.bodies.at(view.id[i]);
      ASSERT_EQ(body.samples.count(tick), 1u) << tick;
      const PageBody::Sample& sample = body.samples.at(tick);
      ASSERT_NEAR(static_cast<double>(sample.x), 1000 * double{view.x[i]}, kHalf);
      ASSERT_NEAR(static_cast<double>(sample.y), 1000 * double{view.y[i]}, kHalf);
      ASSERT_NEAR(static_cast<double>(sample.angle), 1000 * double{view.angle[i]}, kHalf);
      ASSERT_EQ(sample.owner, 3 * view.authority[i] + view.role[i]);
      const auto truth = oracle.At(tick, view.id[i]);
      if (!truth) {
        ASSERT_EQ(sample.error, -1);
        continue;
      }
      const double error = std::hypot(double{view.x[i]} - double{truth->position.x()},
                                      double{view.y[i]} - double{truth->position.y()});
      ASSERT_NEAR(static_cast<double>(sample.error), error / kPageErrorUnit_m, kHalf);
    }
  }
  for (const auto& [id, body] : tracks.bodies) samples += body.samples.size();
  EXPECT_EQ(samples, expected) << "poses that the recording does not have";
}

PageTracks RoundTrip(const Recording& recording, const Oracle& oracle, int peer) {
  const auto& views = recording.views.at(peer);
  const auto world_at = [&](std::int64_t tick) { return views.count(tick) > 0 ? 0 : -1; };
  return Decoded(EncodeTracks(TracksOf(views, &oracle), recording.first_tick, recording.last_tick,
                              world_at, true),
                 true);
}

TEST(PageData, EveryPoseIsTheRecordingsWithinHalfAMillimetreAndAMilliradian) {
  const Recording recording = synthetic::MakeRecording(6);
  const Oracle oracle = synthetic::MakeOracle();
  for (const auto& [peer, views] : recording.views)
    ExpectSame(views, oracle, RoundTrip(recording, oracle, peer));
}

TEST(PageData, JumpsSpinsGapsAndBodiesThatComeAndGoAreKept) {
  Recording recording = synthetic::MakeRecording(6);
  std::mt19937 chance(7);
  auto& views = recording.views[1];
  for (auto& [tick, view] : views) {
    for (std::size_t i = 0; i < view.id.size(); ++i) {
      view.x[i] += static_cast<float>(static_cast<int>(chance() % 2000) - 1000);
      view.angle[i] = 40.0f * static_cast<float>(tick);
      view.authority[i] = static_cast<std::int8_t>(chance() % 100);
    }
    if (chance() % 3 == 0) {  // not all are shown
      view.id.pop_back();
      view.x.pop_back();
    }
  }
  for (const int tick : {0, 20, 21, 22, 90, 180}) views.erase(tick);
  const Oracle oracle = synthetic::MakeOracle();
  const PageTracks tracks = RoundTrip(recording, oracle, 1);
  ExpectSame(views, oracle, tracks);
  EXPECT_EQ(tracks.first, 0);
  ASSERT_EQ(tracks.world.size(), 181u);
  EXPECT_EQ(tracks.world[21], -1);
  EXPECT_EQ(tracks.world[23], 0);
}

TEST(PageData, APoseUnknownToTheOracleHasNoError) {
  const Recording recording = synthetic::MakeRecording(6);
  Oracle oracle = synthetic::MakeOracle();
  oracle.ticks.resize(50);
  const PageTracks tracks = RoundTrip(recording, oracle, 2);
  EXPECT_GE(tracks.bodies.at(1).samples.at(49).error, 0);
  EXPECT_EQ(tracks.bodies.at(1).samples.at(50).error, -1);
}

TEST(PageData, ALateViewIsComparedWithTheTickThatItShows) {
  Recording recording = synthetic::MakeRecording(6);
  const Oracle oracle = synthetic::MakeOracle();
  EXPECT_GT(Measure(recording, oracle).shown_error_rms_m, 0.01) << "nothing to compare";
  synthetic::SayAges(6, &recording);
  const Measures measures = Measure(recording, oracle);
  EXPECT_GT(measures.error_rms_m, 0.01) << "the error of the present has the age";
  EXPECT_LT(measures.shown_error_rms_m, 1e-6);
  for (const auto& [peer, views] : recording.views) {
    for (const auto& [id, body] : RoundTrip(recording, oracle, peer).bodies) {
      for (const auto& [tick, sample] : body.samples) {
        const View& view = views.at(tick);
        const auto i = static_cast<std::size_t>(IndexOf(view, id));
        EXPECT_EQ(static_cast<double>(sample.age) * kPageAgeUnit, double{view.age[i]});
        ASSERT_TRUE(sample.error == 0 || tick < 6) << tick;
      }
    }
  }
}

TEST(PageData, ErrorsSumToTheMeasuresNumbers) {
  const Recording recording = synthetic::MakeRecording(6);
  const Oracle oracle = synthetic::MakeOracle();
  const Measures measures = Measure(recording, oracle);
  std::vector<double> errors;
  double squares = 0;
  for (const auto& [peer, views] : recording.views) {
    for (const auto& [id, body] : RoundTrip(recording, oracle, peer).bodies) {
      for (const auto& [tick, sample] : body.samples) {
        errors.push_back(static_cast<double>(sample.error) * kPageErrorUnit_m);
        squares += errors.back() * errors.back();
      }
    }
  }
  ASSERT_EQ(static_cast<std::int64_t>(errors.size()), measures.compared);
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(errors.size())), measures.shown_error_rms_m,
              5e-5);
  EXPECT_NEAR(Percentile(errors, 0.95), measures.shown_error_p95_m, 5.1e-5);
  EXPECT_GT(measures.shown_error_p95_m, 0.01) << "nothing to compare";
}

TEST(PageData, NumbersOfAnySizeComeBack) {
  PageBytes bytes;
  const std::vector<std::int64_t> values = {
      0, -1, 1, -64, 63, 64, 1 << 20, -(std::int64_t{1} << 52), std::int64_t{1} << 52};
  for (const std::int64_t value : values) PutSigned(&bytes, value);
  PutSecondDifferences(&bytes, values);
  PutRuns(&bytes, {5, 5, 5, -2, 5});
  PageReader reader(bytes);
  for (const std::int64_t value : values) EXPECT_EQ(reader.Signed(), value);
  EXPECT_EQ(reader.SecondDifferences(static_cast<std::int64_t>(values.size())), values);
  EXPECT_EQ(reader.Runs(), (std::vector<std::int64_t>{5, 5, 5, -2, 5}));
  EXPECT_TRUE(reader.AtEnd());
}

TEST(PageData, ThePagesCompressedDataIsReproducible) {
  const Playback playback(synthetic::MakeRecording(6), synthetic::MakeScene(),
                          synthetic::MakeOracle());
  const std::vector<PageRun> runs = {{"run", &playback, ""}};
  const std::string html = PageHtml(runs);
  EXPECT_EQ(html, PageHtml(runs));
  const std::string mark = "id=\"data\">";
  const std::size_t begin = html.find(mark);
  ASSERT_NE(begin, std::string::npos);
  const std::vector<std::uint8_t> data = Gunzip(FromBase64(html.substr(begin + mark.size())));
  EXPECT_EQ(data, PageData(runs));
  std::uint32_t length = 0;
  std::memcpy(&length, data.data(), 4);
  const std::string head(data.begin() + 4, data.begin() + 4 + length);
  EXPECT_EQ(head.front(), '{');
  EXPECT_EQ(head.back(), '}');
  EXPECT_NE(head.find("\"views\":[{\"peer\":0,"), std::string::npos);
}

using PageFlags = RenderLog;

TEST_F(PageFlags, WritesAPageOrNamesAMistakeAndWritesNothing) {
  const auto run = [&](std::vector<std::string> words) {
    std::vector<const char*> arguments = {"seam-render", "--page"};
    for (const std::string& word : words) arguments.push_back(word.c_str());
    return RenderMain(static_cast<int>(arguments.size()), arguments.data());
  };
  const std::string out = folder_ / "review.html";
  EXPECT_EQ(run({log_, "-o", folder_ / "review.png"}), 2);
  EXPECT_EQ(run({log_, "-o", out, "--view", "1"}), 2);
  EXPECT_EQ(run({log_, "-o", out, "--strobe"}), 2);
  EXPECT_EQ(run({log_, "-o", out, "--from", "1"}), 2);
  EXPECT_EQ(run({"-o", out}), 2);
  EXPECT_EQ(run({log_, folder_ / "none.lcm", "-o", out}), 2);
  EXPECT_EQ(folder_.List(), untouched_);
  ASSERT_EQ(run({log_, strict_, "-o", out}), 0);
  EXPECT_NE(Content(out).find("id=\"data\""), std::string::npos);
}

TEST(PageData, APageAsksForNothingFromOutside) {
  const Playback playback(synthetic::MakeRecording(6), synthetic::MakeScene(),
                          synthetic::MakeOracle());
  const std::string html = PageHtml({{"run", &playback}});
  EXPECT_NE(html.find("default-src 'none'"), std::string::npos);
  for (const char* const door : {"src=", "@import", "url(", "fetch(", "XMLHttp", "innerHTML",
                                 "insertAdjacentHTML", "document.write", "eval("}) {
    const std::size_t at = html.find(door);
    // A clip path of a picture that is saved names a place in itself.
    const bool own = std::string(door) == "url(" && html.compare(at, 5, "url(#") == 0;
    EXPECT_TRUE(at == std::string::npos || own) << door;
  }
  EXPECT_EQ(html.find("{{"), std::string::npos) << "the template was not filled in";
}

TEST(PageJson, IsAsciiWithoutAnythingThatHtmlReads) {
  EXPECT_EQ(JsonText("a\"b\\c\n</script>"), "\"a\\u0022b\\u005cc\\u000a\\u003c/script\\u003e\"");
  EXPECT_EQ(JsonText("\xc3\xa9\xe2\x80\xa8\xf0\x9f\x98\x80"), "\"\\u00e9\\u2028\\ud83d\\ude00\"");
  EXPECT_EQ(JsonText("\xff\xc3(\xed\xa0\x80"), "\"\\ufffd\\ufffd(\\ufffd\\ufffd\\ufffd\"");
  EXPECT_EQ(JsonText("\xe2\x80"), "\"\\ufffd\\ufffd\"");
  EXPECT_EQ(JsonNumber(1.50, 3), "1.5");
  EXPECT_EQ(JsonNumber(-0.0001, 3), "0");
  EXPECT_EQ(JsonNumber(100, 0), "100");
  EXPECT_EQ(JsonNumber(std::nan(""), 3), "null");
}

TEST(PageJson, Base64IsTheStandards) {
  const auto of = [](const std::string& text) { return Base64({text.begin(), text.end()}); };
  EXPECT_EQ(of(""), "");
  EXPECT_EQ(of("f"), "Zg==");
  EXPECT_EQ(of("fo"), "Zm8=");
  EXPECT_EQ(of("foobar"), "Zm9vYmFy");
}

}  // namespace page_data_test
}  // namespace seam
