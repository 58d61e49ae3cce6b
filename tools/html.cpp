// SPDX-License-Identifier: Apache-2.0
#include "tools/html.h"

#include <cctype>
#include <map>
#include <vector>

#include <fmt/format.h>

namespace mms::tools {

namespace {

constexpr std::string_view kStyle = R"css(
:root { color-scheme: light dark; --line: #8884; --code: #8881; }
body { margin: 0; font: 16px/1.5 system-ui, sans-serif; display: flex; }
nav { width: 17rem; height: 100vh; position: sticky; top: 0; overflow: auto; padding: 1rem;
  box-sizing: border-box; border-right: 1px solid var(--line); flex: none; }
nav input { width: 100%; box-sizing: border-box; font: inherit; padding: .3rem; }
nav a { display: block; color: inherit; text-decoration: none; overflow: hidden;
  text-overflow: ellipsis; white-space: nowrap; }
nav a.part { font-weight: bold; margin-top: .6rem; }
main { padding: 1rem 2rem; max-width: 52rem; min-width: 0; }
code, pre { font: .9em ui-monospace, monospace; background: var(--code); border-radius: 3px; }
code { padding: 0 .2em; } pre { padding: .6em; overflow: auto; } pre code { background: none;
  padding: 0; }
h3 code { font-size: 1em; } table { border-collapse: collapse; display: block; overflow: auto; }
td, th { border: 1px solid var(--line); padding: .2em .5em; text-align: left; vertical-align: top; }
[hidden] { display: none !important; }
@media (max-width: 45rem) { body { display: block; } nav { position: static; width: auto;
  height: auto; max-height: 40vh; border: 0; } }
)css";

constexpr std::string_view kScript = R"js(
const box = document.querySelector('nav input');
const parts = [...document.querySelectorAll('main section')];
const links = new Map([...document.querySelectorAll('nav a')].map(a => [a.hash.slice(1), a]));
box.addEventListener('input', () => {
  const words = box.value.toLowerCase().split(/\s+/).filter(w => w);
  for (const part of parts) {
    const text = part.textContent.toLowerCase();
    part.hidden = !words.every(w => text.includes(w));
    const link = links.get(part.id);
    if (link) link.hidden = part.hidden;
  }
});
)js";

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string inlines(std::string_view text);

/// `[text](address)` at the start of `text`, and how long it is; 0 where it is none. Our own pages
/// link to each other as they are: `x.md` becomes `x.html`; other schemes than http are refused.
std::size_t link(std::string_view text, std::string& out) {
  const std::size_t middle = text.find("](");
  const std::size_t end = middle == text.npos ? text.npos : text.find(')', middle);
  if (end == text.npos || text.substr(1, middle - 1).find('[') != text.npos) return 0;
  std::string address(text.substr(middle + 2, end - middle - 2));
  const bool web = address.starts_with("https://") || address.starts_with("http://");
  if (!web && address.find(':') != address.npos) return 0;
  const std::size_t suffix = address.find(".md");
  if (!web && suffix != address.npos) address.replace(suffix, 3, ".html");
  out +=
      fmt::format("<a href=\"{}\">{}</a>", escaped(address), inlines(text.substr(1, middle - 1)));
  return end + 1;
}

/// `![text](address)` at the start of `text`, a picture in a folder beside the page, and how long
/// it is; 0 where it is none.
std::size_t picture(std::string_view text, std::string& out) {
  const std::size_t middle = text.find("](");
  const std::size_t end = middle == text.npos ? text.npos : text.find(')', middle);
  if (!text.starts_with("![") || end == text.npos) return 0;
  const std::string_view address = text.substr(middle + 2, end - middle - 2);
  if (address.find(':') != address.npos || address.starts_with('/')) return 0;
  out += fmt::format("<img src=\"{}\" alt=\"{}\" loading=\"lazy\">", escaped(address),
                     escaped(text.substr(2, middle - 2)));
  return end + 1;
}

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

/// Code, bold, emphasis, pictures and links of a line.
std::string inlines(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::string_view rest = text.substr(i);
    const bool code = rest[0] == '`', bold = rest.starts_with("**");
    const bool emphasis = !bold && rest.size() > 1 && rest[0] == '*' && is_word(rest[1]);
    const std::size_t mark = bold ? 2 : 1;
    const std::size_t end = code || emphasis ? rest.find(rest[0], 1)
                            : bold           ? rest.find("**", 2)
                                             : rest.npos;
    if (end != rest.npos) {
      const std::string_view inside = rest.substr(mark, end - mark);
      const char* tag = code ? "code" : bold ? "strong" : "em";
      out += fmt::format("<{0}>{1}</{0}>", tag, code ? escaped(inside) : inlines(inside));
      i += end + mark;
      continue;
    }
    if (const std::size_t length = picture(rest, out)) {
      i += length;
      continue;
    }
    if (rest[0] == '[')
      if (const std::size_t length = link(rest, out)) {
        i += length;
        continue;
      }
    const bool escape = rest[0] == '\\' && rest.size() > 1 && rest[1] == '|';
    out += escaped(rest.substr(escape, 1));
    i += escape ? 2 : 1;
  }
  return out;
}

/// A signature's name; other headings as they are.
std::string_view short_name(std::string_view heading) {
  const std::size_t end = heading.find('(');
  if (end == 0 || end == heading.npos || heading[end - 1] == ' ') return heading;
  return heading.substr(heading.rfind(' ', end) + 1, end - heading.rfind(' ', end) - 1);
}

/// Turns lines into HTML, block by block.
class Page {
 public:
  explicit Page(std::string_view markdown) {
    while (!markdown.empty()) {
      const std::size_t end = std::min(markdown.find('\n'), markdown.size());
      lines_.push_back(markdown.substr(0, end));
      markdown.remove_prefix(std::min(end + 1, markdown.size()));
    }
    while (at_ < lines_.size()) block();
    end_section();
  }

  std::string title, index, body;

 private:
  void block() {
    const std::string_view line = lines_[at_];
    if (line.empty() || line.starts_with("<!--"))
      ++at_;
    else if (line.starts_with("#"))
      heading(line);
    else if (line.starts_with("```"))
      fenced();
    else if (line.starts_with("    "))
      indented();
    else if (line.starts_with("|"))
      table();
    else if (line.starts_with("- "))
      list();
    else
      paragraph();
  }

  /// A name that no other part has, of letters, digits and dashes: as links to headings have it.
  std::string id_of(std::string_view text) {
    std::string id;
    for (const char c : text) {
      if (is_word(c))
        id += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      else if (c == ' ' || c == '-')
        id += '-';
    }
    const int count = ids_[id]++;
    return count ? fmt::format("{}-{}", id, count) : id;
  }

  void end_section() {
    if (open_) body += "</section>\n";
    open_ = false;
  }
  /// Begins a part that the search box shows or hides as one.
  void section(int level, std::string_view name, const std::string& text) {
    end_section();
    const std::string id = id_of(name);
    body += fmt::format("<section id=\"{0}\">\n<h{1}>{2}</h{1}>\n", id, level, text);
    index +=
        fmt::format("<a{} href=\"#{}\" title=\"{}\">{}</a>\n", level == 2 ? " class=\"part\"" : "",
                    id, escaped(name), escaped(short_name(name)));
    open_ = true;
  }

  void heading(std::string_view line) {
    const std::size_t level = line.find_first_not_of('#');
    const std::string_view text = line.substr(level + 1);
    ++at_;
    if (level == 1) {
      title = text;
      body += fmt::format("<h1>{}</h1>\n", inlines(text));
    } else {
      section(static_cast<int>(level), text, inlines(text));
    }
  }

  void fenced() {
    body += "<pre><code>";
    for (++at_; at_ < lines_.size() && !lines_[at_].starts_with("```"); ++at_)
      body += escaped(lines_[at_]) + "\n";
    ++at_;
    body += "</code></pre>\n";
  }

  void indented() {
    body += "<pre><code>";
    for (; at_ < lines_.size() && lines_[at_].starts_with("    "); ++at_)
      body += escaped(lines_[at_].substr(4)) + "\n";
    body += "</code></pre>\n";
  }

  /// Cells between bars; a bar after a backslash or in code is none.
  static std::vector<std::string_view> cells(std::string_view line) {
    std::vector<std::string_view> all;
    std::size_t begin = 1;
    for (std::size_t i = 1; i < line.size(); ++i) {
      if (line[i] != '|' || line[i - 1] == '\\') continue;
      all.push_back(line.substr(begin, i - begin));
      begin = i + 1;
    }
    return all;
  }

  void row(const char* tag) {
    body += "<tr>";
    for (const std::string_view cell : cells(lines_[at_++]))
      body += fmt::format("<{0}>{1}</{0}>", tag, inlines(cell));
    body += "</tr>\n";
  }

  void table() {
    body += "<table>\n";
    const bool headed = at_ + 1 < lines_.size() && lines_[at_ + 1].starts_with("|-");
    if (headed) {
      row("th");
      ++at_;
    }
    while (at_ < lines_.size() && lines_[at_].starts_with("|")) row("td");
    body += "</table>\n";
  }

  /// Lines up to an empty one, or one that begins another block.
  std::string joined(std::size_t skip) {
    std::string text(lines_[at_++].substr(skip));
    for (; at_ < lines_.size(); ++at_) {
      const std::string_view line = lines_[at_];
      const bool other = line.empty() || line.starts_with("- ") || line.starts_with("```") ||
                         line.starts_with("|") || line.starts_with("#");
      if (other) break;
      text += '\n';
      text += line.substr(std::min(line.find_first_not_of(' '), line.size()));
    }
    return text;
  }

  void list() {
    body += "<ul>\n";
    while (at_ < lines_.size() && lines_[at_].starts_with("- "))
      body += fmt::format("<li>{}</li>\n", inlines(joined(2)));
    body += "</ul>\n";
  }

  void paragraph() {
    const std::string text = joined(0);
    const bool signature =
        text.size() > 2 && text[0] == '`' && text.find('`', 1) + 1 == text.size();
    if (signature)
      section(3, std::string_view(text).substr(1, text.size() - 2), inlines(text));
    else
      body += fmt::format("<p>{}</p>\n", inlines(text));
  }

  std::vector<std::string_view> lines_;
  std::size_t at_ = 0;
  std::map<std::string, int> ids_;
  bool open_ = false;
};

}  // namespace

std::string html_page(std::string_view markdown) {
  const Page page(markdown);
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width\">\n<title>{}</title>\n"
      "<style>{}</style>\n</head>\n<body>\n<nav>\n"
      "<input type=\"search\" placeholder=\"Search\" aria-label=\"Search\">\n{}</nav>\n"
      "<main>\n{}</main>\n<script>{}</script>\n</body>\n</html>\n",
      escaped(page.title), kStyle, page.index, page.body, kScript);
}

}  // namespace mms::tools
