#pragma once
/// An island that contains a joint, as one system: joints, limits, motors, contacts and friction
/// are its rows. Two solves a substep, at the old and at the new pose (docs/solver.md).

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
    JointEnds ends;
    int row = 0, rows = 0;  // of its rows: the first, how many
  };

  /// What it consists of. Filled by whoever finds it; then Shape, then Step.
  std::vector<ExactBody> bodies;  ///< moving ones, in the order of the system, then fixed ones
  std::vector<Held> joints;
  std::vector<ExactContact> contacts;
  /// Whether all bodies are where the last Step or Rejoin left them, to the last bit, and what does
  /// not move freely has the same speed.
  bool still = false;
  /// Whether the last Step moved something without velocity, so that it does not lie.
  bool stirred = false;

  /// The rows and the matrix's shape from bodies, joints and contacts (of which a, b and count
  /// are there). Returns the multiplications of a factorisation; what takes more than `most` of
  /// them has no shape then, and only another Shape may follow.
  /// `relaxed`: the bounded rows are left to Relax; then bodies that have joints with each other
  /// must be neighbours in the list, and there is no `most`.
  long Shape(bool relaxed, long most);
  int bounded_rows() const { return bounded_; }

  /// Advances the bodies by pace.h * pace.substeps. `warm`: begin with what contacts and joints
  /// had last.
  void Step(const Pace& pace, bool warm);
  /// A Step that takes more multiplications than `work_most` is broken off, and the bodies here are
  /// nowhere then.
  long work_most = std::numeric_limits<long>::max();
  bool given_up() const { return work_ > work_most; }
  /// After something else has moved some of the bodies: brings the joints together again, positions
  /// and, if some were `struck`, velocities. `pace` as in Step; no time passes.
  void Rejoin(const Pace& pace, bool struck);
  /// What the step did, to the engine's joints and contacts.
  void Store() const;
  /// After Store and reports: what contacts take along to the next step, which may be the engine's,
  /// is no more than the engine's rounds come back from.
  void BoundCarried() const;

 private:
  struct Pair {       // of rows that share a body
    double* at;       // in the matrix
    const double* m;  // of one's end
    const double* j;  // of the other's
  };
  struct Assembled {        // what the matrix has of a row
    int end = 0, ends = 0;  // of all ends: the first, how many
    int pair = 0;           // of all pairs: the first
    double share = 0, gamma = 0;
  };
  struct InMatrix {  // what it has of an end
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
    int first_row, rows;  // places
  };
  struct Reach {  // of a bounded row
    int row = 0;
    int groups = 0;
    int group[2] = {};
    std::size_t at[2] = {};  // of its answer
    double own = 0;          // m/s or rad/s per impulse: its own speed
  };
  struct Flying {                              // of a mechanism, against its centre of mass
    double x = 0, y = 0, vx = 0, vy = 0;       // of that: m, m/s
    double inertia = 0, spin = 0, energy = 0;  // kg m2, N m s, J
  };
  struct Flight {  // a mechanism that may fly
    int group = -1;
    int first_body = 0, bodies = 0;  // of flight_bodies_
    int first_row = 0, rows = 0;     // of flight_rows_: what may push it
    bool flies = false;              // in this substep, if none of them does
    Flying before;
  };
  struct Act {  // what a row does to a body
    std::size_t place = 0;
    const double* mj = nullptr;
  };
  struct Shutting {  // a row that is being shut
    std::size_t row = 0, place = 0;
    double goal = 0;  // m or rad
    double side = 0;  // m/s or rad/s, of the last correction
  };
  Row& At(int row) { return rows_[static_cast<std::size_t>(row)]; }
  ExactBody& Body(int body) { return bodies[static_cast<std::size_t>(body)]; }
  long ShapeMatrix(long most);
  void Fill(const Pace& pace);
  void FillAgain(const Pace& pace);
  void FillFirst(const Pace& pace);

  double Pull() const;
  void Look(const Pace& pace);
  static bool Shuts(const Row& row);
  double SquaresApart(double* most) const;
  void BringTogether(const Pace& pace);
  void ShiftTogether(double damping);
  void MakeAlike();
  void TakeMassesOf(const std::vector<ExactBody>& from);
  // Of a substep, in their order.
  void Substep(const Pace& pace);
  bool Course(const Pace& pace, bool whole);
  void GoBack(const Pace& pace);
  // Jams.
  struct Start {         // of a substep, after its kick
    double energy = 0;   // J, kinetic
    double mass = 0;     // kg
    double impulse = 0;  // N s, MostImpulse
  };
  double MostImpulse(const Pace& pace) const;
  double MostCarried(const Pace& pace) const;
  double WorkDone(double mass);
  Start StartOf(const Pace& pace) const;
  bool Possible(const Start& start, bool pushes);
  void KeepPoses();
  void Doubt(const Pace& pace, bool whole);
  void Calm(const Pace& pace, const Start& start);
  void PushApart(const Pace& pace);
  bool PushesOut() const;
  void Kick(double h);
  void ShapeFlights();
  Flying FlyingOf(const Flight& flight) const;
  void Depart();
  void Arrive();
  bool FindImpacts();
  int FastestBlow();
  void Impact(double pressed);
  bool Blow(const ExactContact& contact, int first_row, double most);
  double Pressed(const ExactContact& contact, int first_row) const;
  bool Holds(double speed) const;
  double Yielded() const;
  bool GiveBack(bool all);
  bool Leads() const, Stops() const;
  void HoldBefore();
  double Driven(const ExactContact& contact, int first_row) const;
  void SolveAhead(const Pace& pace);
  void Move(double h);
  void FindShutting();
  double SidesOfErrors(const Pace& pace, bool anew, double* slope);
  void Correct(double h);
  bool ShutJoints(const Pace& pace);
  void Accelerate(double slope);
  void SoftenContacts();
  void SolveAtEnd(const Pace& pace);

  // The tension of joints as inertia.
  static double Stiffened(const ExactBody& q);
  void Tension(double h);
  bool Stiffer();

  // The system of rows, for the velocities as they are.
  /// `hard`, `bounded`: what a row's own entry is enlarged by, as a share, for rows that others
  /// imply.
  static constexpr double kHardShare = 1e-7, kBoundedShare = 1e-6;
  void Assemble(double hard = kHardShare, double bounded = kBoundedShare);
  bool Assembles(double hard, double bounded);
  int FirstChanged(double hard, double bounded);
  void Factor();
  void Solve(bool ahead);
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
  std::vector<Row> now_;  // of one joint, while it is shut
  std::vector<RowEnd> now_ends_;
  std::vector<ExactBody> bodies_before_;
  std::vector<RowEnd> ends_;
  std::vector<int> contact_row_;  // by contact: the first of its rows
  std::vector<int> place_;        // by row: its index in the matrix
  std::vector<int> row_at_;       // the other way round
  std::vector<Row*> by_place_;    // the rows that are in the matrix
  std::vector<int> bounded_places_;
  std::vector<Pair> pairs_;           // in the order of places
  std::vector<Assembled> assembled_;  // by place
  std::vector<InMatrix> in_matrix_;   // by end
  Skyline matrix_;
  int bounded_ = 0;
  long work_ = 0;                // multiplications of this Step so far
  double turned_ = 0;            // rad: the most that a body has turned in this substep
  int changed_ = 0;              // the matrix's rows from here on are not those that were assembled
  int dirty_ = 0;                // the factors of rows from here on are old
  double gained_ = 0;            // J: what substeps with contacts have gained, falling slowly
  double carried_ = 0;           // N s: what a contact's impulse may be for the next step
  double filled_h_ = 0;          // s: the substep that rows were written for
  bool rewritten_ = true;        // rows were, since they were assembled
  double hard_ = 0, bound_ = 0;  // what that was done with
  bool moved_ = false;           // velocities are not those of before_
  std::vector<char> in_;
  std::vector<double> x_, before_, start_;
  std::vector<double> poses_;         // of what moves, where the substep began
  std::vector<double> errors_;        // by row: of joints, m or rad
  std::vector<double> last_, shift_;  // of the last correction: as solved, as made
  std::vector<Shutting> shutting_;    // in the order of places
  std::vector<Act> acts_;             // by body, ExactBody::acts of each, in the order of places
  bool relaxed_ = false;
  std::vector<Group> groups_;
  std::vector<Reach> reaches_;                            // in the order of rows
  std::vector<std::vector<std::pair<int, int>>> joined_;  // by body: place, end
  std::vector<double> answer_, velocity_;
  std::vector<Flight> flights_;
  std::vector<int> flight_bodies_, flight_rows_;
  std::vector<RowState> next_;  // by place
  std::vector<RowState> held_;  // kept while something takes no part
  // Room for Shape.
  std::vector<int> ends_of_, first_, lead_;            // by row; by place; by body
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

/// Of the bodies that move, J.
double KineticOf(const std::vector<ExactBody>& bodies);

}  // namespace seam
