// SPDX-License-Identifier: Apache-2.0
#pragma once

/// \file
/// Pages of the manual as HTML.

#include <string>
#include <string_view>

namespace mms::tools {

/// The Markdown of our own pages (headings, paragraphs, fenced and indented code, tables, lists,
/// code, bold, links) as one page that needs nothing else: styles and the search box are inside.
/// A paragraph that is a signature in backticks becomes an entry of the index.
std::string html_page(std::string_view markdown);

}  // namespace mms::tools
