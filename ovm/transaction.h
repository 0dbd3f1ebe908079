/// \file
/// Edits that can be undone.
#pragma once

#include <utility>

#include "ovm/errors.h"
#include "ovm/hex_mesh.h"

namespace hexweft {

/// While it lives, edits of the mesh, its points and its properties are logged; unless commit() is
/// called, the destructor undoes them and every handle, property and coordinate is as before;
/// properties made in the meantime stay, none can be erased. The cost is that of what was touched.
///
/// Transactions nest: only the innermost may end, but the destructor of an outer one undoes those
/// inside it too. The mesh is neither moved nor destroyed before they have ended.
///
///     Transaction trial(mesh);
///     collapse(mesh, sheet);
///     if (good(mesh)) trial.commit();
class Transaction {
 public:
  explicit Transaction(HexMesh& mesh) : mesh_(&mesh) {
    mesh.open_savepoint();
    depth_ = mesh.depth();
  }
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  ~Transaction() {
    while (mesh_ && mesh_->depth() >= depth_) mesh_->rollback();
  }

  /// Both do nothing the second time.
  /// \throws InputError while a transaction inside this one is open
  void commit() {
    if (HexMesh* mesh = release()) mesh->commit();
  }
  void rollback() {
    if (HexMesh* mesh = release()) mesh->rollback();
  }

 private:
  HexMesh* release() {
    if (mesh_ && mesh_->depth() != depth_) {
      throw InputError("of the open transactions of a mesh only the innermost can end");
    }
    return std::exchange(mesh_, nullptr);
  }

  HexMesh* mesh_;
  int depth_;  // how many were open then, with this one
};

}  // namespace hexweft
