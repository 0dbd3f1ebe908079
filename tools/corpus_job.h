/// \file
/// One mesh of a corpus: simplified by hexweft-simplify, then measured from the file it wrote by
/// hexweft-info and hexweft-distance.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace hexweft::cli {

/// The programs a job runs, by path.
struct CorpusPrograms {
  std::string simplify, info, distance;
};

/// What is to be done with one mesh.
struct CorpusJob {
  std::string corpus;  ///< its folder within the corpus
  std::string mesh;    ///< its file's name without extension
  std::filesystem::path input;
  std::filesystem::path stem;  ///< of what is written: STEM.vtk, STEM.report.json, STEM.row.json
  std::vector<std::string> options;  ///< of hexweft-simplify
};

/// STEM.vtk, STEM.report.json and STEM.row.json.
std::array<std::filesystem::path, 3> files_of(const CorpusJob& job);

/// A row of the table, which is also what STEM.row.json holds: "corpus", "mesh", "status" ("done"
/// or "failed: ..."), the figures that are known, and the "key".
using CorpusRow = nlohmann::ordered_json;

/// What a row depends on: the input file, the options and the program, by path, size and time.
std::string key_of(const CorpusJob& job, const CorpusPrograms& programs);

/// The row of an earlier run, if it has this key, is done and its mesh is still there; else null: what
/// failed may have failed for a reason that has gone.
CorpusRow find_row(const CorpusJob& job, const std::string& key);

/// Runs the programs, however they end, and returns the row. Writes STEM.vtk and STEM.report.json.
CorpusRow run_job(const CorpusJob& job, const CorpusPrograms& programs, const std::string& key);

/// Keeps the row for find_row().
void keep_row(const CorpusJob& job, const CorpusRow& row);

}  // namespace hexweft::cli
