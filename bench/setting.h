// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Scripts in scenes, for benchmarks of whole renders.

#include <ctime>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/measure.h"
#include "renderer/render.h"
#include "vm/program.h"

namespace mms::bench {

[[noreturn]] void give_up(const std::string& why);

/// Text of a file of examples/.
std::string example(const char* name);

/// A script in a scene, ready to be rendered.
class Setting {
 public:
  /// `scene`: a built-in one, or the text of one. `surface`: of the object under test.
  Setting(const std::string& script, const std::string& scene, const std::string& surface = "");

  renderer::Rendered render(
      int side, int samples, int threads, std::uint64_t seed = 0,
      renderer::Generator generator = renderer::Generator::Niederreiter) const;
  /// Of `side` x `side` pixels, each by what falls on it.
  renderer::Rendered render(int side, renderer::RenderOptions options) const;

 private:
  vm::Program program_;
  std::optional<renderer::Scene> scene_;
};

struct Material {
  const char* name;
  std::string script;
};

/// What times of renders are told of, the first three by peers too.
std::vector<Material> materials();

/// Seconds of processor that `run` takes, whatever else the machine does; and what it returns.
template <class F>
auto charged(F run) {
  const std::clock_t begin = std::clock();
  auto result = run();
  return std::pair(double(std::clock() - begin) / CLOCKS_PER_SEC, std::move(result));
}

/// "median [quartiles]", each as `format` says.
std::string quartiles(const Series& series, const char* format);

}  // namespace mms::bench
