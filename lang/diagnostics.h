// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What the compiler has to say about a script. Every message is a row of diagnostics.def;
/// the library never prints.

#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "lang/source.h"

namespace mms::lang {

enum class Severity : std::uint8_t { Error, Warning };

/// One member for each row of diagnostics.def.
enum class Diag : std::uint16_t {
#define DIAG(code, name, ...) name,
#include "lang/diagnostics.def"
#undef DIAG
};

struct DiagInfo {
  std::string_view code;  ///< E0203; never reused
  std::string_view name;
  Severity severity;
  std::string_view text;     ///< with {} for the arguments
  std::string_view explain;  ///< a few sentences and an example, for `mms explain`
};
const DiagInfo& info(Diag d);
std::vector<DiagInfo> all_diagnostics();

/// A second place that a message speaks of: `declared here`.
struct Note {
  Span span;
  std::string text;
};

struct Diagnostic {
  Diag id;
  Severity severity;
  Span span;
  std::string text;   ///< the row's text with its arguments
  std::string label;  ///< beside the carets; may be empty
  std::vector<Note> notes;
  std::vector<std::string> helps;  ///< `help: ...` lines

  Diagnostic& labelled(std::string text_) {
    label = std::move(text_);
    return *this;
  }
  Diagnostic& note(Span s, std::string t) {
    notes.push_back({s, std::move(t)});
    return *this;
  }
  Diagnostic& help(std::string t) {
    helps.push_back(std::move(t));
    return *this;
  }
};

/// Errors of one compilation; after them comes one TooManyErrors, and nothing more is kept. As many
/// warnings.
inline constexpr std::size_t kMaxErrors = 100;

/// Collects diagnostics: each (row, place) once, at most `kMaxErrors` of them.
class Diagnostics {
 public:
  /// Adds a message; the reference is valid until the next call and may be given notes.
  template <class... Args>
  Diagnostic& add(Diag id, Span span, const Args&... args) {
    return add_text(id, span, fmt::format(fmt::runtime(info(id).text), args...));
  }

  /// Keeps a source alive as long as the messages that point into it.
  void keep(SourcePtr source) { sources_.push_back(std::move(source)); }

  const std::vector<Diagnostic>& all() const { return all_; }
  bool has_errors() const { return errors_ > 0; }
  std::size_t error_count() const { return errors_; }
  std::size_t warning_count() const { return all_.size() - errors_; }

 private:
  Diagnostic& add_text(Diag id, Span span, std::string text);

  std::vector<Diagnostic> all_;
  std::vector<SourcePtr> sources_;
  std::set<std::tuple<Diag, const Source*, std::uint32_t, std::uint32_t>> seen_;
  Diagnostic dropped_{};  ///< where repeated messages go
  std::size_t errors_ = 0;
};

/// As a person reads it: message, place, excerpt with carets (right for UTF-8 and tabs), notes,
/// help. `colour` adds ANSI escapes.
std::string render(const Diagnostic& d, bool colour = false);
std::string render(const Diagnostics& d, bool colour = false);
/// As a pipeline reads it: one JSON object on one line (docs/errors.md has the schema).
std::string render_json(const Diagnostic& d);

/// The candidate nearest to `word` by edit distance, or empty if none is near.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace mms::lang
