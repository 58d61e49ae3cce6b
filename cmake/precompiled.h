// SPDX-License-Identifier: Apache-2.0
// What most files include, compiled once where MMS_PRECOMPILE says so.
#pragma once

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <deque>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#ifdef FMT_SHARED  // of what links fmt
#include <fmt/format.h>
#endif
#ifdef DOCTEST_CONFIG_SUPER_FAST_ASSERTS  // of tests
#include <doctest/doctest.h>
#endif
