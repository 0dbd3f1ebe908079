/// \file
/// Edits that can be undone.
#pragma once

#include "ovm/hex_mesh.h"

namespace hexweft {

/// While it lives, edits of the mesh, its points and its properties are logged; unless commit() is
/// called, the destructor undoes them and every handle, property and coordinate is as before. The
/// cost is that of what was touched. Transactions nest.
///
///     Transaction trial(mesh);
///     collapse(mesh, sheet);
///     if (good(mesh)) trial.commit();
class Transaction {
 public:
  explicit Transaction(HexMesh& mesh) : mesh_(&mesh) { mesh.open_savepoint(); }
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  ~Transaction() { rollback(); }

  void commit() {
    if (mesh_) mesh_->commit();
    mesh_ = nullptr;
  }
  void rollback() {
    if (mesh_) mesh_->rollback();
    mesh_ = nullptr;
  }

 private:
  HexMesh* mesh_;
};

}  // namespace hexweft
