// SPDX-License-Identifier: Apache-2.0
// Time to an error beside Blender's Cycles, on scenes of both: writes its part of
// docs/performance.md. Blender is started once a material and rendered with in turn with ours.
#include <sys/wait.h>
#include <unistd.h>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bench/document.h"
#include "bench/measure.h"
#include "bench/setting.h"
#include "renderer/scene.h"

namespace mms::bench {
namespace {

/// Scenes of both, as text: a built-in one, and two whose light is found more easily.
struct Stage {
  const char* name;
  std::string text;
};
std::vector<Stage> stages() {
  return {{"sphere", std::string(*renderer::builtin_scene_text("sphere"))},
          {"plain", R"({
  // A ball on the ground, one lamp above it, and a sky that is the same all over.
  "environment": {"constant": 0.5},
  "materials": {"ground": {"matte": 0.5}, "lamp": {"matte": 0, "emission": 8}},
  "camera": {"position": [0, 1.5, 6], "target": [0, 0, 0], "fov": 30},
  "objects": [
    {"name": "ball", "sphere": {"radius": 1}, "test": true},
    {"quad": {"corner": [-10, -1, 10], "u": [20, 0, 0], "v": [0, 0, -20]}, "surface": "ground"},
    {"name": "lamp", "quad": {"corner": [-1, 4, -1], "u": [2, 0, 0], "v": [0, 0, 2]}, "surface": "lamp"}
  ]
})"},
          {"sky", R"({
  // The same ball on the same ground, with no light but the sky.
  "environment": {"constant": 0.5},
  "materials": {"ground": {"matte": 0.5}},
  "camera": {"position": [0, 1.5, 6], "target": [0, 0, 0], "fov": 30},
  "objects": [
    {"name": "ball", "sphere": {"radius": 1}, "test": true},
    {"quad": {"corner": [-10, -1, 10], "u": [20, 0, 0], "v": [0, 0, -20]}, "surface": "ground"}
  ]
})"}};
}

constexpr int kSide = 256, kDepth = 8, kRounds = 5, kMostSamples = 4096;
constexpr double kError = 0.01;

/// What a renderer made: luminance row by row, top first, and the processor's seconds.
struct Picture {
  std::vector<double> luminance;
  double seconds = 0;
};
using Renderer = std::function<Picture(int samples, int seed)>;

/// A Blender that renders with Cycles when it is told to (bench/cycles.py).
class Cycles {
 public:
  Cycles(const std::string& scene, const std::string& material) {
    namespace fs = std::filesystem;
    folder_ = (fs::temp_directory_path() / "mms-peers-XXXXXX").string();
    if (!mkdtemp(folder_.data())) give_up("no temporary folder");
    std::ofstream(folder_ + "/scene.json") << scene;
    int to[2], from[2];
    if (pipe(to) != 0 || pipe(from) != 0) give_up("no pipe");
    child_ = fork();
    if (child_ == 0) {
      dup2(to[0], 0);
      dup2(from[1], 1);
      for (int end : {to[0], to[1], from[0], from[1]}) close(end);
      execlp("blender", "blender", "-b", "-P", MMS_SOURCE_DIR "/bench/cycles.py", "--",
             (folder_ + "/scene.json").c_str(), material.c_str(), nullptr);
      _exit(127);
    }
    close(to[0]);
    close(from[1]);
    told_ = fdopen(to[1], "w");
    said_ = fdopen(from[0], "r");
    wait_for("ready");
  }
  ~Cycles() {
    std::fclose(told_);
    std::fclose(said_);
    waitpid(child_, nullptr, 0);
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  Cycles(const Cycles&) = delete;
  Cycles& operator=(const Cycles&) = delete;

  Picture render(int samples, int seed) {
    const std::string path = folder_ + "/picture";
    fmt::print(told_, "{} {} 1 {}\n", samples, seed, path);
    std::fflush(told_);
    Picture p;
    p.seconds = std::stod(wait_for("took "));
    std::vector<std::array<float, 3>> rgb(kSide * kSide);
    std::ifstream in(path, std::ios::binary);
    in.read(reinterpret_cast<char*>(rgb.data()), std::streamsize(rgb.size() * sizeof rgb[0]));
    if (!in) give_up("blender wrote no picture");
    for (int y = kSide; y-- > 0;)
      for (int x = 0; x < kSide; ++x) {
        const auto& [r, g, b] = rgb[std::size_t(y * kSide + x)];
        p.luminance.push_back(0.2126 * r + 0.7152 * g + 0.0722 * b);
      }
    return p;
  }

 private:
  /// The rest of the next line that begins so.
  std::string wait_for(const std::string& begin) {
    char line[4096];
    while (std::fgets(line, sizeof line, said_))
      if (std::string(line).starts_with(begin)) return std::string(line).substr(begin.size());
    give_up("blender ended: is it installed? (apt-get install blender)");
  }

  std::string folder_;
  pid_t child_ = -1;
  std::FILE *told_ = nullptr, *said_ = nullptr;
};

Renderer ours(const Setting& setting) {
  return [&setting](int samples, int seed) {
    renderer::RenderOptions o;
    o.max_depth = kDepth;
    o.samples = samples;
    o.seed = std::uint64_t(seed);
    o.threads = 1;
    auto [seconds, r] = charged([&] { return setting.render(kSide, o); });
    Picture p{{}, seconds};
    for (const auto& xyz : r.film.xyz) p.luminance.push_back(xyz[1]);
    return p;
  };
}

double mean_square(const Picture& a, const Picture& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.luminance.size(); ++i)
    sum += std::pow(a.luminance[i] - b.luminance[i], 2);
  return sum / double(a.luminance.size());
}

/// Variance of pictures of so many samples: half of what two of other seeds differ by.
double variance(const Renderer& r, int samples) {
  constexpr int kPairs = 2;
  double sum = 0;
  for (int i = 0; i < kPairs; ++i)
    sum += mean_square(r(samples, 2 * i + 1), r(samples, 2 * i + 2)) / (2 * kPairs);
  return sum;
}

/// Samples a pixel to the error: doubled until it is met, then between by a power law.
double samples_to_error(const Renderer& r) {
  double before = 0;
  for (int n = 2; n <= kMostSamples; n *= 2) {
    const double now = variance(r, n);
    if (now <= kError * kError) {
      if (before == 0) return n;
      const double slope = std::log2(before / now);
      return n / 2 * std::exp2(std::log2(before / (kError * kError)) / slope);
    }
    before = now;
  }
  give_up(fmt::format("an error of {} takes more than {} samples", kError, kMostSamples));
}

double mean(const Picture& p) {
  double sum = 0;
  for (double y : p.luminance) sum += y;
  return sum / double(p.luminance.size());
}

std::string row(const Stage& stage, const Material& material, const char* spectral_peer) {
  const Setting setting(material.script, stage.text);
  Cycles blender(stage.text, material.name);
  const Renderer mms = ours(setting),
                 cycles = [&](int n, int seed) { return blender.render(n, seed); };
  const double mms_samples = samples_to_error(mms), cycles_samples = samples_to_error(cycles);
  const int mms_whole = int(std::ceil(mms_samples)), cycles_whole = int(std::ceil(cycles_samples));
  Series mms_seconds, cycles_seconds;
  double mms_mean = 0, cycles_mean = 0;
  for (int r = 0; r < kRounds; ++r) {
    const Picture a = mms(mms_whole, r), b = cycles(cycles_whole + 1, r), first = cycles(1, r);
    mms_seconds.push_back(a.seconds * mms_samples / mms_whole);
    cycles_seconds.push_back((b.seconds - first.seconds) * cycles_samples / cycles_whole);
    mms_mean += mean(a);
    cycles_mean += mean(b);
  }
  const auto per_sample = [&](const Series& s, double samples) {
    return 1e6 * median(s) / (samples * kSide * kSide);
  };
  return fmt::format(
      "| {}, {} | {:.2f} us, {:.1f}, {:.2f} s | {:.2f} us, {:.1f}, {:.2f} s | {} | "
      "{:.3f} | {} |\n",
      stage.name, material.name, per_sample(mms_seconds, mms_samples), mms_samples,
      median(mms_seconds), per_sample(cycles_seconds, cycles_samples), cycles_samples,
      median(cycles_seconds), quartiles(ratios(cycles_seconds, mms_seconds), "{:.2f}"),
      mms_mean / cycles_mean, spectral_peer);
}

std::string peers() {
  constexpr const char* kSpectralPeer[] = {"18 s", "60 s", "193 s"};
  std::string text = fmt::format(R"(## The peers

Ours beside Cycles of Blender, Debian's package, on scenes of both: `sphere`; `plain`, a ball on the ground
under one lamp and an even sky; and `sky`, the same without the lamp (`bench/peers.cpp`). One thread, at most
{} scattering events, {}x{} pixels, box filter. Microseconds a sample, samples a pixel and the processor's seconds
to a root mean square error of luminance of {} (1 is white), by what pictures of other seeds differ; times are
medians of {} rounds in turn, the ratio with quartiles. Of ours all of a render counts, of Cycles what each sample
after the first adds: neither building its scene nor what it writes. Cycles draws red, green and blue, its metal
has one reflectance for all angles, its ball is of 32,768 triangles (`bench/cycles.py`). Brightness: mean luminance
of ours over that of Cycles. The last column was measured earlier on an older processor, in a renderer for
research, on spheres of similar materials in similar light, not on these very scenes. Reproduce: `./run bench`
(`bench_peers`, which starts `blender`).

| scene, material | ours | Cycles | Cycles / ours | brightness | leading spectral research renderer |
|---|---|---|---|---|---|
)",
                                 kDepth, kSide, kSide, kError, kRounds);
  const std::vector<Material> all = materials();
  for (const Stage& stage : stages())
    for (std::size_t i = 0; i < std::size(kSpectralPeer); ++i) {
      text += row(stage, all[i], kSpectralPeer[i]);
      fmt::print(stderr, "{}, {}: done\n", stage.name, all[i].name);
    }
  return text;
}

}  // namespace
}  // namespace mms::bench

int main(int argc, char** argv) {
  return mms::bench::part_main(argc, argv, "transport-peers", mms::bench::peers);
}
