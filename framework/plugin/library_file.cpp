#include "plugin/library_file.hpp"

#include <elf.h>

#include <cstring>
#include <fstream>
#include <system_error>
#include <vector>

namespace mesogen::plugin {

namespace {

#if defined(__x86_64__)
constexpr Elf64_Half machine = EM_X86_64;
#elif defined(__aarch64__)
constexpr Elf64_Half machine = EM_AARCH64;
#else
constexpr Elf64_Half machine = EM_NONE;
#endif

/// Reads `count` records that begin at byte `offset`; false if the file ends before.
template <class Record>
bool read_records(std::ifstream& in, std::uint64_t offset, std::size_t count, std::vector<Record>& out) {
  out.resize(count);
  in.seekg(static_cast<std::streamoff>(offset));
  // Records of an ELF file are plain structures; a stream can only be read as characters.
  in.read(reinterpret_cast<char*>(out.data()), static_cast<std::streamsize>(count * sizeof(Record)));
  return static_cast<bool>(in);
}

}  // namespace

std::string library_problem(const std::filesystem::path& file) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (error) return "it cannot be read (" + error.message() + ")";
  std::ifstream in(file, std::ios::binary);
  if (!in) return "it cannot be opened for reading";
  std::vector<Elf64_Ehdr> header;
  if (!read_records(in, 0, 1, header) || std::memcmp(header[0].e_ident, ELFMAG, SELFMAG) != 0)
    return "it is not a shared library";
  const Elf64_Ehdr& elf = header[0];
  if (elf.e_ident[EI_CLASS] != ELFCLASS64 || elf.e_type != ET_DYN || (machine != EM_NONE && elf.e_machine != machine))
    return "it is not a shared library for this kind of machine";
  if (elf.e_phentsize != sizeof(Elf64_Phdr)) return "it is not a valid shared library";
  const char* const cut = "it is cut short; build or copy it again";
  std::vector<Elf64_Phdr> segments;
  if (!read_records(in, elf.e_phoff, elf.e_phnum, segments)) return cut;
  if (elf.e_shoff + std::uint64_t{elf.e_shnum} * elf.e_shentsize > size) return cut;
  for (const auto& segment : segments)
    if (segment.p_type == PT_LOAD && segment.p_offset + segment.p_filesz > size) return cut;
  return {};
}

}  // namespace mesogen::plugin
