// SPDX-License-Identifier: Apache-2.0
// Diagnostics as text for people, and as JSON.

#include <algorithm>
#include <iterator>

#include "lang/diagnostics.h"
#include "lang/utf8.h"

namespace mms::lang {
namespace {

constexpr std::size_t kTab = 4;         // columns between tab stops
constexpr std::size_t kColumns = 100;   // of a source line that are shown
constexpr std::size_t kBefore = 40;     // columns kept before the carets of a line that is cut
constexpr std::size_t kLongLine = 400;  // bytes; of a longer line only a part is looked at

std::string_view word(Severity s) { return s == Severity::Error ? "error" : "warning"; }

struct Palette {
  const char *error, *warning, *bold, *gutter, *help, *off;
};
constexpr Palette kPlain = {"", "", "", "", "", ""};
constexpr Palette kAnsi = {"\x1b[1;31m", "\x1b[1;33m", "\x1b[1m",
                           "\x1b[34m",   "\x1b[36m",   "\x1b[0m"};

struct Range {
  char32_t first, last;
};
template <std::size_t N>
bool in(const Range (&ranges)[N], char32_t c) {
  return std::any_of(std::begin(ranges), std::end(ranges),
                     [c](Range r) { return c >= r.first && c <= r.last; });
}
// Columns on a terminal: the blocks of Unicode's EastAsianWidth W and F, and combining marks.
constexpr Range kWide[] = {
    {0x1100, 0x115F}, {0x2E80, 0xA4CF}, {0xAC00, 0xD7A3},   {0xF900, 0xFAFF},   {0xFE30, 0xFE6F},
    {0xFF00, 0xFF60}, {0xFFE0, 0xFFE6}, {0x1F300, 0x1F64F}, {0x1F900, 0x1F9FF}, {0x20000, 0x3FFFD}};
constexpr Range kNarrow[] = {{0x0300, 0x036F}, {0x20D0, 0x20FF}, {0xFE00, 0xFE0F}};
// Characters that would act on the terminal or reorder the line.
constexpr Range kHidden[] = {{0x00, 0x1F},     {0x7F, 0x9F},     {0x200B, 0x200F},
                             {0x2028, 0x202E}, {0x2060, 0x206F}, {0xFEFF, 0xFEFF}};

/// A source line as it is shown: tabs expanded, hidden characters replaced, cut if it is long.
class Line {
 public:
  /// \param focus the byte of the line that must be seen
  Line(std::string_view text, std::size_t focus);
  const std::string& shown() const { return shown_; }
  /// The column, from 0, where byte `offset` of the line is shown.
  std::size_t column(std::size_t offset) const;

 private:
  struct Cell {
    std::size_t offset, column, width;
    std::string text;
  };
  void split(std::string_view text, std::size_t begin, std::size_t end);

  std::vector<Cell> cells_;
  std::size_t width_ = 0;
  std::size_t first_ = 0, last_ = 0;  // columns shown
  std::size_t indent_ = 0;            // of the mark that says the line is cut
  std::string shown_;
};

Line::Line(std::string_view text, std::size_t focus) {
  std::size_t begin = 0, end = text.size();
  if (end > kLongLine) {
    begin = focus > kLongLine / 2 ? focus - kLongLine / 2 : 0;
    end = std::min(end, begin + 2 * kLongLine);
    for (int k = 0; k < 3 && begin > 0 && (text[begin] & 0xC0) == 0x80; ++k) --begin;
  }
  split(text, begin, end);
  last_ = width_;
  if (const std::size_t at = column(focus); width_ > kColumns) {
    first_ = at > kColumns - kBefore ? at - kBefore : 0;
    last_ = std::min(width_, first_ + kColumns);
  }
  const bool cut_left = begin > 0 || first_ > 0, cut_right = end < text.size() || last_ < width_;
  if (cut_left) shown_ = "...";
  for (const Cell& c : cells_)
    if (c.column >= first_ && c.column + c.width <= last_) shown_ += c.text;
  if (cut_right) shown_ += "...";
  indent_ = cut_left ? 3 : 0;
}

void Line::split(std::string_view text, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end;) {
    const Character c = character_at(text, i);
    Cell cell{i, width_, 1, std::string(text.substr(i, c.length))};
    if (c.value == '\t') {
      cell.width = kTab - width_ % kTab;
      cell.text.assign(cell.width, ' ');
    } else if (!c.valid || in(kHidden, c.value)) {
      cell.text = kReplacement;
    } else if (in(kWide, c.value)) {
      cell.width = 2;
    } else if (in(kNarrow, c.value)) {
      cell.width = 0;
    }
    i += c.length;
    width_ += cell.width;
    cells_.push_back(std::move(cell));
  }
}

std::size_t Line::column(std::size_t offset) const {
  const auto c = std::lower_bound(cells_.begin(), cells_.end(), offset,
                                  [](const Cell& a, std::size_t b) { return a.offset < b; });
  const std::size_t at = c == cells_.end() ? width_ : c->column;
  return last_ == 0 ? at : std::clamp(at, first_, last_) - first_ + indent_;
}

/// What is marked in a line.
struct Mark {
  std::uint32_t line;
  Span span;
  bool primary;
  std::string_view text;
};

class Renderer {
 public:
  Renderer(const Diagnostic& d, bool colour) : d_(d), p_(colour ? kAnsi : kPlain) {}
  std::string run();

 private:
  template <class... Args>
  void put(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
  }
  const char* severity_colour() const {
    return d_.severity == Severity::Error ? p_.error : p_.warning;
  }
  void find_gutter();
  void file(const Source* source, Span first, bool primary);
  void line(const std::vector<Mark>& marks, std::size_t begin, std::size_t end);
  void carets(const Mark& mark, const Line& shown, std::uint32_t start, std::size_t length);

  const Diagnostic& d_;
  const Palette& p_;
  std::size_t gutter_ = 1;  // digits of the largest line number
  std::string out_;
};

std::string Renderer::run() {
  find_gutter();
  put("{}{}[{}]{}{}: {}{}", severity_colour(), word(d_.severity), info(d_.id).code, p_.off, p_.bold,
      d_.text, p_.off);
  if (const std::string_view flag = info(d_.id).flag; !flag.empty()) put(" [-W{}]", flag);
  out_ += '\n';
  std::vector<const Source*> done;
  if (d_.span) {
    file(d_.span.source, d_.span, true);
    done.push_back(d_.span.source);
  }
  for (const Note& n : d_.notes) {
    if (!n.span || std::find(done.begin(), done.end(), n.span.source) != done.end()) continue;
    file(n.span.source, n.span, false);
    done.push_back(n.span.source);
  }
  for (const Note& n : d_.notes)
    if (!n.span) put("{}{:{}}={} note: {}\n", p_.gutter, "", gutter_ + 2, p_.off, n.text);
  for (const std::string& help : d_.helps)
    put("{}{:{}}= {}help{}: {}\n", p_.gutter, "", gutter_ + 2, p_.help, p_.off, help);
  return std::move(out_);
}

void Renderer::find_gutter() {
  const auto widen = [&](Span s) {
    if (!s) return;
    const std::uint32_t line = position_at(*s.source, s.begin).line;
    gutter_ = std::max(gutter_, fmt::formatted_size("{}", line));
  };
  widen(d_.span);
  for (const Note& n : d_.notes) widen(n.span);
}

// The place, and each line of `source` that has marks.
void Renderer::file(const Source* source, Span first, bool primary) {
  const Position at = position_at(*source, first.begin);
  put("{}{:{}}{}{} {}:{}:{}\n", p_.gutter, "", gutter_ + 1, primary ? "-->" : ":::", p_.off,
      source->name, at.line, at.column);
  put("{}{:{}}|{}\n", p_.gutter, "", gutter_ + 2, p_.off);
  std::vector<Mark> marks;
  if (primary) marks.push_back({at.line, d_.span, true, d_.label});
  for (const Note& n : d_.notes)
    if (n.span.source == source)
      marks.push_back({position_at(*source, n.span.begin).line, n.span, false, n.text});
  std::stable_sort(marks.begin(), marks.end(),
                   [](const Mark& a, const Mark& b) { return a.line < b.line; });
  for (std::size_t i = 0; i < marks.size();) {
    std::size_t end = i;
    while (end < marks.size() && marks[end].line == marks[i].line) ++end;
    line(marks, i, end);
    i = end;
  }
}

void Renderer::line(const std::vector<Mark>& marks, std::size_t begin, std::size_t end) {
  const Mark& first = marks[begin];
  const std::string_view text = line_text(*first.span.source, first.line);
  const std::uint32_t start = first.span.source->line_starts[first.line - 1];
  const Line shown(text, std::min<std::size_t>(first.span.begin - start, text.size()));
  put("{} {:{}} |{}{}{}\n", p_.gutter, first.line, gutter_, p_.off, text.empty() ? "" : " ",
      shown.shown());
  for (std::size_t i = begin; i < end; ++i) carets(marks[i], shown, start, text.size());
}

// A mark that goes on in later lines is drawn to the end of its first one.
void Renderer::carets(const Mark& mark, const Line& shown, std::uint32_t start,
                      std::size_t length) {
  const std::size_t begin = std::min<std::size_t>(mark.span.begin - start, length);
  const std::size_t end = std::min<std::size_t>(mark.span.end - start, length);
  const std::size_t column = shown.column(begin);
  const std::size_t width = std::max<std::size_t>(1, shown.column(std::max(begin, end)) - column);
  put("{}{:{}}|{} {:{}}{}", p_.gutter, "", gutter_ + 2, p_.off, "", column,
      mark.primary ? severity_colour() : p_.gutter);
  out_.append(width, mark.primary ? '^' : '-');
  put("{}{}{}\n", mark.text.empty() ? "" : " ", mark.text, p_.off);
}

// JSON.

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (std::size_t i = 0; i < text.size();) {
    const Character c = character_at(text, i);
    switch (c.value) {
      case '"':
        out += "\\\"";
        break;
      case '\\':
        out += "\\\\";
        break;
      case '\n':
        out += "\\n";
        break;
      case '\t':
        out += "\\t";
        break;
      default:
        if (!c.valid)
          out += kReplacement;
        else if (c.value < 0x20 || c.value == 0x7F)
          out += fmt::format("\\u{:04x}", static_cast<std::uint32_t>(c.value));
        else
          out += text.substr(i, c.length);
    }
    i += c.length;
  }
  return out + '"';
}

std::string place(Span s) {
  Position begin, end;
  if (s) {
    begin = position_at(*s.source, s.begin);
    end = position_at(*s.source, s.end);
  }
  return fmt::format(R"("file":{},"line":{},"column":{},"end_line":{},"end_column":{})",
                     quoted(s ? s.source->name : std::string()), begin.line, begin.column, end.line,
                     end.column);
}

}  // namespace

std::string render(const Diagnostic& d, bool colour) { return Renderer(d, colour).run(); }

std::string render(const Diagnostics& d, bool colour) {
  std::string out;
  for (const Diagnostic& one : d.all()) {
    if (!out.empty()) out += '\n';
    out += render(one, colour);
  }
  return out;
}

// The tables and `place` and `render_json` say the same, which diagnostics_test.cpp checks.

constexpr JsonMember kMembers[] = {
    {"code", "`E0203`; codes are never reused"},
    {"name", "the code in words"},
    {"severity", "`error` or `warning`"},
    {"warning", "a warning's name in `-W`; empty for what is always an error"},
    {"message", "the sentence"},
    {"file", "as it was named; empty for what has no place"},
    {"line", "from 1; 0 for what has no place, and so the next three"},
    {"column", "from 1, in characters"},
    {"end_line", "where it ends: the first character after it"},
    {"end_column", "likewise"},
    {"label", "what stands beside the carets; may be empty"},
    {"notes", "other places: objects of the second table"},
    {"helps", "what to try: strings"},
};
constexpr JsonMember kNoteMembers[] = {
    {"file", "these five as above"},
    {"line", ""},
    {"column", ""},
    {"end_line", ""},
    {"end_column", ""},
    {"text", "what is there"},
};

std::span<const JsonMember> json_members() { return kMembers; }
std::span<const JsonMember> json_note_members() { return kNoteMembers; }

std::string render_json(const Diagnostic& d) {
  const DiagInfo& row = info(d.id);
  std::string notes, helps;
  for (const Note& n : d.notes)
    notes += fmt::format("{}{{{},\"text\":{}}}", notes.empty() ? "" : ",", place(n.span),
                         quoted(n.text));
  for (const std::string& h : d.helps)
    helps += fmt::format("{}{}", helps.empty() ? "" : ",", quoted(h));
  return fmt::format(
      R"({{"code":"{}","name":"{}","severity":"{}","warning":"{}","message":{},{},"label":{},)"
      R"("notes":[{}],"helps":[{}]}})",
      row.code, row.name, word(d.severity), row.flag, quoted(d.text), place(d.span),
      quoted(d.label), notes, helps);
}

}  // namespace mms::lang
