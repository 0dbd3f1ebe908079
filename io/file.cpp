#include "io/file.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include "ovm/errors.h"

namespace hexweft {
namespace {

namespace fs = std::filesystem;

// A file descriptor that closes itself; standard streams stay open.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(); }
  int get() const { return fd_; }
  bool close() {  // false if the system only now says that the data did not arrive
    const bool good = fd_ <= 2 || ::close(fd_) == 0;
    fd_ = -1;
    return good;
  }

 private:
  int fd_;
};

[[noreturn]] void fail(const fs::path& path, bool reading, int error) {
  throw FormatError(display_name(path, reading) + ": cannot be " +
                    (reading ? "read: " : "written: ") + std::generic_category().message(error));
}

int write_all(int fd, std::string_view content) {
  while (!content.empty()) {
    const ssize_t n = ::write(fd, content.data(), content.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno;
    content.remove_prefix(n);
  }
  return 0;
}

void write_directly(const fs::path& path, std::string_view content) {
  Descriptor file(path == "-" ? STDOUT_FILENO : ::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (file.get() < 0) fail(path, false, errno);
  if (const int error = write_all(file.get(), content)) fail(path, false, error);
  if (!file.close()) fail(path, false, errno);
}

// Opens a new file beside the target, under a name nobody has.
fs::path open_beside(const fs::path& target, mode_t mode, int& fd) {
  for (int i = 0;; ++i) {
    // Not made of the target's name, which may be as long as names can be.
    const fs::path name = target.parent_path() /
                          (".hexweft-part-" + std::to_string(::getpid()) + "-" + std::to_string(i));
    fd = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    if (fd >= 0 || errno != EEXIST) return name;
  }
}

}  // namespace

std::string display_name(const fs::path& path, bool reading) {
  if (path == "-") return reading ? "standard input" : "standard output";
  return path.string();
}

std::string read_file(const fs::path& path) {
  Descriptor file(path == "-" ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (file.get() < 0) fail(path, true, errno);
  std::string content;
  struct stat info {};
  if (::fstat(file.get(), &info) == 0 && S_ISREG(info.st_mode)) content.reserve(info.st_size + 1);
  std::size_t size = 0;
  for (;;) {
    if (size == content.size()) {
      content.resize(std::max({content.capacity(), 2 * size, std::size_t{1} << 16}));
    }
    const ssize_t n = ::read(file.get(), content.data() + size, content.size() - size);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(path, true, errno);
    if (n == 0) break;
    size += n;
  }
  content.resize(size);
  return content;
}

void check_writable(const fs::path& path) {
  if (path == "-") return;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) fail(path, false, EISDIR);
  const bool is_device = fs::exists(status) && !fs::is_regular_file(status);
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (::access(is_device ? path.c_str() : folder.c_str(), W_OK) != 0) fail(path, false, errno);
}

void write_file(const fs::path& path, std::string_view content) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) fail(path, false, EISDIR);
  if (path == "-" || (fs::exists(status) && !fs::is_regular_file(status))) {
    return write_directly(path, content);
  }
  const fs::path target = fs::exists(status) ? fs::canonical(path, error) : path;
  if (error && fs::exists(status)) fail(path, false, error.value());
  int fd = -1;
  const fs::path part = open_beside(target, 0666, fd);
  if (fd < 0) fail(path, false, errno);
  Descriptor file(fd);
  int problem = write_all(fd, content);
  if (problem == 0 && fs::exists(status)) {
    ::fchmod(fd, static_cast<mode_t>(status.permissions()) & 07777);
  }
  if (!file.close() && problem == 0) problem = errno;
  if (problem == 0 && ::rename(part.c_str(), target.c_str()) != 0) problem = errno;
  if (problem != 0) {
    ::unlink(part.c_str());
    fail(path, false, problem);
  }
}

}  // namespace hexweft
