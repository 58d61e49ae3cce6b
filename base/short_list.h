// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

namespace mms {

/// A list of plain values that is short nearly always: up to `kInside` of them lie in the object
/// itself, more on the heap. Otherwise as std::vector, of which it has what is asked for here.
template <class T, std::uint32_t kInside>
class ShortList {
  static_assert(std::is_trivially_copyable_v<T> && kInside > 0);

 public:
  ShortList() = default;
  ShortList(std::initializer_list<T> values) { append(values.begin(), values.size()); }
  ShortList(std::span<const T> values) { append(values.data(), values.size()); }
  ShortList(const std::vector<T>& values) { append(values.data(), values.size()); }
  ShortList(const ShortList& other) { append(other.data(), other.size()); }
  ShortList(ShortList&& other) noexcept
      : heap_(std::move(other.heap_)), size_(other.size_), capacity_(other.capacity_) {
    if (!heap_) std::copy_n(other.inside_, size_, inside_);
    other.size_ = 0;
    other.capacity_ = kInside;
  }
  ShortList& operator=(ShortList other) noexcept {
    std::destroy_at(this);
    return *std::construct_at(this, std::move(other));
  }

  T* data() { return heap_ ? heap_.get() : inside_; }
  const T* data() const { return heap_ ? heap_.get() : inside_; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T* begin() { return data(); }
  T* end() { return data() + size_; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size_; }
  T& operator[](std::size_t i) { return data()[i]; }
  const T& operator[](std::size_t i) const { return data()[i]; }
  T& front() { return data()[0]; }

  void push_back(T value) {  // by value: it may be one of the list's own
    if (size_ == capacity_) {
      auto larger = std::make_unique_for_overwrite<T[]>(2 * std::size_t{capacity_});
      std::copy_n(data(), size_, larger.get());
      heap_ = std::move(larger);
      capacity_ *= 2;
    }
    data()[size_++] = value;
  }

  void pop_back() { --size_; }

  operator std::vector<T>() const { return {begin(), end()}; }
  friend bool operator==(const ShortList& a, const ShortList& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  }

 private:
  void append(const T* values, std::size_t count) {
    if (count > kInside) {
      heap_ = std::make_unique_for_overwrite<T[]>(count);
      capacity_ = std::uint32_t(count);
    }
    std::copy_n(values, count, data());
    size_ = std::uint32_t(count);
  }

  std::unique_ptr<T[]> heap_;
  std::uint32_t size_ = 0, capacity_ = kInside;
  T inside_[kInside] = {};
};

}  // namespace mms
