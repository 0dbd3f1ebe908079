#include "tools/corpus_job.h"

#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include "io/file.h"
#include "tools/run_process.h"

namespace hexweft::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

fs::path with(const fs::path& stem, const char* ending) {
  fs::path path = stem;
  path += ending;
  return path;
}

std::string stamp(const fs::path& file) {
  std::error_code error;
  const auto size = fs::file_size(file, error);
  const auto time = fs::last_write_time(file, error).time_since_epoch().count();
  return fmt::format("{} {} {}", fs::absolute(file, error).string(), size, time);
}

// Runs a program that prints a JSON report. \throws std::runtime_error with what it complained of
Json report_of(const std::vector<std::string>& arguments) {
  const ProcessResult run = run_process(arguments);
  if (run.exit_code != 0) throw std::runtime_error(run.problem);
  Json report = Json::parse(run.output, nullptr, false);
  if (report.is_discarded()) throw std::runtime_error(arguments[0] + ": printed no JSON");
  return report;
}

void add_input_figures(CorpusRow& row, const Json& info) {
  row["H_in"] = info.at("hexahedra");
  row["BC_in"] = info.at("components");
  row["MSJ_in"] = info.at("min_scaled_jacobian");
  row["ASJ_in"] = info.at("mean_scaled_jacobian");
  row["genus"] = info.at("genus");
}

void add_output_figures(CorpusRow& row, const Json& info, double hausdorff_ratio) {
  const auto bc_in = row.at("BC_in").get<double>();
  row["H"] = info.at("hexahedra");
  row["BC"] = info.at("components");
  row["R"] = 1 - info.at("components").get<double>() / bc_in;
  row["MSJ"] = info.at("min_scaled_jacobian");
  row["ASJ"] = info.at("mean_scaled_jacobian");
  row["Std"] = info.at("std_scaled_jacobian");
  row["AVDR"] = info.at("mean_volume_deviation");
  row["MVDR"] = info.at("max_volume_deviation");
  row["HR_percent"] = 100 * hausdorff_ratio;
}

// A mesh that hexweft-simplify must not have written. \throws std::runtime_error naming why
void check_output(const Json& in, const Json& out) {
  if (out.at("valid") != true) {
    const auto& problems = out.at("problems");
    throw std::runtime_error("the output is not valid" +
                             (problems.empty() ? "" : ": " + problems[0].get<std::string>()));
  }
  for (const char* figure : {"genus", "parts"}) {
    if (out.at(figure) == in.at(figure)) continue;
    throw std::runtime_error(fmt::format("the output has {} {}, expected {}", figure,
                                         out.at(figure).dump(), in.at(figure).dump()));
  }
}

void fill_row(CorpusRow& row, const CorpusJob& job, const CorpusPrograms& programs) {
  const std::string input = job.input.string(), output = with(job.stem, ".vtk").string(),
                    report = with(job.stem, ".report.json").string();
  const Json before = report_of({programs.info, input, "--json", "-"});
  if (before.at("components").is_null()) {
    throw std::runtime_error("the mesh is not valid: " +
                             before.at("problems").at(0).get<std::string>());
  }
  add_input_figures(row, before);
  std::vector<std::string> command = {programs.simplify, input, "-o", output, "--json", report};
  command.insert(command.end(), job.options.begin(), job.options.end());
  const ProcessResult run = run_process(command);
  row["seconds"] = run.seconds;
  row["wall_seconds"] = run.wall_seconds;
  row["peak_MiB"] = run.peak_mib;
  if (run.exit_code != 0) throw std::runtime_error(run.problem);
  const Json after = report_of({programs.info, output, "--json", "-"});
  check_output(before, after);
  const Json distance = report_of({programs.distance, output, input, "--json", "-"});
  add_output_figures(row, after, distance.at("ratio").get<double>());
  row["stopped"] = Json::parse(read_file(report)).at("stopped");
}

}  // namespace

std::array<fs::path, 3> files_of(const CorpusJob& job) {
  return {with(job.stem, ".vtk"), with(job.stem, ".report.json"), with(job.stem, ".row.json")};
}

std::string key_of(const CorpusJob& job, const CorpusPrograms& programs) {
  std::string key = stamp(job.input);
  for (const std::string& program : {programs.simplify, programs.info, programs.distance})
    key += " | " + stamp(program);
  for (const std::string& option : job.options) key += " " + option;
  return key;
}

CorpusRow find_row(const CorpusJob& job, const std::string& key) {
  std::error_code error;
  const fs::path file = with(job.stem, ".row.json");
  if (!fs::exists(file, error)) return nullptr;
  CorpusRow row = CorpusRow::parse(read_file(file), nullptr, false);
  if (!row.is_object() || row.value("key", "") != key) return nullptr;
  const bool done = row.value("status", "") == "done";
  return done && fs::exists(with(job.stem, ".vtk"), error) ? row : nullptr;
}

CorpusRow run_job(const CorpusJob& job, const CorpusPrograms& programs, const std::string& key) {
  CorpusRow row = {{"corpus", job.corpus}, {"mesh", job.mesh}, {"status", "done"}};
  std::error_code error;
  // What an earlier run left must not stand beside a row that says "failed".
  for (const fs::path& file : files_of(job)) fs::remove(file, error);
  try {
    fill_row(row, job, programs);
  } catch (const std::exception& problem) {
    row["status"] = std::string("failed: ") + problem.what();
  }
  row["key"] = key;
  return row;
}

void keep_row(const CorpusJob& job, const CorpusRow& row) {
  using Handler = CorpusRow::error_handler_t;
  write_file(with(job.stem, ".row.json"), row.dump(2, ' ', false, Handler::replace) + "\n");
}

}  // namespace hexweft::cli
