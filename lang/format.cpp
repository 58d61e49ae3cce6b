// SPDX-License-Identifier: Apache-2.0
#include "lang/format.h"

#include <algorithm>
#include <stdexcept>

#include "lang/format_pieces.h"
#include "lang/lexer.h"
#include "lang/parser.h"

namespace mms::lang {
namespace {

constexpr int kIndent = 4;
/// Code that is wider does not push the comments of its neighbours to the right.
constexpr int kCommentColumn = 60;

/// Pieces [first, last) on one line.
struct Line {
  std::size_t first = 0, last = 0;
  int indent = 0;
  bool blank_before = false;
  int assign_padding = 0, comment_padding = 0;
};

class Layout {
 public:
  explicit Layout(Pieces& all) : all_(all), pieces_(all.pieces) {}

  /// Each round adds line breaks until every line fits, or cannot be broken.
  std::string text() {
    do {
      lines_.clear();
      break_lines();
      indent_lines();
      align_assignments();
    } while (wrap());
    align_comments();
    std::string out;
    for (const Line& line : lines_) {
      if (line.blank_before) out += '\n';
      out += line_text(line) + '\n';
    }
    return out;
  }

 private:
  bool breaks_before(std::size_t i) const {
    const Piece &p = pieces_[i], &previous = pieces_[i - 1];
    if (previous.ends_line) return true;
    const bool clings = p.tok == Tok::Semicolon || p.tok == Tok::Comma;
    if (clings && !p.comment && !previous.comment) return false;
    if (p.newlines > 0) return true;
    const bool forced = p.starts || (p.closes && p.tok == Tok::KwEnd);
    return forced && !p.comment && !previous.comment && open_[p.block];
  }

  /// A block that has a line break anywhere has a line for each of its statements.
  void find_open_blocks() {
    std::vector<std::size_t> breaks{0};  // before each piece and all that precede it
    for (std::size_t i = 0; i < pieces_.size(); ++i)
      breaks.push_back(breaks[i] +
                       (pieces_[i].newlines > 0 || (i > 0 && pieces_[i - 1].ends_line)));
    open_.assign(all_.blocks.size(), true);
    for (std::size_t b = 1; b < open_.size(); ++b) {
      const Block& block = all_.blocks[b];
      open_[b] =
          block.form != Block::Form::Bracket && breaks[block.closer + 1] > breaks[block.opener + 1];
    }
  }

  void break_lines() {
    find_open_blocks();
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (i > 0 && !breaks_before(i)) {
        lines_.back().last = i + 1;
        continue;
      }
      const bool inside = i > 0 && !(pieces_[i].closes && !pieces_[i].comment) &&
                          !(pieces_[i].starts && opens_block(i - 1));
      lines_.push_back({i, i + 1});
      lines_.back().blank_before = inside && pieces_[i].newlines > 1;
    }
  }

  /// The block that begins after piece `i` is the one the next piece stands in.
  bool opens_block(std::size_t i) const { return all_.blocks[pieces_[i + 1].block].opener == i; }

  void indent_lines() {
    block_indent_.assign(all_.blocks.size(), 0);
    statement_indent_.assign(all_.blocks.size(), 0);
    std::vector<std::size_t> opened(pieces_.size(), kNone);
    for (std::size_t b = 1; b < all_.blocks.size(); ++b) opened[all_.blocks[b].opener] = b;
    for (Line& line : lines_) {
      line.indent = indent(pieces_[line.first]);
      for (std::size_t i = line.first; i < line.last; ++i) {
        const Piece& p = pieces_[i];
        if (p.starts && !p.comment) statement_indent_[p.block] = line.indent;
        const std::size_t b = opened[i];
        if (b == kNone) continue;
        const Block& block = all_.blocks[b];
        const bool body = block.form == Block::Form::Body;
        block_indent_[b] = body ? statement_indent_[block.parent] : line.indent;
        statement_indent_[b] = block_indent_[b] + kIndent;
      }
    }
  }

  int indent(const Piece& p) const {
    const std::size_t b = p.block;
    if (p.closes && !p.comment) return block_indent_[b];
    const int inner = b == 0 ? 0 : block_indent_[b] + kIndent;
    if (all_.blocks[b].form == Block::Form::Bracket || p.starts) return inner;
    return statement_indent_[b] + kIndent;
  }

  bool space_before(const Line& line, std::size_t i) const {
    return i > line.first &&
           space_between(i >= 2 ? &pieces_[i - 2] : nullptr, pieces_[i - 1], pieces_[i]);
  }

  /// Columns that piece `i` takes, and what stands before it on its line.
  int columns(const Line& line, std::size_t i) const {
    const bool padded = i > line.first && i == pieces_[line.first].assign;
    return space_before(line, i) + (padded ? line.assign_padding : 0) + pieces_[i].width;
  }

  /// Columns to the end of the piece before `end`, indentation included.
  int width_to(const Line& line, std::size_t end) const {
    int width = line.indent;
    for (std::size_t i = line.first; i < end; ++i) width += columns(line, i);
    return width;
  }

  std::size_t code_end(const Line& line) const {
    const bool trailing = pieces_[line.last - 1].comment && line.last - line.first > 1;
    return trailing ? line.last - 1 : line.last;
  }

  void align_assignments() {
    std::vector<Line*> run;
    auto finish = [&] {
      int widest = 0;
      for (const Line* l : run) widest = std::max(widest, width_to(*l, pieces_[l->first].assign));
      for (Line* l : run) l->assign_padding = widest - width_to(*l, pieces_[l->first].assign);
      run.clear();
    };
    for (Line& line : lines_) {
      const Piece& p = pieces_[line.first];
      const bool member = p.starts && !p.comment && p.assign < line.last;
      const bool joins = !run.empty() && !line.blank_before &&
                         (p.comment || pieces_[run.back()->first].block == p.block);
      if (!joins || !(member || p.comment)) finish();
      if (member) run.push_back(&line);
    }
    finish();
  }

  void align_comments() {
    std::vector<Line*> run;
    auto finish = [&] {
      int widest = 0;
      for (const Line* l : run) widest = std::max(widest, l->indent + width_to(*l, code_end(*l)));
      for (Line* l : run) l->comment_padding = 1 + widest - l->indent - width_to(*l, code_end(*l));
      run.clear();
    };
    for (Line& line : lines_) {
      const bool trailing = code_end(line) != line.last && pieces_[line.last - 1].ends_line;
      const bool wide = width_to(line, code_end(line)) > kCommentColumn;
      if (!trailing || wide || line.blank_before) finish();
      if (trailing && wide) line.comment_padding = 1;
      if (trailing && !wide) run.push_back(&line);
    }
    finish();
  }

  /// Breaks each line that is too wide once. False if there is none that can be broken.
  bool wrap() {
    bool any = false;
    for (const Line& line : lines_) {
      const std::size_t end = code_end(line);
      if (width_to(line, end) <= kFormatWidth) continue;
      const std::size_t at = break_at(line, end);
      if (at == kNone) continue;
      pieces_[at].newlines = 1;
      any = true;
    }
    return any;
  }

  /// Where to break: into the outermost block that stands whole on the line; else before the
  /// value of a function if it fits then; else at the least disliked place that is late enough,
  /// and of those the last.
  std::size_t break_at(const Line& line, std::size_t end) const {
    for (std::size_t i = line.first; i + 1 < end; ++i) {
      const Block& b = all_.blocks[pieces_[i + 1].block];
      if (opens_block(i) && b.form != Block::Form::Bracket && b.closer < end) return i + 1;
    }
    const std::size_t value = value_of_function(line, end);
    if (value != kNone && kIndent + width_to(line, end) - width_to(line, value) <= kFormatWidth)
      return value;
    const int early = line.indent + (kFormatWidth - line.indent) / 3;
    std::size_t best = kNone, fallback = kNone;
    int least = 0, width = line.indent + pieces_[line.first].width;
    for (std::size_t i = line.first + 1; i < end; width += columns(line, i), ++i) {
      const int penalty = break_penalty(all_, i - 1, i);
      if (penalty < 0) continue;
      if (width > kFormatWidth) return best != kNone ? best : fallback != kNone ? fallback : i;
      fallback = i;
      if (width <= early || (best != kNone && penalty > least)) continue;
      best = i;
      least = penalty;
    }
    return best != kNone ? best : fallback;
  }

  /// What follows `type name(formals) =`.
  std::size_t value_of_function(const Line& line, std::size_t end) const {
    for (std::size_t i = line.first + 1; i + 1 < end; ++i)
      if (pieces_[i].tok == Tok::Assign && pieces_[i - 1].tok == Tok::RightParen &&
          all_.blocks[pieces_[i].block].form == Block::Form::Body)
        return i + 1;
    return kNone;
  }

  std::string line_text(const Line& line) const {
    std::string out(static_cast<std::size_t>(line.indent), ' ');
    const std::size_t assign = pieces_[line.first].assign;
    for (std::size_t i = line.first; i < line.last; ++i) {
      if (space_before(line, i)) out += ' ';
      if (i > line.first && i == assign)
        out.append(static_cast<std::size_t>(line.assign_padding), ' ');
      if (i > line.first && i + 1 == line.last && pieces_[i].comment)
        out.append(static_cast<std::size_t>(line.comment_padding), ' ');
      out += pieces_[i].text;
    }
    return out;
  }

  Pieces& all_;
  std::vector<Piece>& pieces_;
  std::vector<Line> lines_;
  std::vector<bool> open_;  ///< blocks with a line for each statement
  std::vector<int> block_indent_, statement_indent_;
};

/// Forms and texts of all tokens.
std::vector<std::pair<Tok, std::string_view>> tokens_of(const Source& source) {
  Diagnostics ignored;
  Lexer lexer(source, ignored);
  std::vector<std::pair<Tok, std::string_view>> all;
  for (Token t = lexer.next(); t.tok != Tok::Eof; t = lexer.next())
    all.emplace_back(t.tok, source.text.substr(t.begin, t.end - t.begin));
  return all;
}

}  // namespace

std::optional<std::string> format(const SourcePtr& source, Diagnostics& diagnostics) {
  const Graph graph = parse(source, diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  Pieces all = pieces_of(graph);
  std::string text = Layout(all).text();
  const SourcePtr after = make_source(source->name, text);
  if (tokens_of(*source) != tokens_of(*after))
    throw std::logic_error("formatting changes the tokens of " + source->name);
  return text;
}

}  // namespace mms::lang
