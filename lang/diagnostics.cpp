// SPDX-License-Identifier: Apache-2.0
#include "lang/diagnostics.h"

#include <algorithm>
#include <iterator>

namespace mms::lang {
namespace {

constexpr DiagInfo kTable[] = {
#define DIAG(code, name, severity, text, explain) {#code, #name, Severity::severity, text, explain},
#include "lang/diagnostics.def"
#undef DIAG
};

// Words longer than this are no typing mistakes; the bound also keeps `nearest` fast.
constexpr std::size_t kLongestWord = 64;

/// Insertions, deletions, replacements and swaps of neighbours that turn `a` into `b`: optimal
/// string alignment (Damerau 1964 with each letter moved at most once).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

}  // namespace

const DiagInfo& info(Diag d) { return kTable[static_cast<std::size_t>(d)]; }

std::vector<DiagInfo> all_diagnostics() { return {std::begin(kTable), std::end(kTable)}; }

Diagnostic& Diagnostics::add_text(Diag id, Span span, std::string text) {
  const Severity severity = info(id).severity;
  const bool error = severity == Severity::Error;
  const bool full = error ? errors_ >= kMaxErrors : warning_count() >= kMaxErrors;
  dropped_ = {};
  if (full && error && errors_ == kMaxErrors) {
    ++errors_;
    const Diag last = Diag::TooManyErrors;
    all_.push_back({last, info(last).severity, span, std::string(info(last).text), {}, {}, {}});
  }
  if (full || !seen_.insert({id, span.source, span.begin, span.end}).second) return dropped_;
  errors_ += error ? 1 : 0;
  all_.push_back({id, severity, span, std::move(text), {}, {}, {}});
  return all_.back();
}

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
  if (word.size() > kLongestWord) return {};
  std::string best;
  std::size_t best_distance = SIZE_MAX;
  for (const std::string& candidate : candidates) {
    const std::size_t longer = std::max(word.size(), candidate.size());
    const std::size_t shorter = std::min(word.size(), candidate.size());
    const std::size_t cut = longer / 3;
    if (longer > kLongestWord || longer - shorter > cut) continue;
    const std::size_t distance = edit_distance(word, candidate);
    if (distance > cut || distance >= best_distance) continue;
    best = candidate;
    best_distance = distance;
  }
  return best;
}

}  // namespace mms::lang
