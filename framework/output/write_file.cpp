#include "output/write_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

namespace mesogen::output {

namespace {

class Descriptor {
 public:
  Descriptor(const std::filesystem::path& path, int flags) : number_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  [[nodiscard]] int get() const { return number_; }
  [[nodiscard]] bool is_open() const { return number_ >= 0; }
  /// The file system may report a failed write only here.
  [[nodiscard]] int close() { return ::close(std::exchange(number_, -1)); }

 private:
  int number_;
};

[[noreturn]] void give_up(const std::filesystem::path& path, int number, Owner owner) {
  ::unlink(temporary_name(path).c_str());
  throw system_error(ExitCode::run_failed, "write", path, number, owner);
}

}  // namespace

Error system_error(ExitCode code, const std::string& action, const std::filesystem::path& path, int number,
                   Owner owner) {
  std::string hint;
  if (number == ENOSPC || number == EDQUOT || number == EFBIG)
    hint = owner == Owner::run ? "; what was written before is safe: make room, then `mesogen resume` continues the run"
                               : "; make room and try again, or choose another place with --output";
  else if (number == ENOENT || number == ENOTDIR)
    hint = "; has its folder been removed or renamed?";
  else if (number == EACCES || number == EPERM || number == EROFS)
    hint = "; check its permissions, or choose another folder with --output";
  return {code, "cannot " + action + " " + path.string() + ": " + std::generic_category().message(number) + hint};
}

std::filesystem::path temporary_name(const std::filesystem::path& path) { return path.string() + ".tmp"; }

void sync_folder(const std::filesystem::path& folder) {
  const Descriptor directory(folder.empty() ? "." : folder, O_RDONLY | O_DIRECTORY);
  // Some file systems cannot sync a folder; then there is nothing more to do.
  if (!directory.is_open() || (::fsync(directory.get()) != 0 && errno != EINVAL))
    throw system_error(ExitCode::run_failed, "write into", folder, errno);
}

void require_writable(const std::filesystem::path& path, bool overwrite) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw Error(ExitCode::bad_case, path.string() + " is a folder: name a file in it with --output");
  if (!overwrite && std::filesystem::exists(path, error))
    throw Error(ExitCode::bad_case,
                path.string() + " is there already: replace it with --overwrite, or choose another --output");
  const std::filesystem::path folder = path.parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder, error))
    throw Error(ExitCode::bad_case, "cannot write " + path.string() + ": there is no folder " + folder.string() +
                                        "; make it first, or choose another --output");
}

void put_in_place(const std::filesystem::path& path, Owner owner) {
  const std::filesystem::path temporary = temporary_name(path);
  Descriptor file(temporary, O_RDWR);
  if (!file.is_open() || ::fsync(file.get()) != 0) give_up(path, errno, owner);
  if (file.close() != 0 || std::rename(temporary.c_str(), path.c_str()) != 0) give_up(path, errno, owner);
  sync_folder(path.parent_path());
}

void write_unfinished(const std::filesystem::path& path, std::span<const std::byte> begin, std::uint64_t size,
                      Owner owner) {
  Descriptor file(temporary_name(path), O_WRONLY | O_CREAT | O_TRUNC);
  if (!file.is_open()) throw system_error(ExitCode::run_failed, "write", path, errno, owner);
  const std::size_t whole = begin.size();
  while (!begin.empty()) {
    const ssize_t written = ::write(file.get(), begin.data(), begin.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) give_up(path, errno, owner);
    begin = begin.subspan(static_cast<std::size_t>(written));
  }
  if (size > whole) {
    const int refused = ::posix_fallocate(file.get(), 0, static_cast<off_t>(size));
    if (refused != 0) give_up(path, refused, owner);
  }
  if (file.close() != 0) give_up(path, errno, owner);
}

void write_file(const std::filesystem::path& path, std::span<const std::byte> bytes, Owner owner) {
  write_unfinished(path, bytes, bytes.size(), owner);
  put_in_place(path, owner);
}

void write_file(const std::filesystem::path& path, const std::string& text, Owner owner) {
  write_file(path, std::as_bytes(std::span(text)), owner);
}

std::vector<std::byte> read_file(const std::filesystem::path& path, ExitCode code) {
  const Descriptor file(path, O_RDONLY);
  struct stat status {};
  if (!file.is_open() || ::fstat(file.get(), &status) != 0) throw system_error(code, "read", path, errno);
  std::vector<std::byte> bytes(static_cast<std::size_t>(std::max<off_t>(0, status.st_size)));
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = ::read(file.get(), bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw system_error(code, "read", path, errno);
    if (count == 0) break;
    done += static_cast<std::size_t>(count);
  }
  bytes.resize(done);
  return bytes;
}

}  // namespace mesogen::output
