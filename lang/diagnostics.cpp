// SPDX-License-Identifier: Apache-2.0
#include "lang/diagnostics.h"

#include <algorithm>
#include <iterator>

namespace mms::lang {
namespace {

constexpr DiagInfo kTable[] = {
#define DIAG(code, name, severity, ...) {#code, #name, Severity::severity, "", __VA_ARGS__},
#define WARNING(code, name, flag, ...) {#code, #name, Severity::Warning, flag, __VA_ARGS__},
#include "lang/diagnostics.def"
#undef DIAG
};

// Words longer than this are no typing mistakes; the bound also keeps `nearest` fast.
constexpr std::size_t kLongestWord = 64;

// Bytes of a message; only one that quotes a monstrous name is longer.
constexpr std::size_t kLongestText = 1000;

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

std::string page(const DiagInfo& row) {
  std::string text =
      fmt::format("{} {}\n\n{}: {}\n\n{}\n", row.code, row.name,
                  row.severity == Severity::Error ? "error" : "warning", row.text, row.explain);
  if (!row.flag.empty())
    text += fmt::format("\nSilenced by `-Wno-{0}`, an error with `-Werror={0}`.\n", row.flag);
  if (!row.wrong.empty()) text += fmt::format("\nNot:\n\n```\n{}\n```\n", row.wrong);
  if (!row.right.empty()) text += fmt::format("\nBut:\n\n```\n{}\n```\n", row.right);
  return text;
}

Result<WarningPolicy> WarningPolicy::of(std::span<const std::string> words) {
  WarningPolicy policy;
  for (const std::string& word : words)
    if (std::optional<Error> error = policy.apply(word)) return *error;
  return policy;
}

std::optional<Error> WarningPolicy::apply(std::string_view word) {
  const auto take = [&word](std::string_view prefix) {
    const bool there = word.starts_with(prefix);
    if (there) word.remove_prefix(prefix.size());
    return there;
  };
  const std::string whole = fmt::format("-W{}", word);
  if (word == "error" || word == "no-error") {
    all_errors_ = word == "error";
    return std::nullopt;
  }
  const bool off = take("no-"), error = take("error=");
  std::vector<std::string> names;
  for (std::size_t k = 0; k < std::size(kTable); ++k) {
    const Diag id = static_cast<Diag>(k);
    if (kTable[k].flag.empty()) continue;
    names.emplace_back(kTable[k].flag);
    if (kTable[k].flag != word) continue;
    if (!error && off) silent_.insert(id);
    if (!off) silent_.erase(id);
    if (error && off) errors_.erase(id), only_warnings_.insert(id);
    if (error && !off) only_warnings_.erase(id), errors_.insert(id);
    return std::nullopt;
  }
  const std::string near = nearest(word, names);
  return Error{whole, fmt::format("no warning is called `{}`", word.substr(0, kLongestWord)),
               near.empty() ? fmt::format("there are {}", fmt::join(names, ", "))
                            : fmt::format("did you mean `{}`?", near)};
}

std::optional<Severity> WarningPolicy::severity(Diag id) const {
  const Severity own = info(id).severity;
  if (own == Severity::Error) return own;
  if (silent_.contains(id)) return std::nullopt;
  const bool error = errors_.contains(id) || (all_errors_ && !only_warnings_.contains(id));
  return error ? Severity::Error : own;
}

Diagnostic& Diagnostics::add_text(Diag id, Span span, std::string text) {
  dropped_ = {};
  if (text.size() > kLongestText) {
    std::size_t end = kLongestText;
    while (end > 0 && (text[end] & 0xC0) == 0x80) --end;
    text.replace(end, text.size(), "...");
  }
  const std::optional<Severity> severity = policy_.severity(id);
  if (!severity) return dropped_;
  const bool error = *severity == Severity::Error;
  const bool full = error ? errors_ >= kMaxErrors : warning_count() >= kMaxErrors;
  if (full && error && errors_ == kMaxErrors) {
    ++errors_;
    const Diag last = Diag::TooManyErrors;
    all_.push_back({last, info(last).severity, span, std::string(info(last).text), {}, {}, {}});
  }
  const std::string subject = span ? std::string() : text;
  if (full || !seen_.insert({id, span.source, span.begin, span.end, subject}).second)
    return dropped_;
  errors_ += error ? 1 : 0;
  all_.push_back({id, *severity, span, std::move(text), {}, {}, {}});
  note_calls(all_.back());
  return all_.back();
}

// The innermost calls and the outermost one, which stands in what the user compiles.
void Diagnostics::note_calls(Diagnostic& d) const {
  std::vector<OpenCall> chain;
  for (auto call = calls_.rbegin(); call != calls_.rend(); ++call)
    if (chain.empty() || chain.back().span != call->span) chain.push_back(*call);
  const std::size_t left_out = chain.size() > kMaxCalls ? chain.size() - kMaxCalls : 0;
  if (left_out) chain.erase(chain.begin() + kMaxCalls - 1, chain.end() - 1);
  for (const OpenCall& call : chain)
    d.note(call.span, fmt::format("`{}` is called here", call.name));
  if (left_out) d.note({}, fmt::format("{} calls between these are not shown", left_out));
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
