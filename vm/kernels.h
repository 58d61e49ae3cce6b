// SPDX-License-Identifier: Apache-2.0
// No include guard: each instruction set includes this once, inside its own namespace, so that no
// function of one is ever linked into the other. It may therefore use no inline function of the
// standard library.

/// \file
/// One kernel for each operation, over a value type R (float or double).
///
/// Loops run over lanes, a multiple of kLaneMultiple; results may stand exactly where operands of
/// the same size stood. An operand is a block of lanes, or one number for all of them.

using std::int32_t;
using std::ptrdiff_t;
using std::uint32_t;

/// A loop over lanes that is vectorised without a remainder.
#define MMS_LANES(i, n) \
  _Pragma("GCC ivdep") _Pragma("GCC unroll 4") for (int i = 0; i < ((n) & -kLaneMultiple); ++i)

template <class T>
struct Block {
  const T* lanes;
  T operator[](int i) const { return lanes[i]; }
};
template <class T>
struct Same {
  T value;
  T operator[](int) const { return value; }
};

/// d[i] = F(a[i]...) for all lanes.
template <class F, class D, class... A>
inline void map(D* d, int n, A... a) {
  MMS_LANES(i, n) d[i] = F::eval(a[i]...);
}

template <class... T>
struct Types {};
template <class A, class B>
struct Joined;
template <class... A, class... B>
struct Joined<Types<A...>, Types<B...>> {
  using Type = Types<A..., B...>;
};
template <int k, class T>
struct Without;
template <class A, class... B>
struct Without<0, Types<A, B...>> {
  using Type = Types<B...>;
};
template <int k, class A, class... B>
struct Without<k, Types<A, B...>> {
  using Type = typename Joined<Types<A>, typename Without<k - 1, Types<B...>>::Type>::Type;
};

/// Two kernels as one: the second takes the first's result as its operand `position`.
template <class First, class Second, int position, class = typename First::Operands>
struct Chain;
template <class First, class Second, int position, class... A>
struct Chain<First, Second, position, Types<A...>> {
  template <class... B>
  static auto eval(A... a, B... b) {
    return put(First::F::eval(a...), b...);
  }

 private:
  template <class T>
  static auto put(T r) {
    return Second::F::eval(r);
  }
  template <class T, class B>
  static auto put(T r, B b) {
    if constexpr (position == 0)
      return Second::F::eval(r, b);
    else
      return Second::F::eval(b, r);
  }
  template <class T, class B, class C>
  static auto put(T r, B b, C c) {
    if constexpr (position == 0)
      return Second::F::eval(r, b, c);
    else if constexpr (position == 1)
      return Second::F::eval(b, r, c);
    else
      return Second::F::eval(b, c, r);
  }
};

inline float floor_of(float x) { return __builtin_floorf(x); }
inline double floor_of(double x) { return __builtin_floor(x); }
inline float fma_of(float a, float b, float c) { return __builtin_fmaf(a, b, c); }
inline double fma_of(double a, double b, double c) { return __builtin_fma(a, b, c); }

struct Add {
  template <class R>
  static R eval(R a, R b) {
    return a + b;
  }
};
struct Sub {
  template <class R>
  static R eval(R a, R b) {
    return a - b;
  }
};
struct Mul {
  template <class R>
  static R eval(R a, R b) {
    return a * b;
  }
};
struct Div {
  template <class R>
  static R eval(R a, R b) {
    return a / b;
  }
};
/// The quotient is rounded before it is floored; the remainder of that quotient is rounded once.
struct Mod {
  template <class R>
  static R eval(R a, R b) {
    return fma_of(-b, floor_of(a / b), a);
  }
};
/// Mod by `b`, whose reciprocal `r` is exact: the same bits without dividing.
struct ModBy {
  template <class R>
  static R eval(R a, R b, R r) {
    return fma_of(-b, floor_of(a * r), a);
  }
};
struct Neg {
  template <class R>
  static R eval(R a) {
    return -a;
  }
};
struct Floor {
  template <class R>
  static R eval(R a) {
    return floor_of(a);
  }
};
struct Abs {
  static float eval(float a) { return __builtin_fabsf(a); }
  static double eval(double a) { return __builtin_fabs(a); }
};
struct Sqrt {
  static float eval(float a) { return __builtin_sqrtf(a); }
  static double eval(double a) { return __builtin_sqrt(a); }
};
struct Fma {
  template <class R>
  static R eval(R a, R b, R c) {
    return fma_of(a, b, c);
  }
};

struct Fms {
  template <class R>
  static R eval(R a, R b, R c) {
    return fma_of(a, b, -c);
  }
};
struct Fnma {
  template <class R>
  static R eval(R a, R b, R c) {
    return fma_of(-a, b, c);
  }
};

struct AddWrap {
  static int32_t eval(int32_t a, int32_t b) { return int32_t(uint32_t(a) + uint32_t(b)); }
};
struct SubWrap {
  static int32_t eval(int32_t a, int32_t b) { return int32_t(uint32_t(a) - uint32_t(b)); }
};
struct MulWrap {
  static int32_t eval(int32_t a, int32_t b) { return int32_t(uint32_t(a) * uint32_t(b)); }
};
struct MulAddWrap {
  static int32_t eval(int32_t a, int32_t b, int32_t c) {
    return int32_t(uint32_t(a) * uint32_t(b) + uint32_t(c));
  }
};
struct NegWrap {
  static int32_t eval(int32_t a) { return int32_t(0u - uint32_t(a)); }
};
struct ModFloored {
  static int32_t eval(int32_t a, int32_t b) {
    const int32_t divisor = b == 0 || b == -1 ? 1 : b;  // 0 and INT_MIN % -1 trap otherwise
    const int32_t r = a % divisor;
    return r != 0 && (r ^ divisor) < 0 ? r + divisor : r;
  }
};

struct Truncate {
  /// The largest value below 2^31 and the clamp below it.
  static constexpr float kTopF = 2147483520.0f;
  static constexpr double kTopD = 2147483647.0;
  static int32_t eval(float x) { return clamped(x, kTopF); }
  static int32_t eval(double x) { return clamped(x, kTopD); }
  template <class R>
  static int32_t clamped(R x, R top) {
    const R low = x > R(-2147483648.0) ? x : R(-2147483648.0);  // and NaN
    const int32_t i = int32_t(low < top ? low : top);
    return x != x ? 0 : x >= R(2147483648.0) ? 2147483647 : i;
  }
};
template <class R>
struct ToReal {
  static R eval(int32_t a) { return R(a); }
};

struct Lt {
  template <class A>
  static int32_t eval(A a, A b) {
    return a < b;
  }
};
struct Le {
  template <class A>
  static int32_t eval(A a, A b) {
    return a <= b;
  }
};
struct Eq {
  template <class A>
  static int32_t eval(A a, A b) {
    return a == b;
  }
};
struct Ne {
  template <class A>
  static int32_t eval(A a, A b) {
    return a != b;
  }
};
struct And {
  static int32_t eval(int32_t a, int32_t b) { return a & b; }
};
struct Or {
  static int32_t eval(int32_t a, int32_t b) { return a | b; }
};
struct Not {
  static int32_t eval(int32_t a) { return a ^ 1; }
};
struct Select {
  template <class B>
  static B eval(int32_t a, B b, B c) {
    return a ? b : c;
  }
};

/// then = outer & cond, other = outer & not cond; whether any lane is in `then`.
inline bool split(int32_t* then, int32_t* other, const int32_t* outer, const int32_t* cond, int n) {
  int32_t any = 0;
  MMS_LANES(i, n) {
    const int32_t t = outer[i] & cond[i];
    other[i] = outer[i] ^ t;
    then[i] = t;
    any |= t;
  }
  return any != 0;
}

inline bool any_of(const int32_t* mask, int n) {
  int32_t any = 0;
  MMS_LANES(i, n) any |= mask[i];
  return any != 0;
}
/// to = from, from = 0; how many lanes that are.
inline int move_mask(int32_t* to, int32_t* from, int n) {
  int32_t sum = 0;
  MMS_LANES(i, n) {
    sum += to[i] = from[i];
    from[i] = 0;
  }
  return sum;
}

/// Counts the lanes of `mask` up; whether any lane is now above `limit`.
inline bool count(int32_t* counter, const int32_t* mask, int32_t limit, int n) {
  int32_t over = 0;
  MMS_LANES(i, n) {
    counter[i] += mask[i];
    over |= counter[i] > limit;
  }
  return over != 0;
}

/// to[k] = from[lanes[k]] and the other way round, for `n` lanes.
template <class T>
inline void gather(T* to, const T* from, const int32_t* lanes, int n) {
  for (int k = 0; k < n; ++k) to[k] = from[lanes[k]];
}
template <class T>
inline void scatter(T* to, const T* from, const int32_t* lanes, int n) {
  for (int k = 0; k < n; ++k) to[lanes[k]] = from[k];
}

#undef MMS_LANES
