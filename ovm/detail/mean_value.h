/// \file
/// What an element that comes to be amid others takes over from them.
#pragma once

#include <algorithm>
#include <concepts>
#include <type_traits>
#include <vector>

#include <Eigen/Core>

namespace hexweft::detail {

/// Numbers, and Eigen's vectors and matrices of them.
template <class T>
concept Numeric =
    std::is_arithmetic_v<T> || std::is_enum_v<T> || std::derived_from<T, Eigen::PlainObjectBase<T>>;

template <Numeric T>
struct ScalarOf {
  using type = T;
};
template <Numeric T>
requires std::is_class_v<T>
struct ScalarOf<T> {
  using type = typename T::Scalar;
};

/// The mean of reals; of what is counted or named the value that all have, else `otherwise`, and so
/// where rows differ in length.
/// \param values  at least one
template <Numeric T>
T mean_value(const std::vector<T>& values, const T& otherwise) {
  if constexpr (std::is_class_v<T>) {
    const auto alike = [&](const T& x) {
      return x.rows() == values[0].rows() && x.cols() == values[0].cols();
    };
    if (!std::all_of(values.begin(), values.end(), alike)) return otherwise;
  }
  using Scalar = typename ScalarOf<T>::type;
  if constexpr (std::is_floating_point_v<Scalar>) {
    T sum = values[0];
    for (std::size_t i = 1; i < values.size(); ++i) sum += values[i];
    return sum / static_cast<Scalar>(values.size());
  } else {
    const bool same =
        std::all_of(values.begin(), values.end(), [&](const T& x) { return x == values[0]; });
    return same ? values[0] : otherwise;
  }
}

}  // namespace hexweft::detail
