// SPDX-License-Identifier: Apache-2.0
#include "materials/curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <vector>

#include "vm/interval.h"

namespace mms::materials {
namespace {

using vm::ImageAsk;
using vm::Interval;

constexpr double kFirstLight = 360e-9, kLastLight = 830e-9;  // what the CIE's observer sees
constexpr std::size_t kMostBytes = 1 << 24;

/// Rows of one table of a file.
struct Table {
  std::vector<std::string> names;
  std::vector<std::vector<double>> rows;
};

class Curve final : public vm::Image {
 public:
  Curve(std::string file, std::vector<double> metres, std::vector<double> values)
      : file_(std::move(file)), metres_(std::move(metres)), values_(std::move(values)) {}

  void look_up(ImageAsk ask, const float* const* in, float* const* out, int lanes) const override {
    run(ask, in[0], out[0], lanes);
  }
  void look_up64(ImageAsk ask, const double* const* in, double* const* out,
                 int lanes) const override {
    run(ask, in[0], out[0], lanes);
  }
  std::optional<double> number(std::string_view name) const override {
    if (name == "height") return double(metres_.size());
    if (name == "width") return 2;
    return name == "bytes" ? std::optional<double>(double(metres_.size()) * 2 * sizeof(double))
                           : std::nullopt;
  }
  void range(double& low, double& high) const override {
    const auto [least, most] = std::minmax_element(values_.begin(), values_.end());
    low = *least;
    high = *most;
  }
  std::vector<std::string> files() const override { return {file_}; }
  bool answers(ImageAsk ask) const override { return vm::argument_count(ask) == 1; }

  /// Extremes are at the ends of the argument, or at rows between them.
  void enclose(ImageAsk ask, const Interval* in, Interval* out) const override {
    Interval r = Interval::empty();
    const auto see = [&](double x) { r = vm::join(r, Interval::point(x)); };
    // The double machine may hold what rounds to a row.
    const double lo = in->lo * (1 - 0x1p-50), hi = in->hi * (1 + 0x1p-50);
    if (in->nan) see(one(ask, std::numeric_limits<double>::quiet_NaN()));
    if (in->has_number()) {
      see(one(ask, lo));
      see(one(ask, hi));
    }
    for (std::size_t k = 0; k < metres_.size(); ++k)
      if (lo <= metres_[k] && metres_[k] <= hi) {
        see(one(ask, metres_[k]));
        if (k > 0 && ask == ImageAsk::CurveSlope) see(slope(k - 1));
      }
    const double slack = 0x1p-48 * r.magnitude();
    *out = {r.lo - slack, r.hi + slack, false};
  }

 private:
  template <class R>
  void run(ImageAsk ask, const R* wavelength, R* out, int lanes) const {
    for (int i = 0; i < lanes; ++i) out[i] = R(one(ask, double(wavelength[i])));
  }

  double slope(std::size_t k) const {
    return (values_[k + 1] - values_[k]) / (metres_[k + 1] - metres_[k]);
  }

  /// The first row's value where the wavelength is no number.
  double one(ImageAsk ask, double wavelength) const {
    const bool before = !(wavelength >= metres_.front());
    const bool behind = wavelength >= metres_.back();
    if (ask == ImageAsk::CurveSlope && (before || behind)) return 0;
    if (before || behind) return before ? values_.front() : values_.back();
    const auto above = std::upper_bound(metres_.begin(), metres_.end(), wavelength);
    const std::size_t k = std::size_t(above - metres_.begin()) - 1;
    if (ask == ImageAsk::CurveSlope) return slope(k);
    const double u = (wavelength - metres_[k]) / (metres_[k + 1] - metres_[k]);
    return values_[k] * (1 - u) + values_[k + 1] * u;
  }

  std::string file_;
  std::vector<double> metres_, values_;  ///< of each row; metres grow
};

/// What `text` has between separators. Where there are semicolons, commas do not separate.
std::vector<std::string_view> fields_of(std::string_view text) {
  const std::string_view gaps = " \t\r", marks = text.find(';') == text.npos ? "," : ";";
  std::vector<std::string_view> fields;
  for (bool after_mark = true; !text.empty();) {
    const char c = text[0];
    if (gaps.find(c) != gaps.npos) {
      text.remove_prefix(1);
    } else if (marks.find(c) != marks.npos) {
      if (after_mark) fields.push_back("");
      after_mark = true;
      text.remove_prefix(1);
    } else {
      const std::size_t end = std::min(text.find_first_of(std::string(gaps) += marks), text.size());
      fields.push_back(text.substr(0, end));
      after_mark = false;
      text.remove_prefix(end);
    }
  }
  return fields;
}

std::optional<double> number_of(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, wrong] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (wrong != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// Whether a line names columns: none of its fields looks like a number.
bool names_columns(const std::vector<std::string_view>& fields) {
  return std::none_of(fields.begin(), fields.end(), [](std::string_view field) {
    return field.empty() || std::string_view("0123456789+-.").find(field[0]) != std::string::npos;
  });
}

std::string without_quotes(std::string_view name) {
  if (name.size() >= 2 && name.front() == '"' && name.back() == '"')
    name = name.substr(1, name.size() - 2);
  return std::string(name);
}

Error broken(const std::string& file, int line, const std::string& what, const char* hint) {
  return {file, fmt::format("is broken: line {}: {}", line, what), hint};
}

/// Takes a row into `table`; an error where it does not fit.
std::optional<Error> take_row(Table& table, const std::vector<std::string_view>& fields,
                              const std::string& file, int line) {
  std::vector<double> row;
  for (const std::string_view field : fields) {
    const auto value = number_of(field);
    if (!value)
      return broken(file, line, fmt::format("`{}` is no number", field),
                    "a row is a wavelength and its values, as in `550, 0.25`; `#` begins a remark");
    row.push_back(*value);
  }
  if (row.size() < 2)
    return broken(file, line, "there is a wavelength, and no value",
                  "a row is a wavelength and its values, as in `550, 0.25`");
  if (!table.rows.empty() && row.size() != table.rows.back().size())
    return broken(
        file, line,
        fmt::format("there are {} numbers, and {} above", row.size(), table.rows.back().size()),
        "every row has the same columns");
  if (!table.rows.empty() && !(row[0] > table.rows.back()[0]))
    return broken(file, line,
                  fmt::format("the wavelength {} comes after {}", row[0], table.rows.back()[0]),
                  "wavelengths grow from row to row");
  table.rows.push_back(std::move(row));
  return std::nullopt;
}

Result<std::vector<Table>> tables_of(std::string_view text, const std::string& file) {
  std::vector<Table> tables(1);
  constexpr std::string_view kByteOrder = "\xef\xbb\xbf";
  if (text.starts_with(kByteOrder)) text.remove_prefix(kByteOrder.size());
  for (int line = 1; !text.empty(); ++line) {
    std::string_view row = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), row.size() + 1));
    row = row.substr(0, std::min(row.find('#'), row.find("//")));
    const auto fields = fields_of(row);
    if (fields.empty()) continue;
    if (names_columns(fields)) {
      if (!tables.back().rows.empty()) tables.emplace_back();
      tables.back().names.clear();
      for (const std::string_view name : fields)
        tables.back().names.push_back(without_quotes(name));
    } else if (auto error = take_row(tables.back(), fields, file, line)) {
      return *error;
    }
  }
  if (tables.back().rows.empty()) tables.pop_back();
  return tables;
}

/// The table and the column of it that `use` names.
Result<std::pair<const Table*, std::size_t>> column_of(const std::vector<Table>& tables,
                                                       const vm::ImageUse& use) {
  using Found = std::pair<const Table*, std::size_t>;
  std::string names;
  for (const Table& table : tables)
    for (std::size_t k = 0; k < table.names.size(); ++k) {
      if (k > 0 && table.names[k] == use.channel && k < table.rows[0].size())
        return Found{&table, k};
      if (k > 0) names += fmt::format("{}`{}`", names.empty() ? "" : ", ", table.names[k]);
    }
  const std::size_t columns = tables[0].rows[0].size();
  const auto place = use.channel.empty() ? 1.0 : number_of(use.channel);
  if (place && *place >= 0 && *place < double(columns) && *place == std::floor(*place))
    return Found{&tables[0], std::size_t(*place)};
  return Error{use.file, fmt::format("has no column `{}`", use.channel),
               fmt::format("there are columns 0 (the wavelengths) to {}{}{}", columns - 1,
                           names.empty() ? "" : ", and these names: ", names)};
}

double metres(std::string_view unit) { return unit == "nm" ? 1e-9 : unit == "um" ? 1e-6 : 1; }

}  // namespace

Result<std::shared_ptr<const vm::Image>> read_curve(std::string_view text,
                                                    const vm::ImageUse& use) {
  const auto tables = tables_of(text, use.file);
  if (!tables) return tables.error();
  if (tables->empty())
    return Error{use.file, "has no rows",
                 "a row is a wavelength and its values, as in `550, 0.25`"};
  const auto found = column_of(*tables, use);
  if (!found) return found.error();
  const auto [table, column] = *found;
  std::vector<double> wavelengths, values;
  for (const std::vector<double>& row : table->rows) {
    wavelengths.push_back(row[0] * metres(use.space));
    values.push_back(row[column]);
  }
  if (wavelengths.back() < kFirstLight || wavelengths.front() > kLastLight)
    return Error{use.file,
                 fmt::format("has no wavelength of light: it goes from {} to {} {}",
                             table->rows.front()[0], table->rows.back()[0], use.space),
                 "`unit` says what its wavelengths are in: \"nm\", \"um\" or \"m\""};
  return std::shared_ptr<const vm::Image>(
      std::make_shared<Curve>(use.file, std::move(wavelengths), std::move(values)));
}

Result<std::shared_ptr<const vm::Image>> open_curve(const vm::ImageUse& use) {
  std::ifstream file(use.file, std::ios::binary);
  if (!file) return Error{use.file, "cannot be read", "look at its permissions"};
  std::string text;
  text.resize(kMostBytes + 1);
  file.read(text.data(), std::streamsize(text.size()));
  text.resize(std::size_t(file.gcount()));
  if (text.size() > kMostBytes)
    return Error{use.file, "is too large for a table: there are more than 16 MiB of it", ""};
  return read_curve(text, use);
}

}  // namespace mms::materials
