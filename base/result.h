// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// A value or an error that a user can act on. For mistakes of the user; ours are assertions.

#include <string>
#include <utility>
#include <variant>

namespace mms {

/// What went wrong, where, and one thing to try. Lower case, no full stop.
struct Error {
  /// In what was read; a name that nothing has; a file that is not there or cannot be read; a
  /// script that does not end.
  enum class Cause { Content, Name, File, Budget };

  std::string where;  ///< file, file:line:column, or option; may be empty
  std::string what;
  std::string hint;  ///< may be empty
  Cause cause = Cause::Content;
};

/// Holds a `T` or an `Error`; test it before use.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : v_(std::move(value)) {}
  Result(Error error) : v_(std::move(error)) {}

  explicit operator bool() const { return v_.index() == 0; }
  T& operator*() { return std::get<0>(v_); }
  const T& operator*() const { return std::get<0>(v_); }
  T* operator->() { return &std::get<0>(v_); }
  const T* operator->() const { return &std::get<0>(v_); }
  const Error& error() const { return std::get<1>(v_); }

 private:
  std::variant<T, Error> v_;
};

}  // namespace mms
