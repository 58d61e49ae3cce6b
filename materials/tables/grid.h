// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What the programs that make tables share: all cores, splines over grids, files of numbers.
/// Nothing here is used when rendering.

#include <atomic>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "materials/spline.h"

namespace mms::materials::tables {

/// Calls body(i) for 0 <= i < n on all cores.
inline void parallel(int n, const std::function<void(int)>& body) {
  std::atomic<int> next = 0;
  const auto work = [&] {
    for (int i; (i = next++) < n;) body(i);
  };
  std::vector<std::thread> threads;
  for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i) threads.emplace_back(work);
  work();
  for (std::thread& t : threads) t.join();
}

/// Gauss and Jordan's elimination: the columns behind the square matrix become the solutions.
inline void solve(std::vector<std::vector<double>>& a) {
  const int size = int(a.size()), columns = int(a[0].size());
  for (int p = 0; p < size; ++p) {
    int best = p;
    for (int i = p; i < size; ++i)
      if (std::abs(a[i][p]) > std::abs(a[best][p])) best = i;
    std::swap(a[p], a[best]);
    const double pivot = a[p][p];
    for (int j = p; j < columns; ++j) a[p][j] /= pivot;
    for (int i = 0; i < size; ++i) {
      const double factor = a[i][p];
      if (i == p || factor == 0) continue;
      for (int j = p; j < columns; ++j) a[i][j] -= factor * a[p][j];
    }
  }
}

/// The matrix, [coefficient][node], that makes of values at `n` >= 5 uniform nodes the coefficients
/// of the spline through them; the third derivative is continuous at the second and the last but
/// one ("not a knot").
inline std::vector<std::vector<double>> spline_matrix(int n) {
  const int size = coefficients(n);
  std::vector<std::vector<double>> a(size, std::vector<double>(size + n));
  for (int i = 0; i < n; ++i) {
    a[i][i] = a[i][i + 2] = 1.0 / 6;
    a[i][i + 1] = 4.0 / 6;
    a[i][size + i] = 1;
  }
  constexpr double fourth[] = {1, -4, 6, -4, 1};
  for (int j = 0; j < 5; ++j) a[n][j] = a[n + 1][size - 5 + j] = fourth[j];
  solve(a);
  for (auto& row : a) row.erase(row.begin(), row.begin() + size);
  return a;
}

/// Values over a grid of any dimension, the last axis innermost.
struct Grid {
  std::vector<int> nodes;
  std::vector<double> values;

  /// Of zeros, to be filled in.
  explicit Grid(std::vector<int> n) : nodes(std::move(n)) {
    int total = 1;
    for (int k : nodes) total *= k;
    values.resize(total);
  }
  /// `value(x)`: x[k] in [0, 1] along axis k.
  Grid(std::vector<int> n, const std::function<double(const double*)>& value) : Grid(std::move(n)) {
    parallel(int(values.size()), [&](int i) {
      double x[8];
      int rest = i;
      for (int k = int(nodes.size()) - 1; k >= 0; --k) {
        x[k] = double(rest % nodes[k]) / (nodes[k] - 1);
        rest /= nodes[k];
      }
      values[i] = value(x);
    });
  }

  /// Coefficients along every axis, but for the last `kept`, in the same order.
  std::vector<double> spline(int kept = 0) const {
    std::vector<double> data = values;
    int inner = 1;
    for (int k = int(nodes.size()) - 1; k >= 0; --k) {
      if (kept-- > 0) {
        inner *= nodes[k];
        continue;
      }
      const int n = nodes[k], m = coefficients(n), outer = int(data.size()) / (n * inner);
      const auto matrix = spline_matrix(n);
      std::vector<double> out(std::size_t(outer) * m * inner);
      parallel(outer * m, [&](int row) {
        double* to = &out[std::size_t(row) * inner];
        for (int j = 0; j < n; ++j) {
          const double* from = &data[std::size_t(row / m * n + j) * inner];
          for (int i = 0; i < inner; ++i) to[i] += matrix[row % m][j] * from[i];
        }
      });
      data = std::move(out);
      inner *= m;
    }
    return data;
  }
};

/// Where tables go: what declares them, and a file beside it that has their numbers and that the
/// assembler puts in place. A compiler takes minutes for as many as text.
struct TableFiles {
  std::FILE *declarations, *numbers;
  std::string numbers_name;
};

/// `const float name[]`.
inline void write_numbers(const TableFiles& to, const std::string& name,
                          const std::vector<float>& table) {
  std::fprintf(to.declarations,
               "asm(\".pushsection .rodata\\n.balign 4\\n\"\n"
               "    \"mms_%s: .incbin \\\"%s\\\", %ld, %zu\\n.popsection\");\n"
               "extern const float %s[%zu] asm(\"mms_%s\");\n",
               name.c_str(), to.numbers_name.c_str(), std::ftell(to.numbers),
               table.size() * sizeof(float), name.c_str(), table.size(), name.c_str());
  std::fwrite(table.data(), sizeof(float), table.size(), to.numbers);
}

/// Fills the file at `path` by `write`; whether nothing went wrong, which it says otherwise.
inline bool write_file(const std::string& path, const std::function<bool(std::FILE*)>& write) {
  std::FILE* to = std::fopen(path.c_str(), "wb");
  if (to) {
    const bool written = write(to), failed = std::ferror(to);
    if (std::fclose(to) == 0 && !failed) return written;
  }
  std::perror(path.c_str());
  return false;
}

/// The `main` of a program whose only argument names the file that `make` makes.
inline int with_path(int argc, char** argv, const std::function<bool(const std::string&)>& make) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s FILE\n", argv[0]);
    return 2;
  }
  return make(argv[1]) ? 0 : 1;
}

/// The same where that file is to declare tables; the numbers go to one of the extension .bin.
inline int make_tables(int argc, char** argv, const std::function<void(const TableFiles&)>& write) {
  return with_path(argc, argv, [&](const std::string& path) {
    const auto numbers = std::filesystem::path(path).replace_extension(".bin");
    return write_file(path, [&](std::FILE* declarations) {
      return write_file(numbers.string(), [&](std::FILE* to) {
        write({declarations, to, numbers.filename().string()});
        return true;
      });
    });
  });
}

}  // namespace mms::materials::tables
