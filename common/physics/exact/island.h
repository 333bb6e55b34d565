#pragma once
/// An island that contains a joint, as one system: joints, limits, motors, contacts and friction
/// are its rows. Two solves a substep, at the old and at the new pose (docs/solver.md).

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

  /// The rows and the matrix's shape from bodies, joints and contacts (of which a, b and count
  /// are there).
  void Shape();
  /// Multiplications of a factorisation.
  long cost() const { return matrix_.cost(); }
  int bounded_rows() const { return bounded_; }

  /// Advances the bodies by pace.h * pace.substeps. `warm`: begin with what contacts and joints
  /// had last.
  void Step(const Pace& pace, bool warm);
  /// After something else has moved some of the bodies: brings the joints together again, positions
  /// and velocities. `pace` as in Step; no time passes.
  void Rejoin(const Pace& pace);
  /// What the step did, to the engine's joints and contacts.
  void Store() const;

 private:
  struct Pair {  // of rows that share a body
    int place;   // in the matrix
    int row, other;
    int end, other_end;
  };
  Row& At(int row) { return rows_[static_cast<std::size_t>(row)]; }
  ExactBody& Body(int body) { return bodies[static_cast<std::size_t>(body)]; }
  void ShapeMatrix();
  void Fill(const Pace& pace);

  void BringTogether(const Pace& pace);
  // Of a substep, in their order.
  void Substep(const Pace& pace);
  void Kick(double h);
  bool FindImpacts();
  void Impact();
  void SolveAhead(const Pace& pace);
  void Move(double h);
  void ShutJoints(const Pace& pace);
  void YieldContacts();
  void SoftenContacts();
  void SolveAtEnd(const Pace& pace);

  // The tension of joints as inertia.
  void Tension(double h);
  bool Stiffer();

  // The system of rows, for the velocities as they are.
  void Assemble();
  void Factor();
  void Solve();
  bool PivotToTheEnd();
  bool Pivot(int* wrong);
  void Change(int place);
  void SetFrictionBounds();
  bool NextFrictionBounds();
  void Descend();
  void HoldJoints();
  double Speed(const Row& row) const;
  void Push(const Row& row, double impulse);
  void Shift(const Row& row, double by);
  void Save(std::vector<double>* velocities) const;
  void Restore(const std::vector<double>& velocities);

  std::vector<Row> rows_;
  std::vector<RowEnd> ends_;
  std::vector<int> contact_row_;  // by contact: the first of its rows
  std::vector<int> place_;        // by row: its index in the matrix
  std::vector<int> row_at_;       // the other way round
  std::vector<Pair> pairs_;
  Skyline matrix_;
  int bounded_ = 0;
  int dirty_ = 0;  // the factors of rows from here on are old
  std::vector<char> in_;
  std::vector<double> x_, before_, start_;
  std::vector<RowState> next_;    // by place
  std::vector<RowState> states_, held_;  // kept while something takes no part
};

}  // namespace seam
