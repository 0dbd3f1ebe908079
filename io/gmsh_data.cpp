#include "io/gmsh_data.h"

#include "io/mesh_data.h"

namespace hexweft::detail {
namespace {

struct Header {
  std::string name;
  std::int64_t components = 0, rows = 0;
};

// Between the first and the last quotation mark of the line; all of it if there are none.
std::string_view unquoted(std::string_view line) {
  const std::size_t first = line.find('"'), last = line.rfind('"');
  return first == last ? line : line.substr(first + 1, last - first - 1);
}

// Texts (the first is the name), reals (the time) and integers (step, components, rows, part).
Header read_header(GmshValues& in) {
  Header header;
  const std::int64_t n_texts = in.read_int({0, 1000}, "the number of text tags in [0, 1000]");
  in.rest_of_line();
  for (std::int64_t i = 0; i < n_texts; ++i) {
    const std::string_view text = unquoted(in.rest_of_line());
    if (i == 0) header.name = text;
  }
  if (header.name.empty()) header.name = "unnamed";  // the mesh would take it for a private one
  const std::int64_t n_reals = in.read_int({0, 1000}, "the number of real tags in [0, 1000]");
  for (std::int64_t i = 0; i < n_reals; ++i) in.read_real("a real tag");
  const std::int64_t n_integers = in.read_int({3, 1000}, "the number of integer tags in [3, 1000]");
  in.read_int(kGmshInts, "the time step");
  header.components = in.read_int(kGmshCounts, "the number of components");
  header.rows = in.read_int(kGmshCounts, "the number of rows");
  for (std::int64_t i = 3; i < n_integers; ++i) in.read_int(kGmshInts, "an integer tag");
  return header;
}

class RowReader {
 public:
  RowReader(const GmshTags& tags, std::size_t rows, bool of_nodes, const Header& header)
      : tags_(tags), of_nodes_(of_nodes), header_(header), has_value_(rows, false) {
    array_.name = header.name;
    array_.components = static_cast<int>(header.components);
    array_.reals.assign(rows * array_.components, 0.0);
  }

  void read(GmshValues& in) {
    for (std::int64_t i = 0; i < header_.rows; ++i) read_row(in, i);
  }
  void finish(std::vector<DataArray>& arrays, std::vector<std::string>& notes);

 private:
  void read_row(GmshValues& in, std::int64_t i);

  const GmshTags& tags_;
  bool of_nodes_;
  const Header& header_;
  DataArray array_;
  std::vector<bool> has_value_;
  std::size_t n_with_value_ = 0, n_of_others_ = 0;
};

void RowReader::read_row(GmshValues& in, std::int64_t i) {
  const std::size_t where = in.where();
  const std::int64_t tag = in.read_int(kGmshTags, [&] {
    return "the tag of row " + std::to_string(i + 1) + " of " + std::to_string(header_.rows) +
           " of data " + quoted(header_.name);
  });
  const int index = tags_.find(tag);
  if (index < 0 && of_nodes_) {
    in.fail(where, "data " + quoted(header_.name) + " have a value of node " + std::to_string(tag) +
                       ", which $Nodes does not have");
  }
  for (int j = 0; j < array_.components; ++j) {
    const double value = in.read_real([&] {
      return "the value of " + std::string(of_nodes_ ? "node " : "element ") + std::to_string(tag) +
             " of data " + quoted(header_.name);
    });
    if (index >= 0) array_.reals[std::size_t(index) * array_.components + j] = value;
  }
  if (index < 0) {
    ++n_of_others_;
  } else if (!has_value_[index]) {
    has_value_[index] = true;
    ++n_with_value_;
  }
}

void RowReader::finish(std::vector<DataArray>& arrays, std::vector<std::string>& notes) {
  const std::string data = "data \"" + header_.name + "\"",
                    rows = std::to_string(has_value_.size());
  const std::string places = of_nodes_ ? " nodes" : " hexahedra";
  if (n_with_value_ == 0) {
    notes.push_back(data + " were left out: they have no value of any of the" + places);
    return;
  }
  if (n_of_others_ > 0) {
    notes.push_back(data + ": values of " + std::to_string(n_of_others_) +
                    " elements that are no hexahedra were left out");
  }
  if (n_with_value_ < has_value_.size()) {
    notes.push_back(data + " have no value of " +
                    std::to_string(has_value_.size() - n_with_value_) + " of " + rows + places +
                    ", which is 0 now");
  }
  add_array(arrays, std::move(array_), notes);
}

}  // namespace

void read_gmsh_data(GmshValues& in, const GmshTags& tags, std::size_t rows, bool of_nodes,
                    std::vector<DataArray>& arrays, std::vector<std::string>& notes) {
  const Header header = read_header(in);
  if (header.components != 1 && header.components != 3 && header.components != 9) {
    notes.push_back("data \"" + header.name + "\" were left out: they have " +
                    std::to_string(header.components) + " components, expected 1, 3 or 9");
    return;
  }
  in.begin_binary();
  RowReader reader(tags, rows, of_nodes, header);
  reader.read(in);
  in.expect_end();
  reader.finish(arrays, notes);
}

}  // namespace hexweft::detail
