// hexweft-corpus: simplifies every mesh of a folder and makes one table of the results.
#include <algorithm>
#include <atomic>
#include <iostream>
#include <mutex>
#include <set>
#include <thread>

#include <fmt/format.h>

#include "io/file.h"
#include "io/formats.h"
#include "tools/cli.h"
#include "tools/corpus_table.h"
#include "tools/progress_line.h"
#include "tools/run_process.h"
#include "tools/signal_watch.h"

namespace hexweft {
namespace {

namespace fs = std::filesystem;
using cli::CorpusJob;
using cli::CorpusRow;

struct Request {
  std::string folder, output = "corpus-output";
  std::vector<std::string> options;  // of hexweft-simplify
  int jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  bool again = false, all = false;

  fs::path published() const { return fs::path(folder) / "published.csv"; }
  fs::path csv() const { return fs::path(output) / "corpus.csv"; }
  fs::path markdown() const { return fs::path(output) / "corpus.md"; }
};

// Subfolders of this name choose the weights of the ranking.
std::string preset_of(const fs::path& folder) {
  const bool polycube = std::find(folder.begin(), folder.end(), "polycube") != folder.end();
  return polycube ? "polycube" : "octree";
}

// A preset that is passed on goes before that of the folder.
bool has_preset(const std::vector<std::string>& options) {
  return std::any_of(options.begin(), options.end(), [](const std::string& option) {
    return option == "--preset" || option.starts_with("--preset=");
  });
}

// The meshes below a folder, in order of their paths. Where there is a table of published results,
// only the folders it knows.
std::vector<CorpusJob> find_jobs(const Request& request, const cli::PublishedTable& published) {
  const fs::path root = request.folder, output = fs::weakly_canonical(request.output);
  std::vector<CorpusJob> jobs;
  std::set<fs::path> stems;
  for (auto it = fs::recursive_directory_iterator(root); it != fs::end(it); ++it) {
    if (it->is_directory() && fs::weakly_canonical(it->path()) == output) {
      it.disable_recursion_pending();  // what an earlier run wrote
    }
    if (!it->is_regular_file() || format_of_extension(it->path()) == nullptr) continue;
    const fs::path inside = it->path().lexically_relative(root);
    const std::string corpus =
        inside.has_parent_path() ? inside.parent_path().generic_string() : std::string(".");
    if (!published.empty() && !request.all && !published.has_corpus(corpus)) continue;
    CorpusJob job{corpus, it->path().stem().string(), it->path(), {}, {}};
    job.stem = fs::path(request.output) / inside.parent_path() / job.mesh;
    if (!has_preset(request.options)) job.options = {"--preset", preset_of(inside.parent_path())};
    job.options.insert(job.options.end(), request.options.begin(), request.options.end());
    jobs.push_back(std::move(job));
  }
  std::sort(jobs.begin(), jobs.end(), [](const CorpusJob& a, const CorpusJob& b) {
    return std::tie(a.corpus, a.mesh, a.input) < std::tie(b.corpus, b.mesh, b.input);
  });
  for (const CorpusJob& job : jobs) {
    if (fs::weakly_canonical(job.stem.string() + ".vtk") == fs::weakly_canonical(job.input)) {
      throw InputError("--output = " + request.output + ", expected another folder than FOLDER");
    }
    if (stems.insert(job.stem).second) continue;
    throw InputError(job.input.string() + ": another mesh of the folder has the same name");
  }
  return jobs;
}

// \throws InputError if the report would take the place of a file that is read or written here
void check_json(const cli::Program& program, const Request& request,
                const std::vector<CorpusJob>& jobs) {
  program.expect_no_json(request.published().string(), "published.csv");
  for (const CorpusJob& job : jobs) program.expect_no_json(job.input.string(), "the meshes");
  for (const fs::path& table : {request.csv(), request.markdown()})
    program.expect_no_json(table.string(), "the tables");
  for (const CorpusJob& job : jobs) {
    for (const fs::path& file : cli::files_of(job))
      program.expect_no_json(file.string(), "the outputs");
  }
}

// \throws FormatError
void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  const std::string reason = error ? error.message() : "it is no folder";
  if (error || !fs::is_directory(folder, error))
    throw FormatError(folder.string() + ": cannot be written: " + reason);
}

std::string line_of(const CorpusRow& row) {
  const std::string name = row["corpus"].get<std::string>() + "/" + row["mesh"].get<std::string>();
  if (row["status"] != "done") return name + ": " + row["status"].get<std::string>();
  return fmt::format(
      "{}: H {}  BC {} of {}  R {:.4f}  MSJ {:.3f}  ASJ {:.3f}  HR {:.3f} %  {:.1f} s", name,
      row["H"].dump(), row["BC"].dump(), row["BC_in"].dump(), row["R"].get<double>(),
      row["MSJ"].get<double>(), row["ASJ"].get<double>(), row["HR_percent"].get<double>(),
      row["seconds"].get<double>());
}

// The jobs, done by several threads, each of which waits for one process at a time.
class Runner {
 public:
  Runner(cli::Program& program, const Request& request, std::vector<CorpusJob> jobs)
      : program_(program),
        request_(request),
        jobs_(std::move(jobs)),
        programs_{cli::sibling_program("hexweft-simplify"), cli::sibling_program("hexweft-info"),
                  cli::sibling_program("hexweft-distance")},
        rows_(jobs_.size()) {}

  /// \return a row each job, in order; those not done are null if it was interrupted
  std::vector<CorpusRow> run(std::stop_token stop) {
    const std::stop_callback on_stop(stop, cli::kill_processes);
    // The largest first: at the end no processor waits long for another.
    std::vector<std::size_t> order(jobs_.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return fs::file_size(jobs_[a].input) > fs::file_size(jobs_[b].input);
    });
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
      for (std::size_t i = next++; i < order.size() && !stop.stop_requested(); i = next++) {
        do_job(order[i], stop);
      }
    };
    show_progress();
    std::vector<std::jthread> threads;
    threads.reserve(request_.jobs);
    for (int i = 0; i < request_.jobs; ++i) threads.emplace_back(work);
    threads.clear();  // waits for them
    line_.clear();
    if (failure_) std::rethrow_exception(failure_);
    return rows_;
  }

 private:
  void do_job(std::size_t i, const std::stop_token& stop) {
    try {
      const CorpusJob& job = jobs_[i];
      const std::string key = cli::key_of(job, programs_);
      CorpusRow row = request_.again ? CorpusRow() : cli::find_row(job, key);
      const bool is_new = row.is_null();
      if (is_new) {
        make_folder(job.stem.parent_path());
        row = cli::run_job(job, programs_, key);
        if (stop.stop_requested()) return;
        cli::keep_row(job, row);
      }
      const std::lock_guard lock(mutex_);
      rows_[i] = row;
      ++n_done_;
      line_.clear();
      if (is_new) program_.say(line_of(row));
      show_progress();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      failure_ = std::current_exception();
    }
  }

  void show_progress() { line_.show(fmt::format("{} of {} meshes done", n_done_, jobs_.size())); }

  cli::Program& program_;
  const Request& request_;
  std::vector<CorpusJob> jobs_;
  cli::CorpusPrograms programs_;
  std::mutex mutex_;  // guards what follows
  std::vector<CorpusRow> rows_;
  std::exception_ptr failure_;
  cli::ProgressLine line_;
  int n_done_ = 0;
};

int run(cli::Program& program, const Request& request) {
  if (!fs::is_directory(request.folder)) {
    throw FormatError(request.folder + ": cannot be read: it is no folder");
  }
  const cli::PublishedTable published = fs::exists(request.published())
                                            ? cli::read_published_table(request.published())
                                            : cli::PublishedTable{};
  std::vector<CorpusJob> jobs = find_jobs(request, published);
  if (jobs.empty()) {
    const bool all = request.all || published.empty();
    throw InputError(request.folder + ": no meshes are in " +
                     (all ? "it" : "the folders that its published.csv names (--all: in others)"));
  }
  check_json(program, request, jobs);
  make_folder(request.output);
  std::stop_source interrupt;
  const cli::SignalWatch watch(interrupt);
  const std::vector<CorpusRow> rows =
      Runner(program, request, std::move(jobs)).run(interrupt.get_token());
  if (interrupt.stop_requested()) {
    return program.fail(cli::kFailed, "interrupted: the same command goes on from here");
  }
  write_file(request.csv(), cli::csv_table(rows, published));
  write_file(request.markdown(), cli::markdown_table(rows, published));
  program.write_json(rows);
  const auto has_failed = [](const CorpusRow& row) { return row.at("status") != "done"; };
  const auto n_failed = std::count_if(rows.begin(), rows.end(), has_failed);
  program.say(fmt::format("{} meshes, {} failed: {} and {}", rows.size(), n_failed,
                          request.csv().string(), request.markdown().string()));
  if (n_failed == 0) return cli::kDone;
  return program.fail(cli::kFailed,
                      fmt::format("{} of {} meshes failed, first {}", n_failed, rows.size(),
                                  line_of(*std::find_if(rows.begin(), rows.end(), has_failed))));
}

}  // namespace
}  // namespace hexweft

int main(int argc, char** argv) {
  using namespace hexweft;
  cli::Program program(
      "hexweft-corpus",
      "Simplifies every mesh of a folder and its subfolders, each in a process of its own, and "
      "writes one table of what came out, measured from the written files. A run that was "
      "interrupted goes on where it stopped.");
  Request request;
  CLI::App& app = program.app();
  app.add_option(
         "FOLDER", request.folder,
         "Meshes; below a folder named polycube the weights are those of polycube meshes. "
         "With a published.csv in it, only the folders named there are taken, and its columns "
         "stand beside ours")
      ->required();
  app.add_option("OPTIONS", request.options, "After --: options of hexweft-simplify");
  app.add_option("-o,--output", request.output,
                 "Folder for the meshes, their reports, corpus.csv and corpus.md")
      ->capture_default_str();
  app.add_option("--jobs", request.jobs, "Processes at a time, of one thread each")
      ->check(cli::in_range(1, 1024))
      ->capture_default_str();
  app.add_flag("--again", request.again, "Do again what is done already");
  app.add_flag("--all", request.all, "Take folders that published.csv does not name, too");
  program.add_json();
  return program.run(argc, argv, [&] { return run(program, request); });
}
