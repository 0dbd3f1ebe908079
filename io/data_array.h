/// \file
/// Values on the vertices or cells of a mesh as files hold them, and the mesh properties they
/// become.
///
/// | file                                       | property of the mesh (named)   |
/// |--------------------------------------------|--------------------------------|
/// | bits, one a place                          | bool                           |
/// | integers, one a place                      | int; std::int64_t if any needs it |
/// | integers, several a place                  | Eigen::VectorXi                |
/// | reals, one a place                         | double                         |
/// | reals, three a place                       | Eigen::Vector3d                |
/// | reals, another number a place              | Eigen::VectorXd                |
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "ovm/hex_mesh.h"

namespace hexweft {

enum class ValueKind { bit, integer, real };

/// A named table of numbers, one row (tuple) a vertex or cell.
struct DataArray {
  std::string name;
  int components = 1;  ///< numbers a row, ≥ 1
  ValueKind kind = ValueKind::real;
  std::vector<std::int64_t> integers;  ///< row by row, for bits and integers
  std::vector<double> reals;           ///< row by row, for reals
  std::size_t size() const { return kind == ValueKind::real ? reals.size() : integers.size(); }
};

namespace detail {

/// Whether every value of an array of integers is an int of 32 bits.
bool fits_int(const DataArray& array);
/// Whether every value of an array of integers is within ±2^53, where doubles hold all of them.
bool fits_double(const DataArray& array);

/// Makes a named property of the array; row i belongs to element i.
/// Integers beyond 32 bits with several a place become reals; `notes` tells if these may be rounded.
/// \throws InputError if the mesh has a property of that name
template <class Tag>
void add_property(HexMesh& mesh, const DataArray& array, std::vector<std::string>& notes);

/// The named properties of the live vertices or cells, in order of birth. Those of a type not in
/// the table above are left out and named in `notes`.
template <class Tag>
std::vector<DataArray> property_arrays(const HexMesh& mesh, std::vector<std::string>& notes);

/// The array of that name if it has one integer a place, else the end.
std::vector<DataArray>::iterator find_integers(std::vector<DataArray>& arrays,
                                               std::string_view name);

/// The note of a property that a file does not get.
/// \param reason  a clause without a full stop
std::string left_out(const std::string& property, const std::string& reason);

}  // namespace detail
}  // namespace hexweft
