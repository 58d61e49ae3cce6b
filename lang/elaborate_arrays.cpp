// SPDX-License-Identifier: Apache-2.0
/// \file
/// Arrays and fields of the elaborator.

#include "lang/elaborator.h"
#include "vm/limits.h"

namespace mms::lang {
namespace {

using vm::Op;

}  // namespace

/// An array of `parts`, widened to the type they share.
Value Elaborator::array_of(std::vector<Value> parts, const std::vector<Span>& spans) {
  TypeId type = parts[0].type;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const TypeId joined = types_.join(type, parts[i].type);
    if (joined == kPoison) {
      if (type != kPoison && !parts[i].poison())
        diagnostics_
            .add(Diag::TypeMismatch, i < spans.size() ? spans[i] : Span{}, types_.spell(type),
                 spell(parts[i]))
            .help("the elements of an array have one type");
      return {};
    }
    type = joined;
  }
  if (type == kPoison) return {};
  Value v;
  v.type = types_.array(type, static_cast<int>(parts.size()));
  for (const Value& p : parts) v.parts.push_back(widen(p, type));
  return v;
}

Value Elaborator::expr_array(Context c, const Expr& e) {
  if (e.args.size() > static_cast<std::size_t>(vm::limits::kAggregate)) {
    diagnostics_.add(Diag::ArraySize, e.span, e.args.size(), vm::limits::kAggregate);
    return {};
  }
  const std::size_t columns = e.args.size() / std::max<std::size_t>(e.rows, 1);
  std::vector<Value> rows;
  std::vector<Span> row_spans;
  for (std::size_t r = 0; r < e.rows; ++r) {
    std::vector<Value> parts;
    std::vector<Span> spans;
    for (std::size_t k = 0; k < columns; ++k) {
      parts.push_back(expr(c, e.args[r * columns + k]));
      spans.push_back((*c.graph)[e.args[r * columns + k]].span);
    }
    rows.push_back(array_of(std::move(parts), spans));
    row_spans.push_back(e.span);
  }
  Value v = e.rows == 1 ? std::move(rows[0]) : array_of(std::move(rows), row_spans);
  if (types_.rank(v.type) > 2) {
    diagnostics_.add(Diag::ArrayRank, e.span);
    return {};
  }
  if (too_large(v.type, e.span)) return {};
  return v;
}

Value Elaborator::index(const Value& array, const Value& i, Span span) {
  if (array.poison() || i.poison()) return {};
  if (!types_.is_array(array.type)) {
    diagnostics_.add(Diag::NotIndexable, span, spell(array));
    return {};
  }
  if (i.type != kInteger) {
    convert(i, kInteger, span);
    return {};
  }
  const std::int64_t size = static_cast<std::int64_t>(array.parts.size());
  if (const auto k = known_integer(i)) {
    if (*k >= 0 && *k < size) return array.parts[static_cast<std::size_t>(*k)];
    diagnostics_.add(Diag::IndexRange, span, *k, size - 1).help("the first element has index 0");
    return {};
  }
  // Known only at run time: a choice; outside the array the nearest end is taken.
  Value v = array.parts.back();
  for (std::int64_t k = size - 2; k >= 0; --k)
    v = choose(node(Op::LeI, {i.refs[0], integer(k)}), array.parts[static_cast<std::size_t>(k)], v,
               span);
  return v;
}

Value Elaborator::expr_index(Context c, const Expr& e) {
  Value v = expr(c, e.args[0]);
  for (std::size_t k = 1; k < e.args.size(); ++k) v = index(v, expr(c, e.args[k]), e.span);
  return v;
}

Value Elaborator::expr_field(Context c, const Expr& e) {
  const Value v = expr(c, e.args[0]);
  if (v.poison()) return {};
  const std::string& name = e.path[0].text;
  if (types_.is_array(v.type)) {
    static constexpr std::string_view kAxes = "xyzw";
    const std::size_t k = name.size() == 1 ? kAxes.find(name[0]) : std::string_view::npos;
    if (k < v.parts.size()) return v.parts[k];
  } else if (types_.is_struct(v.type)) {
    const std::vector<std::string>& members = types_[v.type].members;
    const auto it = std::find(members.begin(), members.end(), name);
    if (it != members.end()) return v.parts[static_cast<std::size_t>(it - members.begin())];
    Diagnostic& d = diagnostics_.add(Diag::NoField, e.path[0].span, spell(v), name);
    const std::string near = nearest(name, members);
    if (!near.empty()) d.help(fmt::format("did you mean `{}`?", near));
    return {};
  }
  if (v.type == kComplex && name == "re") return scalar(kReal, v.refs[0]);
  if (v.type == kComplex && name == "im") return scalar(kReal, v.refs[1]);
  Diagnostic& d = diagnostics_.add(Diag::NoField, e.path[0].span, spell(v), name);
  if (v.type == kComplex) d.help("a complex number has `re` and `im`");
  return {};
}
}  // namespace mms::lang
