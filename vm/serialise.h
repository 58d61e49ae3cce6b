// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// A linked program as bytes, and back. docs/bytecode.md describes the form; it is little-endian
/// whatever the host, and holds nothing of this build's numbering: instructions, `$variables` and
/// rows of the library are called by name.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "vm/program.h"

namespace mms::vm {

/// A program, and what else a host shows of it.
struct Package {
  Program program;
  std::vector<ParamInfo> params;
  std::vector<std::string> dependencies;  ///< imported files
  friend bool operator==(const Package&, const Package&) = default;
};

/// Bytes that every file starts with. The first is no text, and no transfer of text lets the
/// others pass unchanged.
inline constexpr std::string_view kMagic = "\x89mms\r\n\x1a\n";
/// Of the form; any other is refused.
inline constexpr std::uint32_t kFormat = 2;
/// Magic, format number, checksum, length of the file.
inline constexpr std::size_t kHeaderBytes = 24;
/// Longer files are refused unread.
inline constexpr std::size_t kFileBytes = std::size_t(1) << 26;

/// Whether a file that starts so wants to be a compiled program.
bool is_stored(std::string_view start);

/// `library` are the rows that the program was linked with.
/// \pre `verify(package.program)` found no fault.
std::vector<std::byte> save(const Package& package, std::span<const Builtin> library);

/// The program in `file`, verified, with the rows of `library`. Nothing is allocated that the
/// file's length does not pay for. Errors: it is no such file, of another format, damaged, names
/// what this build does not have, or would not run safely; `where` is the byte.
Result<Package> load(std::span<const std::byte> file, std::span<const Builtin> library);

/// CRC-32C (Castagnoli) of what follows the header.
std::uint32_t checksum(std::span<const std::byte> file);
/// Writes length and checksum into the header of a file whose contents were changed.
void seal(std::span<std::byte> file);

/// The form, as Markdown: made from the functions that read and write it.
std::string format_document();

}  // namespace mms::vm
