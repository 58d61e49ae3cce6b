// SPDX-License-Identifier: Apache-2.0
// Makes materials/sheen_table.inc: `mms_sheen_table materials/sheen_table.inc`, on all cores. Run
// by hand, when the layer of fibres (materials/tables/fibres.h) changes; what it writes is kept in
// the tree, as it takes minutes and its numbers are drawn. A target of its own: not built with the
// rest.
#include <cstdio>

#include "base/hash.h"
#include "base/quadrature.h"
#include "materials/sheen.h"
#include "materials/tables/fibres.h"
#include "materials/tables/grid.h"

namespace mms::materials::tables {
namespace {

constexpr int kWalks = 400'000;         ///< from each direction
constexpr std::size_t kEnough = 5'000;  ///< directions for a fit

struct Random {
  std::uint64_t seed, count = 0;
  double next() { return to_unit(hash_combine(seed, ++count)); }
};

struct Node {
  double albedo = 0;
  Transform transform;
  bool fitted = false;
};

Node node_at(int i) {
  const int n = axes::kSheenDirection;
  const double r =
      axes::kLeastSheen + (1 - axes::kLeastSheen) * (i / n) / (axes::kSheenRoughness - 1);
  const double x = std::max(double(i % n) / (n - 1), 0.01), z = x * x;
  const Vec3d wo{std::sqrt((1 - z) * (1 + z)), 0, z};
  Random random{mix64(std::uint64_t(i))};
  std::vector<Vec3d> out;
  for (int k = 0; k < kWalks; ++k)
    if (const auto w = walk_in_fibres(r, wo, random)) out.push_back(*w);
  Node node{double(out.size()) / kWalks, {}, out.size() >= kEnough && wo.x > 0};
  if (node.fitted) node.transform = fit_directions(out, wo);
  return node;
}

std::vector<Node> all_nodes() {
  constexpr int n = axes::kSheenDirection;
  std::vector<Node> nodes(n * axes::kSheenRoughness);
  parallel(int(nodes.size()), [&](int i) { nodes[i] = node_at(i); });
  // Along the normal no azimuth tells b, and fine fibres send next to nothing back: as the node
  // further down has it.
  for (int i = 1; i < int(nodes.size()); ++i)
    if (!nodes[i].fitted) nodes[i].transform = nodes[i - 1].transform;
  return nodes;
}

/// `const float name[]` as text.
void write_text(std::FILE* to, const char* name, const std::vector<float>& table) {
  std::fprintf(to, "const float %s[] = {", name);
  for (std::size_t i = 0; i < table.size(); ++i)
    std::fprintf(to, "%s%.8e,", i % 8 ? "" : "\n", double(table[i]));
  std::fprintf(to, "\n};\n");
}

bool write_sheen(std::FILE* to) {
  using namespace axes;
  const std::vector<Node> nodes = all_nodes();
  std::vector<float> table;
  for (int which = 0; which < 3; ++which) {
    const Grid grid({kSheenRoughness, kSheenDirection}, [&](const double* x) {
      const int row = int(std::lround(x[0] * (kSheenRoughness - 1)));
      const Node& node = nodes[row * kSheenDirection + std::lround(x[1] * (kSheenDirection - 1))];
      return which == 0 ? node.albedo : which == 1 ? node.transform.a : node.transform.b;
    });
    for (const double c : grid.spline()) table.push_back(float(c));
  }
  std::fprintf(to,
               "// SPDX-License-Identifier: Apache-2.0\n"
               "// Made by materials/tables/sheen.cpp; change that, not this.\n");
  write_text(to, "kSheenTable", table);
  // A mean of splines over the same roughnesses: exactly that of what is read from them.
  constexpr int rows = coefficients(kSheenRoughness), columns = coefficients(kSheenDirection);
  std::vector<float> mean;
  for (int row = 0; row < rows; ++row)
    mean.push_back(float(integrate_adaptive(
        [&](double x) {  // x^2 is the cosine
          const auto d = Stencil<double>::at(x, kSheenDirection);
          return 4 * x * x * x * interpolate(table.data() + row * columns, d);
        },
        0, 1, 1e-9)));
  write_text(to, "kSheenMean", mean);
  return true;
}

}  // namespace
}  // namespace mms::materials::tables

int main(int argc, char** argv) {
  using namespace mms::materials::tables;
  return with_path(argc, argv,
                   [](const std::string& path) { return write_file(path, write_sheen); });
}
