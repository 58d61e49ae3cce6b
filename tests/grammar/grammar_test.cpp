// SPDX-License-Identifier: Apache-2.0
// The published grammar and the parser written by hand accept and reject the same files, and the
// golden scripts use every alternative of the grammar.
#include <doctest/doctest.h>

#include <algorithm>
#include <random>

#include "api/library.h"
#include "lang/lexer.h"
#include "lang/parser.h"
#include "tests/golden/corpus.h"
#include "tests/grammar/recogniser.h"
#include "tests/sanitized.h"
#include "tests/source_dir.h"

namespace mms::grammar {
namespace {

namespace fs = std::filesystem;

/// What the parser refuses although the grammar derives it: values and sizes, not forms.
bool beyond_the_grammar(lang::Diag id) {
  switch (id) {
    case lang::Diag::IntegerTooLarge:
    case lang::Diag::RealTooLarge:
    case lang::Diag::TooManyDimensions:
    case lang::Diag::RaggedRows:
    case lang::Diag::ForeignType:
    case lang::Diag::NestingTooDeep:
    case lang::Diag::ExpressionTooLong:
    case lang::Diag::SourceTooLong:
      return true;
    default:
      return false;
  }
}

enum class Verdict { Accepted, Rejected, Undecided };

/// What the parser says of the form. After a message about a value it may not have read on.
Verdict parser_says(const lang::SourcePtr& source) {
  lang::Diagnostics d;
  lang::parse(source, d);
  Verdict verdict = Verdict::Accepted;
  for (const lang::Diagnostic& one : d.all()) {
    if (!beyond_the_grammar(one.id)) return Verdict::Rejected;
    verdict = Verdict::Undecided;
  }
  return verdict;
}

std::vector<lang::SourcePtr> corpus() {
  std::vector<lang::SourcePtr> all;
  const auto add = [&](const fs::path& p) {
    const auto source = api::read_source(p.string());
    if (source) all.push_back(*source);
  };
  for (const fs::path& p : golden::scripts()) add(p);
  for (const char* folder : {"/examples", "/stdlib", "/tests/golden/imports/parts"}) {
    std::vector<fs::path> files;
    for (const auto& e : fs::directory_iterator(fs::path(mms::source_dir()) += folder))
      if (e.path().extension() == ".mms") files.push_back(e.path());
    std::sort(files.begin(), files.end());
    for (const fs::path& p : files) add(p);
  }
  for (const lang::DiagInfo& row : lang::all_diagnostics())
    for (const std::string_view text : {row.wrong, row.right})
      if (!text.empty()) all.push_back(lang::make_source("example", std::string(text)));
  return all;
}

std::string check_same(const lang::SourcePtr& source) {
  const Verdict parser = parser_says(source);
  if (parser == Verdict::Undecided) return "";
  const bool grammar = recognise(source).accepted;
  if (grammar == (parser == Verdict::Accepted)) return "";
  return grammar ? "the parser alone rejects" : "the grammar alone rejects";
}

TEST_CASE("the grammar and the parser agree on every script") {
  const auto all = corpus();
  CHECK(all.size() > 300);
  for (const lang::SourcePtr& source : all) {
    CAPTURE(source->name);
    const std::string wrong = check_same(source);
    CHECK_MESSAGE(wrong.empty(), wrong);
  }
}

std::vector<std::string> tokens_of(const lang::SourcePtr& source) {
  std::vector<std::string> all;
  lang::Diagnostics d;
  lang::Lexer lexer(*source, d);
  for (lang::Token t = lexer.next(); t.tok != lang::Tok::Eof; t = lexer.next())
    all.emplace_back(source->text.substr(t.begin, t.end - t.begin));
  return d.all().empty() ? all : std::vector<std::string>{};
}

TEST_CASE("the grammar and the parser agree on scripts with tokens changed") {
  constexpr int kScripts = kSanitized ? 1000 : 20000;
  constexpr std::size_t kLongest = 400;  // tokens; shorter scripts are more often still in order
  std::vector<std::vector<std::string>> scripts;
  std::vector<std::string> pool;
  for (const lang::SourcePtr& source : corpus()) {
    std::vector<std::string> tokens = tokens_of(source);
    pool.insert(pool.end(), tokens.begin(), tokens.end());
    if (!tokens.empty() && tokens.size() <= kLongest) scripts.push_back(std::move(tokens));
  }
  std::sort(pool.begin(), pool.end());  // each token once: the rare ones matter as much
  pool.erase(std::unique(pool.begin(), pool.end()), pool.end());
  std::mt19937 random(7);
  const auto below = [&](std::size_t n) { return std::size_t{random()} % n; };
  int accepted = 0, differences = 0;
  for (int k = 0; k < kScripts; ++k) {
    std::vector<std::string> t = scripts[below(scripts.size())];
    for (std::size_t changes = 1 + below(2); changes-- > 0 && !t.empty();) {
      const std::size_t i = below(t.size()), j = below(t.size());
      const auto at = t.begin() + static_cast<std::ptrdiff_t>(i);
      switch (below(5)) {
        case 0:
          t.erase(at);
          break;
        case 1:
          t.insert(at, pool[below(pool.size())]);
          break;
        case 2:
          *at = pool[below(pool.size())];
          break;
        case 3:
          std::swap(t[i], t[j]);
          break;
        default:
          t.insert(at, t[j]);
      }
    }
    std::string text;
    for (const std::string& token : t) text += token + " ";
    const lang::SourcePtr source = lang::make_source("changed", text);
    const std::string wrong = check_same(source);
    accepted += wrong.empty() && parser_says(source) == Verdict::Accepted;
    if (wrong.empty()) continue;
    CHECK_MESSAGE(++differences == 0, wrong, ": ", text);
    if (differences == 10) break;
  }
  CHECK(accepted > kScripts / 20);
  CHECK(accepted < kScripts / 2);
}

TEST_CASE("the golden scripts use every alternative of the grammar") {
  const std::vector<std::string> rules = all_rules();
  REQUIRE(rules.size() > 100);
  std::set<int> used;
  for (const fs::path& path : golden::scripts()) {
    const auto source = api::read_source(path.string());
    REQUIRE(source);
    const Recognition r = recognise(*source, Rules::Noted);
    if (r.accepted) used.insert(r.rules.begin(), r.rules.end());
  }
  for (std::size_t k = 1; k < rules.size(); ++k)  // 0 is `$accept: program $end`, never reduced
    CHECK_MESSAGE(used.contains(static_cast<int>(k)), "no golden script uses ", rules[k]);
}

}  // namespace
}  // namespace mms::grammar
