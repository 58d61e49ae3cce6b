// SPDX-License-Identifier: Apache-2.0
// Pictures whose tiles have different numbers of samples.
#include "renderer/adaptive.h"

#include <doctest/doctest.h>

#include <cmath>
#include <set>

#include "base/hash.h"
#include "film_samples.h"
#include "hand_program.h"
#include "renderer/samples.h"
#include "renderer/scene.h"
#include "tests/sanitized.h"

using namespace mms;
using namespace mms::renderer;
using namespace mms::renderer::test;

namespace {

/// A ball of smooth glass: caustics and highlights in a few tiles, a matte ground in all others.
struct GlassBall {
  HandProgram h;
  Result<Scene> scene;
  RenderOptions options;

  GlassBall()
      : scene((h.surface("glass", HandProgram::lobe(Lobe::Dielectric,
                                                    {h.spectrum(1.5), h.real(0), h.spectrum(1),
                                                     h.spectrum(1), h.real(0)})),
               load_scene(h.program, {"sphere", "glass", ""}))) {
    REQUIRE(bool(scene));
    options.width = 72;
    options.height = 56;
    options.samples = 1 << 16;
    options.filter = FilterShape::Box;
  }
  Rendered render(const RenderOptions& o) const {
    auto r = renderer::render(h.program, *scene, o);
    REQUIRE(bool(r));
    return std::move(*r);
  }
};

}  // namespace

TEST_CASE("samples go where they do most: in proportion to the deviation of one") {
  // Two halves, so wide that few patches see both: noise of the deviations 1 and 3, and an n for
  // each patch of n = s mean(s) / E^2, by Lagrange's rule.
  const int width = 320, height = 64, samples = 16;
  const double deviation[] = {1, 3}, target = 0.1;
  PartialFilm film(width, height, FilterShape::Box);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int s = 0; s < samples; ++s) {
        const double u = to_unit(hash_combine(std::uint64_t(y * width + x), std::uint64_t(s)));
        const double v = std::sqrt(12.0) * (u - 0.5) * deviation[x >= width / 2];
        add_sample(film, {x + 0.5, y + 0.5, std::uint32_t(s), {v, v, v}});
      }
  const ErrorEstimate estimate(film);
  REQUIRE(estimate.rmse() > target);
  const std::vector<double> worth = samples_worth_having(estimate, target);
  const int across = estimate.patches_across();
  double mean[2] = {0, 0}, count[2] = {0, 0};
  for (int i = 0; i < int(worth.size()); ++i) {
    const int x = i % across;
    if (x == across / 2 - 1 || x == across / 2) continue;
    mean[x >= across / 2] += worth[i];
    ++count[x >= across / 2];
  }
  // The deviation of a patch is known to 7 % or so by 256 differences and a factor, of 36 patches.
  for (const int half : {0, 1})
    CHECK(mean[half] / count[half] ==
          doctest::Approx(deviation[half] * 2 / (target * target)).epsilon(0.06));
}

TEST_CASE("what has more samples than it is worth leaves the rest to others") {
  // Of two equal halves one has 64 samples and the other 4: n more for the other so that
  // (1 / 64 + 1 / n) / 2 = E^2.
  const int side = 64;
  PartialFilm film(2 * side, side, FilterShape::Box);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < 2 * side; ++x) {
      const int samples = x < side ? 64 : 4;
      for (int s = 0; s < samples; ++s) {
        const double u = to_unit(hash_combine(std::uint64_t(y * 2 * side + x), std::uint64_t(s)));
        const double v = std::sqrt(12.0) * (u - 0.5);
        add_sample(film, {x + 0.5, y + 0.5, std::uint32_t(s), {v, v, v}});
      }
    }
  const ErrorEstimate estimate(film);
  CHECK(estimate.rmse() == doctest::Approx(std::sqrt((1 / 64.0 + 1 / 4.0) / 2)).epsilon(0.1));
  const double target = std::sqrt((1 / 64.0 + 1 / 12.0) / 2);
  const std::vector<double> worth = samples_worth_having(estimate, target);
  double mean = 0;
  for (int i = 0; i < int(worth.size()); ++i)
    if (i % estimate.patches_across() >= estimate.patches_across() / 2) mean += worth[i];
  CHECK(mean / (double(worth.size()) / 2) == doctest::Approx(12).epsilon(0.1));
}

TEST_CASE("where tiles with few and many samples meet, filters keep their shape") {
  for (const FilterInfo& info : filters()) {
    CAPTURE(info.name);
    // The ramp f = x, so that every symmetric filter gives the middle of each pixel: from 64
    // samples of each pixel of one tile, and 1024 of the other.
    const int width = 2 * kTile, height = kTile;
    PartialFilm film(width, height, info.shape);
    for (int t = 0; t < 2; ++t) {
      const int n = t == 0 ? 8 : 32;
      const Rect tile = film.tile(t);
      for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x)
          for (int s = 0; s < n * n; ++s) {
            const double at = x + (s % n + 0.5) / n;
            add_sample(film, {at, y + (s / n + 0.5) / n, std::uint32_t(s), {at, at, at}});
          }
    }
    const Film weighed = film.develop();
    double worst = 0, plain = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 2; x < width - 2; ++x) {
        const std::size_t i = std::size_t(y * width + x);
        worst = std::max(worst, std::abs(weighed.xyz[i][1] - (x + 0.5)));
        plain = std::max(plain, std::abs(FilmSums::mean(film.pixel(x, y), 1) - (x + 0.5)));
      }
    CHECK(worst < 2e-3);  // of the rule of midpoints
    if (info.radius > 0.5) CHECK(plain > 0.1);
  }
}

TEST_CASE("each tile is that of an even picture of as many samples, bit by bit") {
  GlassBall ball;
  RenderOptions& o = ball.options;
  o.error = 0.04;
  const Rendered uneven = ball.render(o);
  CHECK(uneven.report.error_reached);
  CHECK(uneven.report.rmse <= o.error);
  const PartialFilm& sums = *uneven.sums;
  std::vector<std::uint32_t> counts;
  for (const SampleSet& s : sums.done) counts.push_back(s.missing_from(0));
  const std::set<std::uint32_t> different(counts.begin(), counts.end());
  CHECK(different.size() > 3);
  CHECK(uneven.report.samples == int(*different.begin()));
  CHECK(uneven.report.mean_samples > *different.begin());
  CHECK(uneven.report.mean_samples < *different.rbegin());
  o.error = 0;
  for (const std::uint32_t n : different) {
    CAPTURE(n);
    o.samples = int(n);
    const Rendered even = ball.render(o);
    for (int t = 0; t < sums.tiles(); ++t) {
      if (counts[std::size_t(t)] != n) continue;
      const Rect tile = sums.tile(t);
      for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x) {
          const std::size_t i = std::size_t(y * o.width + x);
          REQUIRE(uneven.film.xyz[i] == even.film.xyz[i]);
          REQUIRE(uneven.film.samples[i] == n);
        }
    }
  }
}

TEST_CASE("an uneven picture has the same bits on any threads, and through any number of stops") {
  GlassBall ball;
  RenderOptions& o = ball.options;
  o.filter = FilterShape::BlackmanHarris;
  o.error = 0.03;
  const Rendered whole = ball.render(o);
  for (const int threads : {1, 3}) {
    o.threads = threads;
    CHECK(ball.render(o).film.xyz == whole.film.xyz);
  }
  // Cut off by time wherever that happens to be, in the middle of rounds too.
  o.seconds = whole.report.seconds / 50;
  int stops = 0;
  Rendered part = ball.render(o);
  for (; !part.report.error_reached && stops < 10000; ++stops) {
    o.begin_with = part.sums;
    part = ball.render(o);
  }
  CHECK(stops > 3);
  CHECK(part.film.xyz == whole.film.xyz);
  CHECK(part.film.samples == whole.film.samples);
  CHECK(part.report.rmse == whole.report.rmse);
}

TEST_CASE("a picture that ends by its error takes fewer samples than an even one, and is as good") {
  if (kSanitized) return;
  HandProgram h;
  h.surface("metal", HandProgram::lobe(Lobe::Conductor,
                                       {h.spectrum(0.2), h.spectrum(3.4), h.real(0.3), h.real(0)}));
  const auto scene = load_scene(h.program, {"sphere", "metal", ""});
  REQUIRE(bool(scene));
  RenderOptions o;
  o.width = o.height = 96;
  o.filter = FilterShape::Box;
  const auto picture = [&] {
    auto r = render(h.program, *scene, o);
    REQUIRE(bool(r));
    return std::move(*r);
  };
  const auto mean = [](const Rendered& r) {
    double sum = 0;
    for (const auto& xyz : r.film.xyz) sum += xyz[1];
    return sum / double(r.film.xyz.size());
  };
  o.samples = 256;
  o.seed = 77;
  const Rendered reference = picture();
  constexpr int kSeeds = 8;
  double stated = 0, even_stated = 0, real = 0, shift = 0, shifts = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    o.seed = std::uint64_t(seed);
    o.error = 0.015;
    o.samples = 1 << 16;
    const Rendered r = picture();
    stated += r.report.rmse * r.report.rmse / kSeeds;
    real += (mean_square(r.film, reference.film) - std::pow(reference.report.rmse, 2)) / kSeeds;
    const double d = mean(r) - mean(reference);
    shift += d / kSeeds;
    shifts += d * d / kSeeds;
    // An even picture of a few more samples in all.
    o.error = 0;
    o.samples = int(1.1 * r.report.mean_samples + 1);
    even_stated += std::pow(picture().report.rmse, 2) / kSeeds;
  }
  CHECK(std::sqrt(stated / real) > 0.75);
  CHECK(std::sqrt(stated / real) < 1.33);
  CHECK(even_stated > stated);
  // Samples that decide how many more there are might darken a picture: not so that it is seen.
  const double deviation = std::sqrt((shifts - shift * shift) / (kSeeds - 1));
  CHECK(std::abs(shift) < 4 * deviation);
  CHECK(std::abs(shift) < 1e-3 * mean(reference));
}
