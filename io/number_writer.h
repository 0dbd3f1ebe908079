/// \file
/// Rows of numbers, as text or as bytes.
///
///     NumberWriter rows(options, std::endian::little, out);
///     for (double x : point) rows.put(x);
///     rows.end_row();
#pragma once

#include "io/binary_numbers.h"
#include "io/hex_mesh_io.h"
#include "io/number_text.h"

namespace hexweft::detail {

class NumberWriter {
 public:
  /// \param options, out  must outlive this
  /// \param order         of bytes, where options.binary is set
  NumberWriter(const WriteOptions& options, std::endian order, std::string& out)
      : options_(options), order_(order), out_(out) {}

  template <class T>
  void put(T value) {
    if (options_.binary) {
      append_bytes(out_, value, order_);
    } else {
      append_number(out_, value, options_.precision);
      out_ += ' ';
    }
  }
  /// \pre something was put since the last one
  void end_row() {
    if (!options_.binary) out_.back() = '\n';
  }

 private:
  const WriteOptions& options_;
  std::endian order_;
  std::string& out_;
};

}  // namespace hexweft::detail
