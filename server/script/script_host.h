#pragma once
/// Interface between Lua and the server: the queries and commands of a script about its room.

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "common/scene/toml/toml_tree.h"
#include "common/scene/types.h"

namespace seam {

/// A script's request that cannot be done; it becomes an error at the script's line.
class ScriptRefusal : public std::runtime_error {
 public:
  explicit ScriptRefusal(const std::string& what) : std::runtime_error(what) {}
};

/// Names parts, joints and players as the scene does. A function that fails throws ScriptRefusal
/// (or OperatorError "file:line: text", for parts and joints that a scene would not allow either)
/// and changes nothing. Returned strings are valid until the next call.
class ScriptHost {
 public:
  virtual ~ScriptHost() = default;

  virtual std::int64_t Tick() const = 0;
  virtual float dt() const = 0;  ///< s per tick

  /// Returns false if there is no such part (any more).
  virtual bool ReadPart(const std::string& part, BodyState* state) const = 0;
  virtual std::size_t PartCount() const = 0;  ///< also counts parts that are gone
  virtual const std::string& PartName(std::size_t index) const = 0;
  virtual std::size_t PlayerCount() const = 0;
  virtual const std::string& PlayerName(std::size_t player) const = 0;
  virtual bool Present(const std::string& player) const = 0;
  virtual Input ReadInput(const std::string& player) const = 0;
  /// Returns the name of the seat that the player sits in; "": none.
  virtual const std::string& SeatOf(const std::string& player) const = 0;

  /// Pushes the part's assembly at its centre of mass with `impulse`, N s; `why` names the push.
  virtual void Push(const std::string& part, const Vec2& impulse, const std::string& why) = 0;
  /// Makes the active character of this name limp for `seconds`, above 0; below 0 ends that.
  virtual void Limp(const std::string& character, float seconds) = 0;
  /// Makes the player get out of its seat.
  virtual void Unseat(const std::string& player) = 0;
  /// Frees the bricks within `radius` m that the blast makes faster than their strength allows, and
  /// throws them outwards with up to `speed` m/s. Pushes parts in view of the blast by up to
  /// `impulse` N s for each metre of silhouette.
  virtual void Blast(const Vec2& centre, float radius, float speed, float impulse) = 0;
  /// `table`: a [[part]] or [[joint]] of a scene, without `repeat`; its line is the script's.
  virtual void AddPart(const TomlNode& table) = 0;
  virtual void AddJoint(const TomlNode& table) = 0;
  /// Makes two parts one body as they are now; the weld holds up to `strength` N (0: for ever).
  virtual void Weld(const std::string& a, const std::string& b, float strength) = 0;
  /// Ends the rigid connections between the two.
  virtual void Unweld(const std::string& a, const std::string& b) = 0;
  virtual void RemovePart(const std::string& part) = 0;
  virtual void RemoveJoint(const std::string& joint) = 0;

  /// A value of a player or part ("score", "health", ...: metadata.h); 0 if it was never set.
  virtual float Get(const std::string& subject, const std::string& key) const = 0;
  virtual void Set(const std::string& subject, const std::string& key, float value) = 0;

  /// Publishes a line of text as an event on the bus.
  virtual void Say(const std::string& text) = 0;
};

/// Returns `[[kind]]` and the table's entries in TOML. Throws ScriptRefusal for a table that TOML
/// of a scene cannot express.
std::string ToToml(const std::string& kind, const TomlNode& table);

}  // namespace seam
