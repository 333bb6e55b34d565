#include "server/edits/edit_line.h"

#include <cmath>
#include <iterator>
#include <optional>
#include <sstream>
#include <vector>

#include "common/base/check.h"
#include "common/base/nearest.h"

namespace seam {
namespace {

/// The words of a line, read one after the other.
class Words {
 public:
  Words(const std::string& line, const Topology& topology)
      : line_(line), topology_(topology), in_(line) {}

  std::string Word() {
    std::string word;
    if (!(in_ >> word)) Fail("has too few words");
    return word;
  }
  float Number() {
    const std::string word = Word();
    std::istringstream text(word);
    float number = 0;
    if (!(text >> number) || !text.eof() || !std::isfinite(number)) Fail(word + " is no number");
    return number;
  }
  PartId Part() {
    const std::string name = Word();
    std::vector<std::string> names;
    for (const seam::Part& part : topology_.scene().parts) {
      if (part.name == name) return part.id;
      names.push_back(part.name);
    }
    Fail("no part " + name + " (" + Suggestion(name, names) + ")");
  }
  std::string Rest() {
    in_ >> std::ws;
    return {std::istreambuf_iterator<char>(in_), {}};
  }
  void End() {
    std::string more;
    if (in_ >> more) Fail("has a word too many: " + more);
  }
  [[noreturn]] void Fail(const std::string& why) const {
    throw OperatorError("\"" + line_ + "\": " + why);
  }

 private:
  const std::string& line_;
  const Topology& topology_;
  std::istringstream in_;
};

/// Returns the joint that is named, or of this number, if it is there.
int JointOf(Words* words, const Topology& topology) {
  const PartId a = words->Part(), b = words->Part();
  const std::vector<Joint>& joints = topology.scene().joints;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const bool between =
        (joints[j].a == a && joints[j].b == b) || (joints[j].a == b && joints[j].b == a);
    if (between && topology.HasJoint(static_cast<int>(j))) return static_cast<int>(j);
  }
  words->Fail("has no joint between these parts");
}

AnyEdit Parse(Words* words, const Topology& topology) {
  const std::string kind = words->Word();
  if (kind == "remove") return RemoveEdit{words->Part()};
  if (kind == "free") return FreeEdit{words->Part()};
  if (kind == "break") return BreakEdit{JointOf(words, topology)};
  if (kind == "push") {
    const PartId part = words->Part();
    const float x = words->Number(), y = words->Number();
    return PushEdit{part, Vec2(x, y)};
  }
  if (kind == "blast") {
    const float x = words->Number(), y = words->Number(), radius = words->Number();
    const float speed = words->Number(), impulse = words->Number();
    return BlastEdit{Vec2(x, y), radius, speed, impulse};
  }
  if (kind == "insert") return InsertEdit{words->Rest()};
  words->Fail("is none of: " + EditLineHelp());
}

}  // namespace

std::string EditLineHelp() {
  return "remove PART | free PART | break PART PART | push PART X Y (N s) | "
         "blast X Y RADIUS SPEED IMPULSE | insert TOML";
}

Edit ParseEditLine(const std::string& line, const Topology& topology) {
  Words words(line, topology);
  const Edit edit(Parse(&words, topology), EditCause::kOutside);
  words.End();
  const Status status = topology.Validate(edit);
  if (!status.ok()) words.Fail(status.why());
  return edit;
}

}  // namespace seam
