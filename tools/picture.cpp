// SPDX-License-Identifier: Apache-2.0
#include "tools/picture.h"

#include <charconv>
#include <cstdint>

#include <fmt/format.h>

namespace mms::tools {

template <class T>
std::optional<T> number(const std::string& text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}
template std::optional<long long> number(const std::string&);
template std::optional<std::uint64_t> number(const std::string&);
template std::optional<double> number(const std::string&);

void add_picture_options(Verb& verb, PictureOptions& o) {
  verb.add({"--exposure", &o.exposure, "STOPS", "Stops that brighten a .png [0]"});
  verb.add({"--view", &o.view, "NAME",
            "How a .png shows light: thesis, srgb, or ocio:VIEW or ocio:DISPLAY/VIEW [thesis]"});
  verb.add({"--contrast", &o.contrast, "C", "Power in the tone curve of `thesis` [1]"});
  verb.add({"--ocio", &o.ocio, "FILE", "OpenColorIO configuration [$OCIO]"});
  verb.add({"--quiet", &o.quiet, "", "Print errors only"});
}

std::optional<Error> read_picture_options(PictureOptions& o) {
  const auto stops = number<double>(o.exposure);
  if (!stops || !(*stops >= -64 && *stops <= 64))
    return Error{"--exposure", fmt::format("`{}` is not a number of stops", o.exposure),
                 "each stop doubles the brightness; from -64 to 64"};
  o.stops = *stops;
  const auto power = number<double>(o.contrast);
  if (!power || !(*power >= 0.1 && *power <= 10))
    return Error{"--contrast", fmt::format("`{}` is not a contrast", o.contrast),
                 "from 0.1 to 10; more darkens shadows and brightens lights"};
  o.power = *power;
  if (o.view != "thesis" && o.view != "srgb" && o.view != "ocio" && !o.view.starts_with("ocio:"))
    return Error{"--view", fmt::format("there is no view `{}`", o.view),
                 "thesis, srgb, or ocio:VIEW of the configuration that --ocio names"};
  return std::nullopt;
}

}  // namespace mms::tools
