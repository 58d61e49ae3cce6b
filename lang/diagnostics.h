// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// What the compiler has to say about a script. Every message is a row of diagnostics.def;
/// the library never prints.

#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/result.h"
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
  std::string_view flag;     ///< a warning's name in -W; empty for errors
  std::string_view text;     ///< with {} for the arguments
  std::string_view explain;  ///< a few sentences
  std::string_view wrong;    ///< a script that gives this message, or empty
  std::string_view right;    ///< the same without the mistake
};
const DiagInfo& info(Diag d);
std::vector<DiagInfo> all_diagnostics();

/// The page of one message as Markdown, whose first line is its title: code, name, text,
/// explanation and examples.
std::string page(const DiagInfo& row);

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

/// What becomes of each warning: what the words after -W say.
class WarningPolicy {
 public:
  /// Applies words in order, as `-W` is given them: `error` makes all warnings errors, `error=NAME`
  /// one, `no-error=NAME` takes that back, `no-NAME` silences one and `NAME` has it said again. An
  /// unknown name is an error that offers the nearest one.
  static Result<WarningPolicy> of(std::span<const std::string> words);

  /// What `id` is to be reported as; empty if it is not to be reported.
  std::optional<Severity> severity(Diag id) const;

 private:
  std::optional<Error> apply(std::string_view word);
  std::set<Diag> silent_, errors_, only_warnings_;
  bool all_errors_ = false;
};

/// A call that leads to what is being compiled, because functions are inlined.
struct OpenCall {
  Span span;
  std::string_view name;  ///< of the function; outlives the call
};

/// Errors of one compilation; after them comes one TooManyErrors, and nothing more is kept. As many
/// warnings.
inline constexpr std::size_t kMaxErrors = 100;

/// Of a longer chain of calls only so many are told.
inline constexpr std::size_t kMaxCalls = 4;

/// Collects diagnostics: each (row, place) once, and (row, text) of those without a place; at most
/// `kMaxErrors` of them.
class Diagnostics {
 public:
  Diagnostics() = default;
  explicit Diagnostics(WarningPolicy policy) : policy_(std::move(policy)) {}

  /// Adds a message; the reference is valid until the next call and may be given notes.
  template <class... Args>
  Diagnostic& add(Diag id, Span span, const Args&... args) {
    return add_text(id, span, fmt::format(fmt::runtime(info(id).text), args...));
  }

  /// Messages until the matching `leave_call` get a note that says where the call is.
  void enter_call(Span span, std::string_view name) { calls_.push_back({span, name}); }
  void leave_call() { calls_.pop_back(); }
  /// Calls that are open, and back to so many of them.
  std::size_t open_calls() const { return calls_.size(); }
  void leave_calls(std::size_t left) { calls_.resize(left); }

  /// Keeps a source alive as long as the messages that point into it.
  void keep(SourcePtr source) { sources_.push_back(std::move(source)); }

  const std::vector<Diagnostic>& all() const { return all_; }
  bool has_errors() const { return errors_ > 0; }
  std::size_t error_count() const { return errors_; }
  std::size_t warning_count() const { return all_.size() - errors_; }

 private:
  Diagnostic& add_text(Diag id, Span span, std::string text);
  void note_calls(Diagnostic& d) const;

  WarningPolicy policy_;
  std::vector<OpenCall> calls_;

  std::vector<Diagnostic> all_;
  std::vector<SourcePtr> sources_;
  std::set<std::tuple<Diag, const Source*, std::uint32_t, std::uint32_t, std::string>> seen_;
  Diagnostic dropped_{};  ///< where repeated messages go
  std::size_t errors_ = 0;
};

/// As a person reads it: message, place, excerpt with carets (right for UTF-8 and tabs), notes,
/// help. `colour` adds ANSI escapes.
std::string render(const Diagnostic& d, bool colour = false);
std::string render(const Diagnostics& d, bool colour = false);

/// A member of the JSON objects and what it holds.
struct JsonMember {
  std::string_view name, doc;
};
/// Every member of a message's object, and of an object of its `notes`, in their order.
std::span<const JsonMember> json_members();
std::span<const JsonMember> json_note_members();
/// As a pipeline reads it: one JSON object on one line, with the members above.
std::string render_json(const Diagnostic& d);

/// The candidate nearest to `word` by edit distance, or empty if none is near.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace mms::lang
