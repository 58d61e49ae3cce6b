// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Options of the verbs that run a script over sample points.

#include "api/samples.h"
#include "tools/script.h"

namespace mms::tools {

struct SampleOptions : ScriptOptions {
  std::string samples, box;
};

/// `--samples` (`count` where it is not given) and `--box`. `options` outlives the verb.
void add_sample_options(Verb& verb, SampleOptions& options, const std::string& count);

/// What they say; the error names the option.
Result<api::Samples> samples_of(const SampleOptions& options);

}  // namespace mms::tools
