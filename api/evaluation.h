// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// One call of mms.h that evaluates: the host's points cut into batches, an entry run over each.

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "api/handles.h"
#include "vm/interpreter.h"

namespace mms::api {

class Evaluation {
 public:
  Evaluation(MMsContext& context, const MMsPoints& points);

  /// Finds every input by its name; false, and why in the log, if there is none.
  bool bind();

  /// False, and why in the log, where a descriptor is of another program than the context.
  bool of_this_program(const LinkedProgram* owner);

  /// Says why in the log; false.
  bool complain(const Error& why);

  /// Calls `use(first, lanes)` for every batch, after function `function` has been run over it
  /// (none: everything is constant). True.
  template <class Use>
  bool run(const std::optional<std::uint32_t>& function, Use use) {
    for (std::size_t first = 0; first < points_.count; first += width()) {
      const int lanes = static_cast<int>(std::min(width(), points_.count - first));
      if (function) run_batch(*function, first, lanes);
      use(first, lanes);
    }
    report_faults();
    return true;
  }

  /// Component `c` of a value in lane `i` of the batch that was run last.
  float value(const vm::ValueSource& source, int c, int i) const;

  /// The numbers of a material for lane `i`, in the order that materials/layout.h states.
  void gather(const vm::MaterialLayout& material, int i, std::vector<float>& params) const;

  std::size_t count() const { return points_.count; }

 private:
  struct BoundInput {
    vm::Variable variable;
    const float* values;
  };

  std::size_t width() const { return static_cast<std::size_t>(context_.in.width()); }
  void run_batch(std::uint32_t function, std::size_t first, int lanes);
  void report_faults();

  MMsContext& context_;
  const MMsPoints& points_;
  std::vector<BoundInput> inputs_;
  std::size_t faults_ = 0;
  vm::SourceLine fault_line_;
};

}  // namespace mms::api
