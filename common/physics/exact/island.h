#pragma once
/// Solves an island that contains a joint as one system, whose rows are joints, limits, motors,
/// contacts and friction. Two solves a substep, at the old and at the new pose (docs/solver.md).

#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "common/physics/exact/contact_rows.h"
#include "common/physics/exact/joint_rows.h"
#include "common/physics/exact/skyline.h"

namespace seam {

class ExactIsland {
 public:
  struct Held {
    const ExactJoint* joint = nullptr;
    ExactJointEnds ends;
    int row = 0, rows = 0;  // its first row, and their number
  };

  /// The island's contents, filled by the caller; then Shape, then Step.
  std::vector<ExactBody> bodies;  ///< moving bodies in the order of the system, then fixed ones
  std::vector<Held> joints;
  std::vector<ExactContact> contacts;
  /// True if all bodies are where the last Step or Rejoin left them, to the last bit, and the
  /// speeds of anchored and kinematic ones are unchanged.
  bool still = false;
  /// True if a body is not where the last Step or Rejoin left it, because an edit, a message or the
  /// engine has moved it: its joints may then be brought together by any lift.
  bool displaced = true;
  /// True if the last Step moved bodies without velocity, so that they are not at rest.
  bool stirred = false;

  /// Makes the rows and the matrix's shape from bodies, joints and contacts (a, b and count must be
  /// set). Returns the number of multiplications of a factorisation. Above `most` no shape is made,
  /// and only another Shape may follow. `relaxed`: the bounded rows are left to Relax; then bodies
  /// with common joints must be neighbours in the list, and `most` is ignored.
  long Shape(bool relaxed, long most);
  int bounded_rows() const { return bounded_; }

  /// Advances the bodies by pace.h * pace.substeps. `warm`: start from the last impulses of
  /// contacts and joints.
  void Step(const Pace& pace, bool warm);
  /// Limit of multiplications of a Step. A Step that exceeds it is aborted and leaves the bodies
  /// here in undefined states.
  long work_most = std::numeric_limits<long>::max();
  bool given_up() const { return work_ > work_most; }
  /// Brings joints together again after something else has moved some of the bodies: positions and,
  /// if some were `struck`, velocities. `pace` as in Step; no time passes.
  void Rejoin(const Pace& pace, bool struck);
  /// Writes the step's impulses to the engine's joints and contacts.
  void Store() const;
  /// Called after Store and reports: limits the contact impulses carried over to the next step to
  /// an amount that the engine's solver recovers from, in case it takes over.
  void BoundWarmStart() const;

 private:
  struct Pair {       // a pair of rows that share a body
    double* at;       // its entry in the matrix
    const double* m;  // of one row's end
    const double* j;  // of the other row's end
  };
  struct Assembled {        // the values of a row in the matrix
    int end = 0, ends = 0;  // its first end among all, and their number
    int pair = 0;           // its first pair among all
    double share = 0, gamma = 0;
  };
  struct InMatrix {  // the values of a row's end in the matrix
    double j[3] = {}, mj[3] = {};
    bool Has(const RowEnd& end) const {
      return end.j[0] == j[0] && end.j[1] == j[1] && end.j[2] == j[2] && end.mj[0] == mj[0] &&
             end.mj[1] == mj[1] && end.mj[2] == mj[2];
    }
    void Take(const RowEnd& end) {
      for (int i = 0; i < 3; ++i) {
        j[i] = end.j[i];
        mj[i] = end.mj[i];
      }
    }
  };
  struct Group {  // a mechanism, or a body without joints
    int group;
    int first_body, bodies;
    int first_row, rows;  // indices in the matrix
  };
  struct Reach {  // a bounded row and its mechanisms
    int row = 0;
    int groups = 0;
    int group[2] = {};
    std::size_t at[2] = {};  // start of its responses in answer_
    double own = 0;          // m/s or rad/s per impulse: the row's own speed
  };
  struct Flying {                         // motion of a mechanism relative to its centre of mass
    double x = 0, y = 0, vx = 0, vy = 0;  // centre of mass: m, m/s
    double inertia = 0, spin = 0, energy = 0;  // kg m2, N m s, J
  };
  struct Flight {  // a mechanism in possible free flight
    int group = -1;
    int first_body = 0, bodies = 0;  // range in flight_bodies_
    int first_row = 0, rows = 0;     // range in flight_rows_: the rows that may push it
    bool flies = false;              // in this substep, unless one of the rows acts
    Flying before;
  };
  struct Act {  // effect of a row on a body
    std::size_t place = 0;
    const double* mj = nullptr;
  };
  struct Shutting {  // a row whose error is being corrected
    std::size_t row = 0, place = 0;
    double goal = 0;  // m or rad
    double side = 0;  // m/s or rad/s, at the last correction
  };
  /// Shares by which diagonal entries of hard and of bounded rows are enlarged, because rows may be
  /// redundant.
  static constexpr double kHardShare = 1e-7, kBoundedShare = 1e-6;
  Row& At(int row) { return rows_[static_cast<std::size_t>(row)]; }
  ExactBody& Body(int body) { return bodies[static_cast<std::size_t>(body)]; }
  long ShapeMatrix(long most);
  void Fill(const Pace& pace);
  void FillAgain(const Pace& pace);
  void FillFirst(const Pace& pace);

  double Pull() const;
  void Look(const Pace& pace);
  static bool Shuts(RowKind kind, double error);
  static void AddApart(RowKind kind, double error, double* sum, double* most);
  double SquaresApart(double* most) const;
  void BringTogether(const Pace& pace, double lift_most);
  double Lifted(const std::vector<ExactBody>& from) const;
  double LiftMost(double time) const;
  void ShiftTogether(double damping);
  void MakeAlike();
  void CopyMasses(const std::vector<ExactBody>& from);
  // The parts of a substep, in their order.
  void Substep(const Pace& pace);
  bool Course(const Pace& pace, bool whole);
  void GoBack(const Pace& pace);
  // Jams.
  struct Start {         // state of a substep after its kick
    double energy = 0;   // J, kinetic
    double mass = 0;     // kg
    double impulse = 0;  // N s, the result of MostImpulse
    double kick = 0;     // J, the part of `energy` that the kick gave
    double lift = 0;     // J, the result of LiftMost
  };
  double MostImpulse(const Pace& pace) const;
  double MostWarmStart(const Pace& pace) const;
  double WorkDone(double mass);
  Start StartOf(const Pace& pace) const;
  bool Possible(const Start& start, bool pushes);
  void KeepPoses();
  void RestorePoses(std::vector<ExactBody>* to) const;
  bool Gains(const Start& start);
  void CheckWithoutContacts(const Pace& pace, bool whole, bool shut);
  void Calm(const Pace& pace, const Start& start);
  void Agree(double h);
  void PushApart(const Pace& pace);
  bool PushesOut() const;
  void Kick(double h);
  void ShapeFlights();
  Flying FlyingOf(const Flight& flight) const;
  void Depart();
  void Arrive();
  bool FindImpacts();
  int FastestImpact();
  void Impact(double pressed);
  bool Blow(const ExactContact& contact, int first_row, double most);
  double Pressed(const ExactContact& contact, int first_row) const;
  bool Holds(double speed) const;
  double AbsorbedEnergy() const;
  bool GiveBack(bool all);
  bool Leads() const, Stops() const;
  void HoldBefore();
  double Driven(const ExactContact& contact, int first_row) const;
  void SolveAhead(const Pace& pace);
  void Move(double h);
  void FindShutting();
  double RightHandSides(const Pace& pace, bool anew, double* slope);
  void Correct(double h);
  bool ShutJoints(const Pace& pace);
  void Accelerate(double slope);
  void SoftenContacts();
  void SolveAtEnd(const Pace& pace, double hard, int rounds);

  // The tension of joints as additional inertia.
  static double Stiffened(const ExactBody& q);
  void Tension(double h);
  bool Stiffer();
  /// The inertia is computed anew, so often at most, while it is too small by more than this
  /// factor.
  static constexpr double kStifferBy = 1.1;
  static constexpr int kStifferTries = 4;
  /// Share of the stiffness left per substep without tension: inertias that jump cause noise.
  static constexpr double kLasts = 0.999;

  // Taut mechanisms.
  bool Taut(double h) const;
  bool TautCourse(const Pace& pace);
  void Stiffen();
  bool TooSoft() const;
  bool CloseTaut(const Pace& pace);
  double SquaresHere(const Pace& pace, double* most);
  void PushTautApart(const Pace& pace);
  void FindWay(const Pace& pace);

  // The system of rows, for the current velocities.
  void Assemble(double hard = kHardShare, double bounded = kBoundedShare);
  bool Assembles(double hard, double bounded);
  int FirstChanged(double hard, double bounded);
  void Factor();
  /// Most rounds in which friction follows the normal impulses.
  static constexpr int kFrictionRounds = 3;
  void Solve(bool ahead, int rounds = kFrictionRounds);
  bool PivotToTheEnd();
  bool Pivot(int* wrong);
  void SetFrictionBounds();
  bool NextFrictionBounds();
  void Descend();
  void HoldJoints();

  // Piles.
  void ShapeGroups();
  void FindAnswer(Reach* reach);
  void Respond(const Reach& reach, double impulse);
  void Sweep(bool friction);
  void Relax(bool ahead);

  double Speed(const Row& row) const;
  void Push(const Row& row, double impulse);
  void Shift(const Row& row, double by);
  void Save(std::vector<double>* velocities) const;
  void Restore(const std::vector<double>& velocities);

  std::vector<Row> rows_, rows_before_;
  std::vector<Row> now_;  // rows of one joint, while its errors are corrected
  std::vector<RowEnd> now_ends_;
  std::vector<ExactBody> bodies_before_;
  std::vector<RowEnd> ends_;
  std::vector<int> contact_row_;  // by contact: its first row
  std::vector<int> place_;        // by row: its index in the matrix
  std::vector<int> row_at_;       // by index in the matrix: its row
  std::vector<Row*> by_place_;    // by index in the matrix
  std::vector<int> bounded_places_;
  std::vector<Pair> pairs_;           // in the order of matrix indices
  std::vector<Assembled> assembled_;  // by index in the matrix
  std::vector<InMatrix> in_matrix_;   // by end
  Skyline matrix_;
  int bounded_ = 0;
  long work_ = 0;                // multiplications of this Step so far
  double turned_ = 0;            // rad: the largest rotation of a body in this substep
  int changed_ = 0;              // first row of the matrix that differs from the assembled one
  int dirty_ = 0;                // first row whose factors are outdated
  double gained_ = 0;            // J: energy gained in substeps with contacts, decaying slowly
  double carried_ = 0;           // N s: limit of a contact's impulse for the next step
  double filled_h_ = 0;          // s: the substep for which rows were written
  bool rewritten_ = true;        // rows were rewritten since they were assembled
  double hard_ = 0, bound_ = 0;  // the shares used for assembling
  bool moved_ = false;           // velocities differ from before_
  std::vector<char> in_;
  std::vector<double> x_, before_, start_;
  std::vector<double> poses_;         // poses at the beginning of the substep
  std::vector<double> errors_;        // by row: errors of joints, m or rad
  std::vector<double> last_, shift_;  // the last correction: as solved, as applied
  std::vector<Shutting> shutting_;    // in the order of matrix indices
  std::vector<Act> acts_;  // by body, ExactBody::acts each, in the order of matrix indices
  bool relaxed_ = false;
  std::vector<Group> groups_;
  std::vector<Reach> reaches_;                            // in the order of rows
  std::vector<std::vector<std::pair<int, int>>> joined_;  // by body: index in the matrix, end
  std::vector<double> answer_, velocity_;
  std::vector<Flight> flights_;
  std::vector<int> flight_bodies_, flight_rows_;
  std::vector<RowState> next_;  // by index in the matrix
  std::vector<RowState> held_;  // saved while some rows take no part
  // Scratch space of Shape.
  std::vector<int> ends_of_, first_, lead_;            // by row; by index in the matrix; by body
  std::vector<std::pair<int, int>> key_;               // by row
  std::vector<std::vector<std::pair<int, int>>> met_;  // by body: row, end
};

inline double ExactIsland::Speed(const Row& row) const {
  double speed = row.fixed_speed;
  const RowEnd* const stop = row.end + row.ends;
  for (const RowEnd* end = row.end; end != stop; ++end) {
    const ExactBody& q = bodies[static_cast<std::size_t>(end->body)];
    speed += end->j[0] * q.vx + end->j[1] * q.vy + end->j[2] * q.w;
  }
  return speed;
}

inline void ExactIsland::Push(const Row& row, double impulse) {
  if (impulse == 0) return;
  const RowEnd* const stop = row.end + row.ends;
  for (const RowEnd* end = row.end; end != stop; ++end) {
    ExactBody& q = Body(end->body);
    q.vx += impulse * end->mj[0];
    q.vy += impulse * end->mj[1];
    q.w += impulse * end->mj[2];
  }
}

/// Returns the kinetic energy of the moving bodies, J.
double KineticOf(const std::vector<ExactBody>& bodies);

/// Moves bodies back until they are at `share` of their way from `from`.
void GoShare(const std::vector<ExactBody>& from, double share, std::vector<ExactBody>* bodies);

}  // namespace seam
