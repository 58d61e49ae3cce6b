// SPDX-License-Identifier: Apache-2.0
#include "vm/serialise.h"

#include <array>
#include <bit>
#include <concepts>
#include <cstring>
#include <utility>

#include "vm/stored_names.h"
#include "vm/verify.h"

namespace mms::vm {
namespace {

constexpr std::size_t kFormatAt = 8, kChecksumAt = 12, kLengthAt = 16;

constexpr std::array<std::uint32_t, 256> kCrcTable = [] {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t k = 0; k < 256; ++k) {
    std::uint32_t crc = k;
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0x82f63b78u : 0);
    table[k] = crc;
  }
  return table;
}();

template <std::unsigned_integral T>
void put(std::span<std::byte> to, T value) {
  for (std::size_t k = 0; k < sizeof(T); ++k) to[k] = std::byte(value >> (8 * k) & 0xff);
}
template <std::unsigned_integral T>
T get(std::span<const std::byte> from) {
  T value = 0;
  for (std::size_t k = 0; k < sizeof(T); ++k)
    value = static_cast<T>(value | static_cast<T>(std::to_integer<T>(from[k]) << (8 * k)));
  return value;
}

/// A struct with a row in stored_form.h.
template <class T, class V>
concept HasFields = requires(T& t, V& v) {
  fields(v, t);
};

class Writer {
 public:
  std::vector<std::byte> bytes = std::vector<std::byte>(kHeaderBytes);

  template <class T>
  void operator()(const char*, T& value, const char*) {
    write(value);
  }

 private:
  template <std::unsigned_integral T>
  void number(T value) {
    bytes.resize(bytes.size() + sizeof(T));
    put(std::span(bytes).last(sizeof(T)), value);
  }
  void write(std::uint32_t v) { number(v); }
  void write(std::int32_t v) { number(std::uint32_t(v)); }
  void write(float v) { number(std::bit_cast<std::uint32_t>(v)); }
  void write(double v) { number(std::bit_cast<std::uint64_t>(v)); }
  void write(bool v) { number(std::uint8_t(v)); }
  void write(Op v) { number(static_cast<std::uint8_t>(v)); }
  void write(DescriptorForm v) { number(static_cast<std::uint8_t>(v)); }
  void write(SlotType v) { number(std::uint8_t(letter(v))); }
  void write(std::string& v) {
    number(std::uint32_t(v.size()));
    const auto* data = reinterpret_cast<const std::byte*>(v.data());
    bytes.insert(bytes.end(), data, data + v.size());
  }
  template <class T, std::size_t N>
  void write(T (&v)[N]) {
    for (T& x : v) write(x);
  }
  template <class T>
  void write(std::vector<T>& v) {
    number(std::uint32_t(v.size()));
    for (T& x : v) write(x);
  }
  template <class T>
  void write(std::optional<T>& v) {
    write(v.has_value());
    if (v) write(*v);
  }
  void write(std::pair<double, double>& v) {
    write(v.first);
    write(v.second);
  }
  template <HasFields<Writer> T>
  void write(T& v) {
    fields(*this, v);
  }
};

/// Reads to the first error; what comes after it is left as it is made.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> file) : file_(file), at_(kHeaderBytes) {}

  template <class T>
  void operator()(const char*, T& value, const char*) {
    read(value);
  }

  std::optional<Error> finish() {
    if (!error_ && at_ != file_.size()) fail("there is more than a program");
    return error_;
  }

 private:
  void fail(const char* what) {
    if (!error_) error_ = Error{"byte " + std::to_string(at_), what, "compile the script again"};
  }
  bool has(std::size_t bytes) {
    if (!error_ && file_.size() - at_ < bytes) fail("something is cut off");
    return !error_;
  }
  template <std::unsigned_integral T>
  T number() {
    if (!has(sizeof(T))) return 0;
    const T value = get<T>(file_.subspan(at_, sizeof(T)));
    at_ += sizeof(T);
    return value;
  }
  /// A count, each of which takes at least one byte of what is left.
  std::uint32_t count() {
    const auto n = number<std::uint32_t>();
    if (!error_ && n > file_.size() - at_) fail("a count is larger than the file");
    return error_ ? 0 : n;
  }

  void read(std::uint32_t& v) { v = number<std::uint32_t>(); }
  void read(std::int32_t& v) { v = std::int32_t(number<std::uint32_t>()); }
  void read(float& v) { v = std::bit_cast<float>(number<std::uint32_t>()); }
  void read(double& v) { v = std::bit_cast<double>(number<std::uint64_t>()); }
  void read(bool& v) {
    const auto byte = number<std::uint8_t>();
    if (byte > 1) fail("neither yes nor no");
    v = byte == 1;
  }
  void read(Op& v) { v = static_cast<Op>(number<std::uint8_t>()); }
  void read(DescriptorForm& v) {
    const auto byte = number<std::uint8_t>();
    if (byte > 1) fail("neither surface nor volume");
    v = byte == 1 ? DescriptorForm::Volume : DescriptorForm::Surface;
  }
  void read(SlotType& v) {
    const char c = char(number<std::uint8_t>());
    for (const SlotType t :
         {SlotType::Real, SlotType::Integer, SlotType::Logic, SlotType::Spectrum})
      if (letter(t) == c) return void(v = t);
    fail("there is no such type");
  }
  void read(std::string& v) {
    const std::uint32_t n = count();
    if (!has(n)) return;
    v.assign(reinterpret_cast<const char*>(file_.data() + at_), n);
    at_ += n;
  }
  template <class T, std::size_t N>
  void read(T (&v)[N]) {
    for (T& x : v) read(x);
  }
  template <class T>
  void read(std::vector<T>& v) {
    for (std::uint32_t n = count(); n > 0 && !error_; --n) read(v.emplace_back());
  }
  template <class T>
  void read(std::optional<T>& v) {
    bool there = false;
    read(there);
    if (there) read(v.emplace());
  }
  void read(std::pair<double, double>& v) {
    read(v.first);
    read(v.second);
  }
  template <HasFields<Reader> T>
  void read(T& v) {
    fields(*this, v);
  }

  std::span<const std::byte> file_;
  std::size_t at_;
  std::optional<Error> error_;
};

Error refuse(const char* where, std::string what, const char* hint = "compile the script again") {
  return {where, std::move(what), hint};
}

/// Why a file is not even read.
std::optional<Error> check_header(std::span<const std::byte> file) {
  if (file.size() > kFileBytes)
    return refuse("", "is larger than " + std::to_string(kFileBytes) + " bytes",
                  "is it a compiled program at all?");
  const std::string_view start(reinterpret_cast<const char*>(file.data()), file.size());
  if (!is_stored(start))
    return refuse("byte 0", "is no compiled program", "`mms compile -o FILE` makes one");
  if (file.size() < kHeaderBytes) return refuse("byte 8", "is cut off in its header");
  const auto format = get<std::uint32_t>(file.subspan(kFormatAt, 4));
  if (format != kFormat)
    return refuse("byte 8",
                  "has format " + std::to_string(format) + "; this build reads format " +
                      std::to_string(kFormat),
                  "compile the script with this version of mms");
  const auto length = get<std::uint64_t>(file.subspan(kLengthAt, 8));
  if (length != file.size())
    return refuse("byte 16", "is " + std::to_string(file.size()) +
                                 " bytes long and says that it is " + std::to_string(length));
  if (get<std::uint32_t>(file.subspan(kChecksumAt, 4)) != checksum(file))
    return refuse("byte 12", "is damaged: its checksum is another");
  return std::nullopt;
}

}  // namespace

bool is_stored(std::string_view start) { return start.starts_with(kMagic); }

std::uint32_t checksum(std::span<const std::byte> file) {
  std::uint32_t crc = ~0u;
  for (const std::byte b : file.subspan(kHeaderBytes))
    crc = crc >> 8 ^ kCrcTable[(crc ^ std::to_integer<std::uint32_t>(b)) & 0xff];
  return ~crc;
}

void seal(std::span<std::byte> file) {
  put(file.subspan(kLengthAt), std::uint64_t(file.size()));
  put(file.subspan(kChecksumAt), checksum(file));
}

std::vector<std::byte> save(const Package& package, std::span<const Builtin> library) {
  StoredForm form = name_all(package, library);
  Writer writer;
  fields(writer, form);
  std::memcpy(writer.bytes.data(), kMagic.data(), kMagic.size());
  put(std::span(writer.bytes).subspan(kFormatAt), kFormat);
  seal(writer.bytes);
  return std::move(writer.bytes);
}

Result<Package> load(std::span<const std::byte> file, std::span<const Builtin> library) {
  if (auto error = check_header(file)) return *std::move(error);
  StoredForm form;
  Reader reader(file);
  fields(reader, form);
  if (auto error = reader.finish()) return *std::move(error);
  if (auto error = number_all(form, library)) return *std::move(error);
  if (const auto fault = verify(form.package.program))
    return refuse("", "would not run safely: " + fault->what + " (" + fault->function + ", " +
                          std::to_string(fault->instruction) + ")");
  return std::move(form.package);
}

}  // namespace mms::vm
