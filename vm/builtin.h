// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// The row type of the library: one row says everything about a function that is written in C++.
///
/// A kernel is written once, over a value type: `template <class R> struct Hypot { static R
/// eval(R x, R y); }`. `builtin<Hypot>(...)` makes the float and the double kernel of it.

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <type_traits>

#include "vm/lowered_op.h"

namespace mms::vm {

/// Runs over `lanes` lanes (a multiple of kLaneMultiple, padding included). `in[k]` and `out[k]`
/// are blocks of lanes, one for each real, integer or logic scalar of the flattened arguments and
/// results. Blocks of `out` alias nothing. Real cells have the kernel's value type; integer and
/// logic cells are std::int32_t in either machine.
using Kernel = void (*)(const void* const* in, void* const* out, int lanes);

class Image;                         // vm/images.h
enum class ImageAsk : std::uint8_t;  // the same

/// The same for rows that look pictures up: these are the ones of the program, by number.
using ImageKernel = void (*)(const Image* const* images, int count, const void* const* in,
                             void* const* out, int lanes);

/// Batches are padded to this many lanes, so kernels need no remainder loop.
inline constexpr int kLaneMultiple = 16;

struct Interval;  // vm/interval.h

/// How close a row's enclosure is to the range of its results.
enum class BoundsForm : std::uint8_t {
  None,       ///< there is none: results are taken for anything their type can hold
  Range,      ///< the range of the function, whatever the arguments (or nearly so)
  Lipschitz,  ///< the value at the centre, and a bound of the gradient
  Parts,      ///< put together from parts that are each exact: wider where arguments occur twice
  Exact,      ///< monotone pieces: the range over the box, but for rounding
};

/// Encloses the results of a row over a box of its arguments.
struct RowBounds {
  BoundsForm form = BoundsForm::None;
  /// One interval for each real, integer or logic scalar of the flattened arguments and results.
  /// Encloses the exact function, to the last digits of double; what the kernels miss it by is
  /// `max_ulp`. Arguments are never without a number; NaN among them need be minded only where the
  /// row makes a number of it. `out` comes as `low` to `high`. Null: that is all that is known.
  void (*run)(const Interval* in, Interval* out) = nullptr;
  /// No kernel ever returns a real outside, whatever the arguments.
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

struct Builtin {
  /// In the language's own syntax: `real perlin(real[3] p)`. Parsed by the language's own parser.
  std::string_view signature{};
  /// `noise`, `math`, ...: what `import "noise" as n` makes reachable as `n::perlin`.
  std::string_view module{};
  /// One sentence, and the edge cases. This is the manual.
  std::string_view doc{};
  /// One expression that uses it; the tests run it.
  std::string_view example{};
  /// Derivative rule: for each formal, separated by `;`, the partial derivative of the result as
  /// an expression in the language over the formals. An array formal wants an array, a result of
  /// several parts an array of such; a complex number for a complex formal and result is the
  /// complex derivative. A choice is differentiated arm by arm, a step has derivative 0. Or
  /// `= expression`: the derivative is that of the expression, which has the row's value. Empty
  /// for integer results and materials alone.
  std::string_view derivative{};
  /// Largest error of the float kernel against the exact result of its float arguments, in ulp of
  /// the result; 0 means exactly rounded or exact. Of a complex result, of its parts.
  double max_ulp = 0;
  /// For which arguments that holds; empty: for all.
  std::string_view domain{};
  /// Cost in units of one real addition over a batch.
  int cost = 10;
  /// What the results can be over a box of arguments.
  RowBounds bounds = {};
  Kernel f32 = nullptr, f64 = nullptr;
  /// Of a row that looks pictures up; `f32` and `f64` are then what it gives where there are none.
  ImageKernel image32 = nullptr, image64 = nullptr;
  ImageAsk image_ask = {};
  /// An instruction that does just what the kernels do, without the cost of a call.
  LoweredOp instruction = LoweredOp::CallBuiltin;
  /// For results of type `material`: which scattering model or combiner (materials/table.h). Such
  /// a row has no kernel: the linker compiles it away to a layout.
  int lobe = -1;
};

/// Whether a formal of a row whose result is `material`, as its signature names it, is a colour: at
/// most the largest of its colours does a model weigh light by.
constexpr bool is_colour(std::string_view formal) {
  for (std::string_view name : {"colour", "reflected", "transmitted"})
    if (formal.find(name) != formal.npos) return true;
  return false;
}

namespace detail {

template <class T>
struct Result {
  static constexpr int count = 1;
  [[gnu::always_inline]] static void store(const T& r, void* const* out, int i) {
    static_cast<T*>(out[0])[i] = r;
  }
};
template <class T, std::size_t N>
struct Result<std::array<T, N>> {
  static constexpr int count = N;
  [[gnu::always_inline]] static void store(const std::array<T, N>& r, void* const* out, int i) {
    const Plain plain = __builtin_bit_cast(Plain, r);
    for (std::size_t k = 0; k < N; ++k) static_cast<T*>(out[k])[i] = plain.values[k];
  }

 private:
  /// std::array's own operator[] would be an inline function compiled for one instruction set of
  /// which the linker may keep the copy for everybody.
  struct Plain {
    T values[N];
  };
};

/// A functor may have a second body: lanes for which `rare` holds take `eval_rare`, whatever their
/// neighbours are. It runs lane by lane, so `eval` stays free of what only few arguments need.
template <class F>
concept HasRare = requires {
  &F::rare;
  &F::eval_rare;
};

template <auto Eval>
struct Lift;
template <class Res, class... Args, Res (*Eval)(Args...)>
struct Lift<Eval> {
  template <std::size_t... K>
  [[gnu::always_inline]] static void loop(const void* const* in, void* const* out, int lanes,
                                          std::index_sequence<K...>) {
    const void* const args[] = {in[K]..., nullptr};
#pragma GCC ivdep
    for (int i = 0; i < lanes; ++i)
      Result<Res>::store(Eval(static_cast<const Args*>(args[K])[i]...), out, i);
  }
  static void run(const void* const* in, void* const* out, int lanes) {
    loop(in, out, lanes, std::index_sequence_for<Args...>{});
  }

  template <class F, std::size_t... K>
  [[gnu::always_inline]] static bool any_rare(const void* const* in, int lanes,
                                              std::index_sequence<K...>) {
    std::int32_t any = 0;
#pragma GCC ivdep
    for (int i = 0; i < lanes; ++i)
      any |= std::int32_t(F::rare(static_cast<const Args*>(in[K])[i]...));
    return any != 0;
  }
  template <class F, std::size_t... K>
  [[gnu::noinline]] static void mend(const void* const* in, void* const* out, int lanes,
                                     std::index_sequence<K...>) {
    for (int i = 0; i < lanes; ++i)
      if (F::rare(static_cast<const Args*>(in[K])[i]...))
        Result<Res>::store(F::eval_rare(static_cast<const Args*>(in[K])[i]...), out, i);
  }
  template <class F>
  static void run_with_rare(const void* const* in, void* const* out, int lanes) {
    constexpr auto all = std::index_sequence_for<Args...>{};
    loop(in, out, lanes, all);
    if (any_rare<F>(in, lanes, all)) mend<F>(in, out, lanes, all);
  }
};

}  // namespace detail

/// The kernel of `Eval`, a function over scalars (R or std::int32_t) that returns a scalar or a
/// std::array of them.
template <auto Eval>
inline constexpr Kernel kernel_of = &detail::Lift<Eval>::run;

/// The kernel of a functor, with its second body if it has one.
template <class F>
constexpr Kernel kernel_of_functor() {
  if constexpr (detail::HasRare<F>)
    return &detail::Lift<&F::eval>::template run_with_rare<F>;
  else
    return kernel_of<&F::eval>;
}

/// Both kernels of the functor template `F` in a row.
template <template <class> class F>
constexpr Builtin builtin(Builtin row) {
  row.f32 = kernel_of_functor<F<float>>();
  row.f64 = kernel_of_functor<F<double>>();
  return row;
}

}  // namespace mms::vm
