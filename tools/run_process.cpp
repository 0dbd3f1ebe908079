#include "tools/run_process.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <mutex>
#include <poll.h>
#include <set>
#include <spawn.h>
#include <stdexcept>
#include <sys/resource.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>

extern char** environ;

namespace hexweft::cli {
namespace {

std::string reason(int error) { return std::generic_category().message(error); }

// Both ends of a pipe; what is open is closed at the end.
struct Pipe {
  std::array<int, 2> ends = {-1, -1};
  Pipe() {
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe: " + reason(errno));
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() {
    close(0);
    close(1);
  }
  void close(int end) {
    if (ends[end] >= 0) ::close(ends[end]);
    ends[end] = -1;
  }
};

// The processes that run now.
class Registry {
 public:
  // Starts a process unless kill_all() was called. \return errno
  template <class Start>
  int add(Start start, pid_t& pid) {
    const std::lock_guard lock(mutex_);
    if (closed_) return ECANCELED;
    const int error = start(pid);
    if (error == 0) running_.insert(pid);
    return error;
  }
  // Waits for a process; its number is free for another only after it has left the list.
  int wait(pid_t pid, rusage& usage) {
    siginfo_t info{};
    while (::waitid(P_PID, static_cast<id_t>(pid), &info, WEXITED | WNOWAIT) < 0 &&
           errno == EINTR) {
    }
    const std::lock_guard lock(mutex_);
    running_.erase(pid);
    int status = 0;
    while (::wait4(pid, &status, 0, &usage) < 0 && errno == EINTR) {
    }
    return status;
  }
  void kill_all() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    for (const pid_t pid : running_) ::kill(-pid, SIGKILL);
  }

 private:
  std::mutex mutex_;
  std::set<pid_t> running_;
  bool closed_ = false;
};

Registry& registry() {
  static Registry all;
  return all;
}

int start(const std::vector<std::string>& arguments, const Pipe& out, const Pipe& err, pid_t& pid) {
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
  argv.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&files, out.ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&files, err.ends[1], STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  posix_spawnattr_setpgroup(&attributes, 0);
  const int error = posix_spawn(&pid, argv[0], &files, &attributes, argv.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  return error;
}

// Reads two pipes to their ends at the same time: a process that waits to write to one would not
// close the other.
void read_both(const Pipe& a, const Pipe& b, std::string& text_a, std::string& text_b) {
  std::array<pollfd, 2> files = {pollfd{a.ends[0], POLLIN, 0}, pollfd{b.ends[0], POLLIN, 0}};
  const std::array<std::string*, 2> texts = {&text_a, &text_b};
  std::array<char, 1 << 14> buffer;
  while (files[0].fd >= 0 || files[1].fd >= 0) {
    if (::poll(files.data(), files.size(), -1) < 0 && errno != EINTR) return;
    for (int i : {0, 1}) {
      if (files[i].fd < 0 || files[i].revents == 0) continue;
      const ssize_t n = ::read(files[i].fd, buffer.data(), buffer.size());
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) {
        files[i].fd = -1;
      } else {
        texts[i]->append(buffer.data(), static_cast<std::size_t>(n));
      }
    }
  }
}

std::string last_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  return text.substr(text.rfind('\n') + 1);
}

double seconds(const timeval& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

}  // namespace

ProcessResult run_process(const std::vector<std::string>& arguments) {
  ProcessResult result;
  const auto begin = std::chrono::steady_clock::now();
  Pipe out, err;
  pid_t pid = -1;
  const int error =
      registry().add([&](pid_t& child) { return start(arguments, out, err, child); }, pid);
  if (error != 0) {
    result.exit_code = -1;
    result.problem = error == ECANCELED
                         ? "interrupted"
                         : fmt::format("{}: cannot be started: {}", arguments[0], reason(error));
    return result;
  }
  out.close(1);
  err.close(1);
  std::string complaints;
  read_both(out, err, result.output, complaints);
  rusage usage{};
  const int status = registry().wait(pid, usage);
  const std::chrono::duration<double> gone = std::chrono::steady_clock::now() - begin;
  result.wall_seconds = gone.count();
  result.seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  result.peak_mib = static_cast<double>(usage.ru_maxrss) / 1024;
  result.problem = last_line(std::move(complaints));
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  if (WIFSIGNALED(status)) {
    const char* what = ::sigdescr_np(WTERMSIG(status));
    result.problem = fmt::format("ended by signal {} ({})", WTERMSIG(status), what ? what : "?");
  }
  return result;
}

void kill_processes() { registry().kill_all(); }

std::string sibling_program(const std::string& name) {
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) throw std::runtime_error("/proc/self/exe: cannot be read: " + error.message());
  const auto path = self.parent_path() / name;
  if (!std::filesystem::exists(path, error)) {
    throw std::runtime_error(path.string() + ": is not there, but is needed");
  }
  return path.string();
}

}  // namespace hexweft::cli
