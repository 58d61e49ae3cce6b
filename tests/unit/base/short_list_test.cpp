// SPDX-License-Identifier: Apache-2.0
#include "base/short_list.h"

#include <utility>
#include <vector>

#include <doctest/doctest.h>

using mms::ShortList;

namespace {

using List = ShortList<int, 3>;

std::vector<int> counted(int n) {
  std::vector<int> v;
  for (int i = 0; i < n; ++i) v.push_back(i * i);
  return v;
}

}  // namespace

TEST_CASE("a short list holds what a vector does, inside and on the heap") {
  for (int n = 0; n <= 20; ++n) {
    const std::vector<int> expected = counted(n);
    List grown;
    for (int x : expected) grown.push_back(x);
    CHECK(std::vector<int>(grown) == expected);
    CHECK(grown.size() == expected.size());
    CHECK(grown.empty() == (n == 0));
    CHECK(List(expected) == grown);
    const List copy = grown;
    CHECK(copy == grown);
    if (n > 0) {
      grown[0] = 7;
      CHECK(copy[0] == 0);  // its own
      CHECK_FALSE(copy == grown);
      grown.pop_back();
      CHECK(grown.size() == expected.size() - 1);
    }
  }
}

TEST_CASE("a short list is moved and assigned, to itself and between inside and heap") {
  for (int n : {0, 2, 3, 4, 17})
    for (int m : {0, 3, 4}) {
      List from = counted(n), to = counted(m);
      to = from;
      CHECK(std::vector<int>(to) == counted(n));
      to = *&to;
      CHECK(std::vector<int>(to) == counted(n));
      to.push_back(-1);
      CHECK(from.size() == std::size_t(n));
      List taken = std::move(from);
      CHECK(std::vector<int>(taken) == counted(n));
      from = List{1, 2};  // what was moved from can be filled again
      from.push_back(3);
      from.push_back(4);
      CHECK(std::vector<int>(from) == std::vector<int>{1, 2, 3, 4});
    }
}

TEST_CASE("a short list may be given one of its own values") {
  List l{1, 2, 3};
  for (int i = 0; i < 10; ++i) l.push_back(l[0]);
  CHECK(l[12] == 1);
  CHECK(l.size() == 13);
}
