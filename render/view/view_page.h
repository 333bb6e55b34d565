#pragma once
/// The answers of seam-view: the page, its stream of events, and the inputs that a page sends.

#include <cstdint>
#include <functional>
#include <string>

#include "common/base/status.h"
#include "common/net/http_server.h"
#include "common/scene/types.h"

namespace seam {

class ViewPage {
 public:
  /// Does a command to the room; returns one line if it is refused. "": asks for the values alone.
  using Control = std::function<Status(std::int64_t now_us, const std::string& command)>;
  /// `token`: needed to drive and to control; "": nobody may. `drive`: called with each change of
  /// the inputs. Either is empty if it is not possible.
  ViewPage(std::string token, std::function<void(const Input&)> drive, Control control = {});

  HttpResponse Answer(std::int64_t now_us, const HttpRequest& request);
  /// Lets go of the controls when no page has held them for kHeldUs.
  void Tick(std::int64_t now_us);

  /// A page repeats inputs that are held each quarter of a second.
  static constexpr std::int64_t kHeldUs = 1000000;

 private:
  HttpResponse Drive(std::int64_t now_us, const HttpRequest& request);
  HttpResponse Command(std::int64_t now_us, const HttpRequest& request);
  /// True for a page of this server that has the token.
  bool IsTrusted(const HttpRequest& request) const;
  void Set(const Input& input);

  const std::string token_, page_;
  const std::function<void(const Input&)> drive_;
  const Control control_;
  std::int64_t number_ = -1;  // of the newest inputs, since requests may overtake each other
  std::int64_t held_us_ = 0;
  Input input_;
};

/// Parses "NUMBER DRIVE LIFT BUTTONS" (drive and lift -127..127, buttons 0..1023).
bool ParseDrive(const std::string& text, std::int64_t* number, Input* input);

}  // namespace seam
