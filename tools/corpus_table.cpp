#include "tools/corpus_table.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

#include <fmt/format.h>

namespace hexweft::cli {
namespace {

struct Column {
  const char* name;
  const char* heading;  // in Markdown
  const char* format;   // of a number
  bool in_markdown;
};
constexpr std::array kColumns = {
    Column{"H_in", "H in", "{:.0f}", true},      Column{"BC_in", "BC in", "{:.0f}", true},
    Column{"MSJ_in", "MSJ in", "{:.4f}", false}, Column{"ASJ_in", "ASJ in", "{:.4f}", false},
    Column{"genus", "genus", "{:.0f}", true},    Column{"H", "H", "{:.0f}", true},
    Column{"BC", "BC", "{:.0f}", true},          Column{"R", "R", "{:.4f}", true},
    Column{"MSJ", "MSJ", "{:.4f}", true},        Column{"ASJ", "ASJ", "{:.4f}", true},
    Column{"Std", "Std", "{:.4f}", true},        Column{"AVDR", "AVDR", "{:.4f}", true},
    Column{"MVDR", "MVDR", "{:.3f}", true},      Column{"HR_percent", "HR %", "{:.3f}", true},
    Column{"seconds", "s", "{:.1f}", true},      Column{"wall_seconds", "wall s", "{:.1f}", false},
    Column{"peak_MiB", "MiB", "{:.0f}", true}};

std::optional<double> number(const std::string& text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

// What the input is like stands in the table already.
bool is_of_input(const std::string& column) { return column.ends_with("_in") || column == "genus"; }

bool is_in_markdown(const std::string& column) {
  const std::array endings = {"_BC", "_R", "_MSJ", "_ASJ", "_HR_percent", "_time_s"};
  return std::any_of(endings.begin(), endings.end(),
                     [&](const char* ending) { return column.ends_with(ending); });
}

bool is_done(const CorpusRow& row) { return row.at("status") == "done"; }

// The cells of one line: our figures, then the published ones, as text; empty where unknown.
struct Line {
  std::string mesh, status;
  std::vector<std::string> figures, published;
};

std::string figure(const CorpusRow& row, const Column& column) {
  const auto it = row.find(column.name);
  if (it == row.end() || !it->is_number()) return "";
  return fmt::format(fmt::runtime(column.format), it->get<double>());
}

Line line_of(const CorpusRow& row, const PublishedTable& published) {
  Line line{row.at("mesh").get<std::string>(), row.at("status").get<std::string>(), {}, {}};
  for (const Column& c : kColumns) line.figures.push_back(figure(row, c));
  const auto it = published.rows.find({row.at("corpus").get<std::string>(), line.mesh});
  line.published =
      it != published.rows.end() ? it->second : std::vector<std::string>(published.columns.size());
  return line;
}

// Means over the meshes that are done: of the figures, and of what is published of these.
Line mean_line(const std::vector<const CorpusRow*>& rows, const PublishedTable& published) {
  std::vector<const CorpusRow*> done;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(done),
               [](const CorpusRow* r) { return is_done(*r); });
  Line mean{fmt::format("mean of {}", done.size()), "", {}, {}};
  for (const Column& c : kColumns) {
    double sum = 0;
    int n = 0;
    for (const CorpusRow* r : done) {
      const auto it = r->find(c.name);
      if (it == r->end() || !it->is_number()) continue;
      sum += it->get<double>();
      ++n;
    }
    mean.figures.push_back(n > 0 ? fmt::format(fmt::runtime(c.format), sum / n) : "");
  }
  for (std::size_t i = 0; i < published.columns.size(); ++i) {
    double sum = 0;
    int n = 0;
    for (const CorpusRow* r : done) {
      const auto it = published.rows.find(
          {r->at("corpus").get<std::string>(), r->at("mesh").get<std::string>()});
      if (it == published.rows.end()) continue;
      if (const auto x = number(it->second[i])) {
        sum += *x;
        ++n;
      }
    }
    const double x = n > 0 ? sum / n : 0;
    mean.published.push_back(n == 0 ? "" : fmt::format("{:.{}f}", x, x < 10 ? 4 : 0));
  }
  return mean;
}

struct Section {
  std::string corpus;
  std::vector<const CorpusRow*> rows;
};

std::vector<Section> sections(const std::vector<CorpusRow>& rows) {
  std::vector<Section> result;
  for (const CorpusRow& row : rows) {
    const auto corpus = row.at("corpus").get<std::string>();
    if (result.empty() || result.back().corpus != corpus) result.push_back({corpus, {}});
    result.back().rows.push_back(&row);
  }
  return result;
}

// A cell that holds the separator or a quote is quoted.
std::string quoted(const std::string& cell) {
  if (cell.find_first_of(",\"\n") == std::string::npos) return cell;
  std::string text = "\"";
  for (const char c : cell) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + '"';
}

void add_csv_line(std::string& out, const std::string& corpus, const Line& line,
                  const PublishedTable& published) {
  out += quoted(corpus) + ',' + quoted(line.mesh);
  for (const std::string& cell : line.figures) out += ',' + cell;
  out += ',' + quoted(line.status);
  for (std::size_t i = 0; i < published.columns.size(); ++i) {
    if (!is_of_input(published.columns[i])) out += ',' + quoted(line.published[i]);
  }
  out += '\n';
}

// The published columns that have something to say of these meshes.
std::vector<std::size_t> markdown_columns(const std::vector<Line>& lines,
                                          const PublishedTable& published) {
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < published.columns.size(); ++i) {
    const bool known = std::any_of(lines.begin(), lines.end(),
                                   [&](const Line& line) { return !line.published[i].empty(); });
    if (known && is_in_markdown(published.columns[i])) result.push_back(i);
  }
  return result;
}

std::string heading(std::string column) {
  std::replace(column.begin(), column.end(), '_', ' ');
  if (column.ends_with(" percent")) column.replace(column.size() - 7, 7, "%");
  return column;
}

std::string in_cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) {
    text.insert(at, 1, '\\');
  }
  return text;
}

std::string markdown_section(const Section& section, const PublishedTable& published) {
  std::vector<Line> lines;
  for (const CorpusRow* row : section.rows) lines.push_back(line_of(*row, published));
  const std::vector<std::size_t> columns = markdown_columns(lines, published);
  lines.push_back(mean_line(section.rows, published));
  const bool failures = std::any_of(section.rows.begin(), section.rows.end(),
                                    [](const CorpusRow* row) { return !is_done(*row); });
  std::string head = "| mesh |", rule = "|---|";
  for (const Column& c : kColumns) {
    if (!c.in_markdown) continue;
    head += fmt::format(" {} |", c.heading);
    rule += "---:|";
  }
  for (const std::size_t i : columns) {
    head += ' ' + heading(published.columns[i]) + " |";
    rule += "---:|";
  }
  if (failures) {
    head += " status |";
    rule += "---|";
  }
  std::string out = "## " + section.corpus + "\n\n" + head + '\n' + rule + '\n';
  for (const Line& line : lines) {
    out += "| " + in_cell(line.mesh) + " |";
    for (std::size_t i = 0; i < kColumns.size(); ++i) {
      if (kColumns[i].in_markdown) out += ' ' + line.figures[i] + " |";
    }
    for (const std::size_t i : columns) out += ' ' + line.published[i] + " |";
    if (failures) out += ' ' + in_cell(line.status) + " |";
    out += '\n';
  }
  return out;
}

}  // namespace

std::string csv_table(const std::vector<CorpusRow>& rows, const PublishedTable& published) {
  std::string out = "corpus,mesh";
  for (const Column& c : kColumns) out += std::string(",") + c.name;
  out += ",status";
  for (const std::string& column : published.columns) {
    if (!is_of_input(column)) out += ',' + quoted(column);
  }
  out += '\n';
  for (const Section& section : sections(rows)) {
    for (const CorpusRow* row : section.rows) {
      add_csv_line(out, section.corpus, line_of(*row, published), published);
    }
    add_csv_line(out, section.corpus, mean_line(section.rows, published), published);
  }
  return out;
}

std::string markdown_table(const std::vector<CorpusRow>& rows, const PublishedTable& published) {
  std::string out;
  for (const Section& section : sections(rows)) {
    if (!out.empty()) out += '\n';
    out += markdown_section(section, published);
  }
  return out;
}

}  // namespace hexweft::cli
