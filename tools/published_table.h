/// \file
/// Figures from elsewhere of the meshes of a corpus, to stand beside ours.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace hexweft::cli {

struct PublishedTable {
  std::vector<std::string> columns;  ///< without "corpus" and "mesh"
  /// By corpus and mesh; as many as columns.
  std::map<std::pair<std::string, std::string>, std::vector<std::string>> rows;
  bool empty() const { return rows.empty(); }
  bool has_corpus(const std::string& corpus) const;
};

/// Reads comma-separated values; the first line names the columns, two of which are "corpus" and
/// "mesh". \throws FormatError "path:line: ..."
PublishedTable read_published_table(const std::filesystem::path& path);

}  // namespace hexweft::cli
