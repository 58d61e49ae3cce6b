// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// A value that most owners do not have.

#include <memory>

namespace mms {

/// A `T` that takes a pointer's room until it is asked for; until then it reads as `T{}`.
template <class T>
class Seldom {
 public:
  Seldom() = default;
  Seldom(const Seldom& other) : value_(other.value_ ? std::make_unique<T>(*other) : nullptr) {}
  Seldom(Seldom&&) noexcept = default;
  Seldom& operator=(Seldom other) noexcept {
    value_ = std::move(other.value_);
    return *this;
  }

  /// To be written to.
  T& make() {
    if (!value_) value_ = std::make_unique<T>();
    return *value_;
  }
  const T& operator*() const {
    static const T none{};
    return value_ ? *value_ : none;
  }
  const T* operator->() const { return &**this; }

 private:
  std::unique_ptr<T> value_;
};

}  // namespace mms
