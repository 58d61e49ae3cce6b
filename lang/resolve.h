// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Looks up every name of a function's text, without types: what a function that nobody calls, or
/// an arm that is out, may not hide.

#include <functional>
#include <string>
#include <vector>

#include "lang/ast.h"
#include "lang/diagnostics.h"

namespace mms::lang {

class NameCheck {
 public:
  using Unknown = std::function<void(const Path&, Diag, const std::vector<std::string>& inside)>;

  /// `outside`: whether a path means something where the function is defined. `unknown` is told of
  /// each that means nothing there and inside, and of the names there are inside.
  NameCheck(const Graph& graph, std::function<bool(const Path&)> outside, Unknown unknown)
      : graph_(graph), outside_(std::move(outside)), unknown_(std::move(unknown)) {}

  void function(const Function& f);

 private:
  void body(const Body& b);
  void formals(const std::vector<Formal>& formals);
  void expr(ExprHandle h);
  void type(TypeHandle h);
  void introduce(TypeHandle h);
  void name(const Path& path, Diag id);
  void declare(const std::string& n) { inside_.push_back(n); }

  const Graph& graph_;
  std::function<bool(const Path&)> outside_;
  Unknown unknown_;
  std::vector<std::string> inside_;  ///< names defined so far, innermost last
};

}  // namespace mms::lang
