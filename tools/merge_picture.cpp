// SPDX-License-Identifier: Apache-2.0
// mms merge: films to one film or picture.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "renderer/error.h"
#include "renderer/film_file.h"
#include "renderer/picture.h"
#include "tools/merge.h"
#include "tools/output.h"

namespace mms::tools {

namespace {

using renderer::StoredFilm;

/// The sum of all; what stands in its way.
Result<StoredFilm> add_up(const std::vector<std::string>& paths) {
  Result<StoredFilm> sum = renderer::load_film(paths[0]);
  if (!sum) return sum;
  for (std::size_t i = 1; i < paths.size(); ++i) {
    const Result<StoredFilm> part = renderer::load_film(paths[i]);
    if (!part) return part.error();
    if (const std::string other = renderer::difference(sum->key, part->key); !other.empty())
      return Error{paths[i], fmt::format("is of another picture than {}: {}", paths[0], other),
                   "only parts of one picture add up: same scripts, scene and options"};
    if (sum->film.meets(part->film))
      return Error{paths[i], "has samples that are in an earlier file too",
                   "give each part numbers of its own: --samples 0:64, --samples 64:128"};
    sum->film.add(part->film);
    // One render of all samples looks at the first ones, as the part with the most of them did.
    if (part->layers && (!sum->layers || part->layers->samples > sum->layers->samples))
      sum->layers = part->layers;
  }
  return sum;
}

void print_report(const MergeRequest& request, const StoredFilm& sum) {
  const std::uint32_t fewest = sum.film.fewest_samples();
  const double error = renderer::ErrorEstimate(sum.film).rmse();
  if (request.json()) {
    nlohmann::ordered_json json{{"picture", request.output}, {"samples", fewest}};
    if (tells_error(fewest)) json["error"] = error;
    fmt::print("{}\n", json.dump());
  } else if (!request.quiet) {
    fmt::print("{}: {} per pixel, estimated error {}\n", request.output, counted(fewest, "sample"),
               error_text(fewest, error));
  }
}

}  // namespace

Exit merge_films(const MergeRequest& request) {
  if (const auto ok = check_output({request.output}, request); !ok)
    return fail(Exit::File, ok.error(), request);
  const Result<StoredFilm> sum = add_up(request.films);
  if (!sum) return fail(Exit::File, sum.error(), request);
  const auto written =
      request.output.ends_with(renderer::kFilmExtension)
          ? renderer::save_film(request.output, sum->key, sum->film, sum->layers.get())
          : renderer::write_picture(request.output,
                                    {sum->film.develop(), sum->layers.get(),
                                     metadata(request.output, sum->key, sum->film)},
                                    view_of(request));
  if (!written) return fail(Exit::File, written.error(), request);
  print_report(request, *sum);
  return Exit::Ok;
}

}  // namespace mms::tools
