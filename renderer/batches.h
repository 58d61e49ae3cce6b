// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

namespace mms::renderer {

/// Calls `run` with each stretch of neighbours of one key, in order, at most `width` of them at
/// once: what a run of one script can take. \pre `items` are sorted by `key`.
template <class T, class Key, class Run>
void for_each_batch(std::span<T> items, int width, Key key, Run run) {
  for (std::size_t first = 0, last = 0; first < items.size(); first = last) {
    while (last < items.size() && last - first < std::size_t(width) &&
           key(items[last]) == key(items[first]))
      ++last;
    run(items.subspan(first, last - first));
  }
}

}  // namespace mms::renderer
