// Of a field of a scene file: its name and what it means.
#pragma once

#include <initializer_list>
#include <optional>
#include <string_view>
#include <utility>

namespace illum::scenefile {

struct About {
  std::string_view name, meaning;
};

template <typename Enum>
using Choices = std::initializer_list<std::pair<Enum, std::string_view>>;

/// T of both T and std::optional<T>.
template <typename T>
struct ValueOf {
  using type = T;
};
template <typename T>
struct ValueOf<std::optional<T>> {
  using type = T;
};
template <typename T>
using Value = typename ValueOf<T>::type;

}  // namespace illum::scenefile
