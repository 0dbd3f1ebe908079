/// \file
/// Typed element handles. Handles of different entities neither convert nor compare.
#pragma once

#include <compare>
#include <functional>

namespace hexweft {

/// An index that knows its entity; -1 is "none".
template <class Tag>
struct Handle {
  int idx;
  constexpr explicit Handle(int i = -1) : idx(i) {}
  constexpr bool valid() const { return idx >= 0; }
  friend constexpr auto operator<=>(const Handle&, const Handle&) = default;
};

using VertexHandle = Handle<struct VertexTag>;
using EdgeHandle = Handle<struct EdgeTag>;
using HalfEdgeHandle = Handle<struct HalfEdgeTag>;  ///< 2e from the edge's first vertex, 2e+1 back
using FaceHandle = Handle<struct FaceTag>;
using HalfFaceHandle = Handle<struct HalfFaceTag>;  ///< 6c + k: side k of cell c, hex_numbering.h
using CellHandle = Handle<struct CellTag>;

}  // namespace hexweft

template <class Tag>
struct std::hash<hexweft::Handle<Tag>> {
  std::size_t operator()(hexweft::Handle<Tag> h) const noexcept { return std::hash<int>{}(h.idx); }
};
