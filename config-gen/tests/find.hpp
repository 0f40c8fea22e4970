// Rows of a model by name, for tests; a missing one ends the test program with its name.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "config-gen/model/model.hpp"

namespace flexrf::config_gen::tests {

template <typename Rows>
std::size_t index_of(const Rows& rows, std::string_view name) {
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].name == name) return i;
  std::fprintf(stderr, "there is no '%.*s'\n", static_cast<int>(name.size()), name.data());
  std::abort();
}

template <typename Rows>
const auto& named(const Rows& rows, std::string_view name) {
  return rows[index_of(rows, name)];
}

template <typename Rows>
bool has(const Rows& rows, std::string_view name) {
  for (const auto& row : rows)
    if (row.name == name) return true;
  return false;
}

}  // namespace flexrf::config_gen::tests
