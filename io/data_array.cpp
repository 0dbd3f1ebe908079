#include "io/data_array.h"

#include <algorithm>
#include <limits>
#include <type_traits>

namespace hexweft::detail {
namespace {

template <class Tag, class T, class RowValue>
void fill_property(HexMesh& mesh, const DataArray& array, T default_value, RowValue row_value) {
  if (property_registry<Tag>(mesh)->find(array.name)) {
    throw InputError("the mesh already has a property \"" + array.name + "\"");
  }
  auto property = named_property<Tag, T>(mesh, array.name, std::move(default_value));
  for (int i = 0; i < property.size(); ++i) property[Handle<Tag>(i)] = row_value(i);
}

template <class Tag>
void add_real_property(HexMesh& mesh, const DataArray& array, const std::vector<double>& reals) {
  const int k = array.components;
  if (k == 1) {
    fill_property<Tag>(mesh, array, 0.0, [&](int i) { return reals[i]; });
  } else if (k == 3) {
    fill_property<Tag>(mesh, array, Eigen::Vector3d(0, 0, 0),
                       [&](int i) { return Eigen::Vector3d(&reals[3 * std::size_t(i)]); });
  } else {
    fill_property<Tag>(mesh, array, Eigen::VectorXd(Eigen::VectorXd::Zero(k)), [&](int i) {
      return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(&reals[std::size_t(i) * k], k));
    });
  }
}

template <class T>
struct Row {  // one number a place
  static constexpr ValueKind kind =
      std::is_same_v<T, bool> ? ValueKind::bit
                              : (std::is_integral_v<T> ? ValueKind::integer : ValueKind::real);
  static int size(const T&) { return 1; }
  static void append(DataArray& array, const T& value) {
    if constexpr (kind == ValueKind::real) {
      array.reals.push_back(value);
    } else {
      array.integers.push_back(value);
    }
  }
};

template <class Scalar, int n>
struct Row<Eigen::Matrix<Scalar, n, 1>> {
  using Vector = Eigen::Matrix<Scalar, n, 1>;
  static constexpr ValueKind kind = Row<Scalar>::kind;
  static int size(const Vector& value) { return static_cast<int>(value.size()); }
  static void append(DataArray& array, const Vector& value) {
    for (Scalar x : value) Row<Scalar>::append(array, x);
  }
};

enum class Fit { other_type, uneven, good };

// Copies the values of live elements if the storage holds values of type T.
template <class T, class Handles>
Fit copy_values(const PropertyStorageBase& storage, const Handles& handles, DataArray& array) {
  const auto* typed = dynamic_cast<const PropertyStorage<T>*>(&storage);
  if (!typed) return Fit::other_type;
  array.kind = Row<T>::kind;
  array.components = 0;
  for (auto h : handles) {
    const T& value = typed->values()[h.idx];
    const int size = Row<T>::size(value);
    if (size == 0 || (array.components != 0 && size != array.components)) return Fit::uneven;
    array.components = size;
    Row<T>::append(array, value);
  }
  return Fit::good;
}

template <class... T, class Handles>
Fit copy_values_of_any(const PropertyStorageBase& storage, const Handles& handles,
                       DataArray& array) {
  Fit fit = Fit::other_type;
  ((fit = fit == Fit::other_type ? copy_values<T>(storage, handles, array) : fit), ...);
  return fit;
}

bool are_within(const DataArray& array, std::int64_t least, std::int64_t most) {
  return std::all_of(array.integers.begin(), array.integers.end(),
                     [&](std::int64_t value) { return value >= least && value <= most; });
}

auto live_handles(const HexMesh& mesh, VertexTag*) { return mesh.vertices(); }
auto live_handles(const HexMesh& mesh, CellTag*) { return mesh.cells(); }

}  // namespace

bool fits_int(const DataArray& array) {
  using Limits = std::numeric_limits<int>;
  return are_within(array, Limits::min(), Limits::max());
}

bool fits_double(const DataArray& array) {
  constexpr std::int64_t kMost = std::int64_t{1} << std::numeric_limits<double>::digits;
  return are_within(array, -kMost, kMost);
}

template <class Tag>
void add_property(HexMesh& mesh, const DataArray& array, std::vector<std::string>& notes) {
  const auto& integers = array.integers;
  const int k = array.components;
  if (array.kind == ValueKind::real) {
    add_real_property<Tag>(mesh, array, array.reals);
  } else if (array.kind == ValueKind::bit && k == 1) {
    fill_property<Tag>(mesh, array, false, [&](int i) { return integers[i] != 0; });
  } else if (fits_int(array)) {
    if (k == 1) {
      fill_property<Tag>(mesh, array, 0, [&](int i) { return static_cast<int>(integers[i]); });
    } else {
      fill_property<Tag>(mesh, array, Eigen::VectorXi(Eigen::VectorXi::Zero(k)), [&](int i) {
        Eigen::VectorXi row(k);
        for (int j = 0; j < k; ++j) row[j] = static_cast<int>(integers[std::size_t(i) * k + j]);
        return row;
      });
    }
  } else if (k == 1) {
    fill_property<Tag>(mesh, array, std::int64_t{0}, [&](int i) { return integers[i]; });
  } else {
    if (!fits_double(array)) {
      notes.push_back("data array \"" + array.name +
                      "\" has several integers a place, which became reals: those beyond 2^53 are "
                      "rounded");
    }
    add_real_property<Tag>(mesh, array, std::vector<double>(integers.begin(), integers.end()));
  }
}

template <class Tag>
std::vector<DataArray> property_arrays(const HexMesh& mesh, std::vector<std::string>& notes) {
  std::vector<DataArray> result;
  const auto handles = live_handles(mesh, static_cast<Tag*>(nullptr));
  for (const auto& storage : property_registry<Tag>(mesh)->named()) {
    DataArray array;
    array.name = storage->name();
    const Fit fit =
        copy_values_of_any<bool, int, std::int64_t, float, double, Eigen::Vector2d, Eigen::Vector3d,
                           Eigen::Vector3i, Eigen::VectorXd, Eigen::VectorXi>(*storage, handles,
                                                                              array);
    if (fit == Fit::good) {
      array.components = std::max(array.components, 1);
      result.push_back(std::move(array));
    } else {
      notes.push_back(left_out(storage->name(), fit == Fit::uneven ? "its rows differ in length"
                                                                   : "no file holds its type"));
    }
  }
  return result;
}

std::vector<DataArray>::iterator find_integers(std::vector<DataArray>& arrays,
                                               std::string_view name) {
  return std::find_if(arrays.begin(), arrays.end(), [&](const DataArray& array) {
    return array.name == name && array.kind == ValueKind::integer && array.components == 1;
  });
}

std::string left_out(const std::string& property, const std::string& reason) {
  return "property \"" + property + "\" was left out: " + reason;
}

template void add_property<VertexTag>(HexMesh&, const DataArray&, std::vector<std::string>&);
template void add_property<CellTag>(HexMesh&, const DataArray&, std::vector<std::string>&);
template std::vector<DataArray> property_arrays<VertexTag>(const HexMesh&,
                                                           std::vector<std::string>&);
template std::vector<DataArray> property_arrays<CellTag>(const HexMesh&, std::vector<std::string>&);

}  // namespace hexweft::detail
