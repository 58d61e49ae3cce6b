// SPDX-License-Identifier: Apache-2.0
#include "vm/signature.h"

#include <charconv>

#include "vm/limits.h"

namespace mms::vm {
namespace {

constexpr std::string_view kSpace = " \t\n";

std::string_view trim(std::string_view s) {
  const std::size_t begin = s.find_first_not_of(kSpace);
  if (begin == s.npos) return {};
  return s.substr(begin, s.find_last_not_of(kSpace) - begin + 1);
}

/// A basic type, how many of them, and how that is written.
struct Type {
  std::string_view basic;
  int count = 1;
  std::string spelling;
};

constexpr std::string_view kBasic[] = {"real",    "integer",  "logic",
                                       "complex", "spectrum", "material"};

/// Takes `[2,3]` off the front of `rest`: the product of the sizes, 1 if there is none, 0 if it is
/// malformed.
int take_sizes(std::string_view& rest) {
  if (!rest.starts_with('[')) return 1;
  int product = 1;
  while (!rest.starts_with(']')) {
    rest = trim(rest.substr(1));
    int size = 0;
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), size);
    if (error != std::errc() || size < 1 || size > limits::kAggregate / product) return 0;
    product *= size;
    rest = trim(rest.substr(std::size_t(end - rest.data())));
    if (!rest.starts_with(',') && !rest.starts_with(']')) return 0;
  }
  rest.remove_prefix(1);
  return product;
}

/// Takes a type off the front of `rest`, if it starts with one. A malformed one has count 0.
std::optional<Type> take_type(std::string_view& rest) {
  for (const std::string_view basic : kBasic) {
    if (!rest.starts_with(basic)) continue;
    const std::string_view after = trim(rest.substr(basic.size()));
    const bool word_ends = rest.size() == basic.size() || rest[basic.size()] == '[' ||
                           kSpace.find(rest[basic.size()]) != kSpace.npos;
    if (!word_ends) continue;
    Type type{basic, 1, {}};
    std::string_view left = after;
    type.count = take_sizes(left);
    type.spelling = basic;
    for (const char c : after.substr(0, after.size() - left.size()))
      if (kSpace.find(c) == kSpace.npos) type.spelling += c;
    rest = trim(left);
    return type;
  }
  return std::nullopt;
}

/// Takes what stands before the next comma that is in no brackets.
std::string_view take_item(std::string_view& rest) {
  int depth = 0;
  std::size_t end = 0;
  for (; end < rest.size() && (rest[end] != ',' || depth > 0); ++end)
    depth += rest[end] == '(' || rest[end] == '['   ? 1
             : rest[end] == ')' || rest[end] == ']' ? -1
                                                    : 0;
  const std::string_view item = rest.substr(0, end);
  rest = end < rest.size() ? rest.substr(end + 1) : std::string_view{};
  return trim(item);
}

void add_slots(std::vector<SlotType>& slots, const Type& type) {
  const SlotType slot = type.basic == "integer"    ? SlotType::Integer
                        : type.basic == "logic"    ? SlotType::Logic
                        : type.basic == "spectrum" ? SlotType::Spectrum
                                                   : SlotType::Real;
  const int each = type.basic == "complex" ? 2 : 1;
  slots.insert(slots.end(), std::size_t(each * type.count), slot);
}

}  // namespace

std::optional<Signature> read_signature(std::string_view text) {
  Signature s;
  std::string_view rest = trim(text);
  const std::optional<Type> result = take_type(rest);
  const std::size_t open = rest.find('(');
  if (!result || result->count < 1 || open == rest.npos || !rest.ends_with(')'))
    return std::nullopt;
  if (result->basic != "material") add_slots(s.results, *result);
  s.key = result->spelling + ' ' + std::string(trim(rest.substr(0, open))) + '(';
  rest = rest.substr(open + 1, rest.size() - open - 2);
  std::optional<Type> type;
  for (const char* separator = ""; !trim(rest).empty(); separator = ", ") {
    std::string_view item = take_item(rest);
    if (std::optional<Type> own = take_type(item)) type = std::move(own);
    if (!type || type->count < 1 || item.empty()) return std::nullopt;
    s.key += separator + type->spelling;
    if (type->basic == "material")
      s.materials += type->count;
    else
      add_slots(s.params, *type);
  }
  s.key += ')';
  return s;
}

}  // namespace mms::vm
