// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The shaders of the suite: linked, with their points, their twins, and the check of their values.

#include <memory>
#include <string>
#include <vector>

#include "bench/twins.h"
#include "lang/link.h"
#include "vm/interpreter.h"

namespace mms::bench {

/// What a row of the suite states. The oracle is the twin in double at the same float inputs; both
/// outputs are of the order of 1, so bounds are absolute.
struct Row {
  const char* name;  ///< of bench/shaders/<name>.mms and of the twins
  const char* title;
  /// The largest difference, and how many points in a thousand may exceed it because the shader
  /// has a step there (an escape, an edge).
  double bound;
  int stepped;
  /// Open Shading Language on a similar shader, ns per point; 0: not measured.
  double peer_scalar, peer_batched;
};
const std::vector<Row>& rows();

/// The points of one run, in each form that something takes.
class Points {
 public:
  explicit Points(int count);
  int count() const { return int(singles.size()); }
  Lanes lanes() const;
  /// The points in batches of `width`, the last padded with its own first points.
  std::vector<vm::InputBatch<float>> batches(int width) const;

  std::vector<Point<float>> singles;
  std::vector<Point<double>> exact;

 private:
  std::vector<float> columns_;
};

/// A script, ready to run.
struct Shader {
  const Row* row;
  vm::Program program;
  std::unique_ptr<vm::Executable> executable;
  std::uint32_t function;
  std::vector<int> results;  ///< which results of the function are compared
  int numbers;               ///< and how many numbers they are
  Twin<float> gcc, clang;    ///< null where there is none
  Twin<double> oracle;
  VectorTwin vector;
};

/// The text of `bench/shaders/<name>.mms`.
std::string text_of(const std::string& name);
/// Text to code that can run. Ends the program with a message if it does not link.
vm::Program link_text(const std::string& text);
Shader load(const Row& row);

/// One pass over all points, in calls of `per_call`; a call of more than the executable's width is
/// split into batches.
void run_all(const Shader& shader, vm::Interpreter<float>& machine,
             const std::vector<vm::InputBatch<float>>& batches, int per_batch);

/// How far a contender's numbers are from the oracle's.
struct Error {
  double largest = 0;  ///< over the points that are within the bound
  int beyond = 0;      ///< points beyond it
};
struct Check {
  Error ours, scalar, vector;
  bool good;  ///< ours and the twins keep to the row's bound
};
Check check(const Shader& shader, const Points& points);

}  // namespace mms::bench
