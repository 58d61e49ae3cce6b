// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// docs/performance.md is made of parts, each written by one benchmark between two marks; the
/// order of the parts in the file stays.

#include <string>
#include <string_view>

namespace mms::bench {

/// The name of the processor, as the system says it.
std::string processor();

/// How many processes wanted to run in the last minute; ours is one.
std::string load();

/// Puts `text` in place of the part `name` of docs/performance.md, or at its end if there is none.
/// False, with a message on standard error, where the file cannot be written.
bool write_part(std::string_view name, std::string_view text);

/// The main function of `bench_NAME`: prints what `make` measures, and writes it as that part
/// unless `--no-document` is asked for. Its exit code.
int part_main(int count, char** arguments, std::string_view name, std::string (*make)());

}  // namespace mms::bench
