/// \file
/// Hashes of what is made of elements, to know it again, also when their handles have become others.
#pragma once

#include <cstddef>
#include <cstdint>

#include "ovm/detail/fnv.h"
#include "ovm/hex_mesh.h"

namespace hexweft {

/// Of a sequence.
class Hash {
 public:
  void take(int x) { fnv_.take(static_cast<unsigned>(x)); }
  void take(std::size_t x) { fnv_.take(x); }
  std::size_t value() const { return fnv_.value(); }

 private:
  detail::Fnv fnv_;
};

/// The finalizer of SplitMix64: of hashes that went through it the sum is one of their set.
constexpr std::size_t mixed(std::uint64_t h) {
  h = (h ^ h >> 30) * 0xbf58476d1ce4e5b9ull;
  h = (h ^ h >> 27) * 0x94d049bb133111ebull;
  return h ^ h >> 31;
}

/// Of itself and its vertices, mixed. An edit makes new cells or takes some away.
inline std::size_t hash_of_cell(const HexMesh& mesh, CellHandle c) {
  Hash h;
  h.take(mesh.serial(c));
  for (VertexHandle v : mesh.vertices(c)) h.take(mesh.serial(v));
  return mixed(h.value());
}

}  // namespace hexweft
