// SPDX-License-Identifier: Apache-2.0
// The form of a stored program, as a page.
#include <algorithm>
#include <concepts>

#include "vm/stored_form.h"

namespace mms::vm {
namespace {

/// Makes a table of each struct, in the order in which they are first met.
class Describer {
 public:
  template <class T>
  void operator()(const char* name, T& value, const char* doc) {
    const std::string form = describe(value);
    tables_[current_].rows +=
        "| `" + std::string(name) + "` | " + form + " | " + (*doc ? doc : "-") + " |\n";
  }

  template <HasFields<Describer> T>
  std::string describe(T& value) {
    const std::string name = name_of(value);
    const bool seen =
        std::any_of(tables_.begin(), tables_.end(), [&](const Table& t) { return t.name == name; });
    if (!seen) {
      tables_.push_back({name, {}});
      const std::size_t outer = std::exchange(current_, tables_.size() - 1);
      fields(*this, value);
      current_ = outer;
    }
    return "*" + name + "*";
  }

  std::string text() const {
    std::string all;
    for (const Table& t : tables_)
      all += "\n### " + t.name + "\n\n| Field | Form | Meaning |\n|---|---|---|\n" + t.rows;
    return all;
  }

 private:
  struct Table {
    std::string name, rows;
  };

  std::string describe(std::uint32_t&) { return "u32"; }
  std::string describe(std::int32_t&) { return "i32"; }
  std::string describe(float&) { return "f32"; }
  std::string describe(double&) { return "f64"; }
  std::string describe(bool&) { return "flag"; }
  std::string describe(Op&) { return "u8"; }
  std::string describe(DescriptorForm&) { return "u8"; }
  std::string describe(SlotType&) { return "type"; }
  std::string describe(std::string&) { return "text"; }
  std::string describe(std::pair<double, double>&) { return "two f64"; }
  template <class T, std::size_t N>
  std::string describe(T (&v)[N]) {
    return std::to_string(N) + " x " + describe(v[0]);
  }
  template <class T>
  std::string describe(std::vector<T>&) {
    T one{};
    return "list of " + describe(one);
  }
  template <class T>
  std::string describe(std::optional<T>&) {
    T one{};
    return "optional " + describe(one);
  }

  std::vector<Table> tables_;
  std::size_t current_ = 0;
};

}  // namespace

std::string format_document() {
  Describer describer;
  StoredForm form;
  describer.describe(form);
  return "A compiled program (`mms compile`, `.mmsc`) starts with " + std::to_string(kHeaderBytes) +
         " bytes: 8 of magic (`89 6d 6d 73 0d 0a 1a 0a`), the format number " +
         std::to_string(kFormat) +
         " (u32), the CRC-32C of all that follows these bytes (u32), and the length of the whole "
         "file (u64). One *program* follows, and nothing after it. Integers and IEEE numbers are "
         "little-endian, without padding. A *flag* is a byte, 0 or 1; a *type* one of the letters "
         "above; a *text* its length in bytes (u32) and they; a *list* its length (u32) and its "
         "elements; an *optional* a flag, and if that is 1 the value. Instructions, variables and "
         "rows of the library are called by name, so a file outlives changes of their order; one "
         "that is not there any more is an error that names it. Loading checks all of this and "
         "then verifies the program; a file that fails is refused.\n" +
         describer.text();
}

}  // namespace mms::vm
