#include "tools/published_table.h"

#include <algorithm>

#include <fmt/format.h>

#include "io/file.h"
#include "ovm/errors.h"

namespace hexweft::cli {
namespace {

struct CsvLine {
  int number;  // from 1
  std::vector<std::string> cells;
};

// A comma in quotes belongs to the cell, and two quotes there are one [RFC4180, §2].
std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"') {
      const bool is_one = quoted && i + 1 < line.size() && line[i + 1] == '"';
      if (is_one) cells.back() += line[++i];
      quoted = is_one || !quoted;
    } else if (c == ',' && !quoted) {
      cells.emplace_back();
    } else if (c != '\r') {
      cells.back() += c;
    }
  }
  return cells;
}

// All lines that are not empty.
std::vector<CsvLine> split_lines(const std::string& text) {
  std::vector<CsvLine> lines;
  int number = 0;
  for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end + 1) {
    end = std::min(text.find('\n', begin), text.size());
    CsvLine line{++number, split(text.substr(begin, end - begin))};
    if (line.cells.size() > 1 || !line.cells[0].empty()) lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace

bool PublishedTable::has_corpus(const std::string& corpus) const {
  const auto it = rows.lower_bound({corpus, ""});
  return it != rows.end() && it->first.first == corpus;
}

PublishedTable read_published_table(const std::filesystem::path& path) {
  const auto fail = [&](int line, const std::string& problem) {
    throw FormatError(fmt::format("{}:{}: {}", path.string(), line, problem));
  };
  const std::vector<CsvLine> lines = split_lines(read_file(path));
  if (lines.empty()) fail(1, "expected a line that names the columns");
  const std::vector<std::string>& names = lines[0].cells;
  const auto corpus = std::find(names.begin(), names.end(), "corpus") - names.begin();
  const auto mesh = std::find(names.begin(), names.end(), "mesh") - names.begin();
  if (std::max(corpus, mesh) == std::ssize(names)) {
    fail(lines[0].number, "expected columns named corpus and mesh");
  }
  PublishedTable table;
  for (const CsvLine& line : lines) {
    if (line.cells.size() != names.size()) {
      fail(line.number,
           fmt::format("expected {} cells, found {}", names.size(), line.cells.size()));
    }
    std::vector<std::string> figures;
    for (std::ptrdiff_t i = 0; i < std::ssize(names); ++i) {
      if (i != corpus && i != mesh) figures.push_back(line.cells[i]);
    }
    if (&line == &lines[0]) {
      table.columns = std::move(figures);
    } else {
      table.rows[{line.cells[corpus], line.cells[mesh]}] = std::move(figures);
    }
  }
  return table;
}

}  // namespace hexweft::cli
