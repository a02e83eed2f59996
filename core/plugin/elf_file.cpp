// SPDX-License-Identifier: Apache-2.0
#include "core/plugin/elf_file.h"

#include <elf.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace kerf {

namespace {

#if defined(__x86_64__)
constexpr std::uint16_t own_machine = EM_X86_64;
#elif defined(__aarch64__)
constexpr std::uint16_t own_machine = EM_AARCH64;
#else
constexpr std::uint16_t own_machine = EM_NONE;  // any: the linker decides
#endif

std::string name_of_machine(std::uint16_t machine) {
    switch (machine) {
        case EM_386:
            return "x86 of 32 bits";
        case EM_X86_64:
            return "x86-64";
        case EM_ARM:
            return "ARM of 32 bits";
        case EM_AARCH64:
            return "AArch64";
        case EM_RISCV:
            return "RISC-V";
        case EM_PPC64:
            return "PowerPC64";
        default:
            return "machine number " + std::to_string(machine);
    }
}

/// Returns the reason to refuse a path that is not a regular file, or an empty text. Opening a pipe could block for
/// ever.
std::string refusal_of_kind(const std::string& path) {
    namespace fs = std::filesystem;
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (error == std::errc::too_many_symbolic_link_levels)
        return "is a symbolic link that leads back to itself. Remove it from the folder, or let it name a plugin.";
    if (status.type() == fs::file_type::not_found) {
        if (!fs::is_symlink(fs::symlink_status(path, error))) return "there is no such file. Check its name.";
        return "is a symbolic link to `" + fs::read_symlink(path, error).string() +
               "`, which does not exist. Remove the link, or let it name a plugin.";
    }
    if (error == std::errc::permission_denied || status.type() == fs::file_type::none)
        return "cannot be examined: " + error.message() + ". Let this user read it and the folders that lead to it.";
    if (status.type() != fs::file_type::regular)
        return "is not a file, so it is no Kerf plugin. Remove it from the folder.";
    return {};
}

template <class T>
bool read_at(std::ifstream& file, std::uint64_t offset, T& out) {
    file.seekg(static_cast<std::streamoff>(offset));
    return static_cast<bool>(file.read(reinterpret_cast<char*>(&out), sizeof out));
}

std::string cut_short(std::uint64_t size, std::uint64_t need) {
    return "is cut short: it has " + std::to_string(size) + " bytes, and its headers need " + std::to_string(need) +
           ". Copy or build it again.";
}

std::string refusal_of_segments(std::ifstream& file, const Elf64_Ehdr& head, std::uint64_t size) {
    if (head.e_phentsize != sizeof(Elf64_Phdr) || head.e_phnum == 0)
        return "has no readable table of its segments, so it is damaged. Copy or build it again.";
    const std::uint64_t table = std::uint64_t{head.e_phnum} * sizeof(Elf64_Phdr);
    if (head.e_phoff > size || table > size - head.e_phoff) return cut_short(size, head.e_phoff + table);
    for (std::uint64_t i = 0; i < head.e_phnum; ++i) {
        Elf64_Phdr segment{};
        if (!read_at(file, head.e_phoff + i * sizeof segment, segment)) return cut_short(size, head.e_phoff + table);
        if (segment.p_type != PT_LOAD && segment.p_type != PT_DYNAMIC) continue;
        if (segment.p_offset > size || segment.p_filesz > size - segment.p_offset)
            return cut_short(size, segment.p_offset + segment.p_filesz);
        if (segment.p_type == PT_LOAD && segment.p_memsz < segment.p_filesz)
            return "has a segment that is larger in the file than in memory, so it is damaged. Copy or build it again.";
    }
    return {};
}

}  // namespace

std::string refusal_of_file(const std::string& path) {
    if (std::string why = refusal_of_kind(path); !why.empty()) return why;
    std::ifstream file(path, std::ios::binary);
    if (!file)
        return std::string("may not be read: ") + std::strerror(errno) +
               ". Let this user read it (`chmod a+r`), or remove it from the folder.";
    std::array<unsigned char, EI_NIDENT> ident{};
    file.read(reinterpret_cast<char*>(ident.data()), ident.size());
    file.clear();  // a file may be shorter than this
    if (std::memcmp(ident.data(), ELFMAG, SELFMAG) != 0)
        return "is not a shared library, so it is no Kerf plugin. Remove it from the folder, or build it again.";
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(path, error);
    if (size < sizeof(Elf64_Ehdr)) return cut_short(size, sizeof(Elf64_Ehdr));
    Elf64_Ehdr head{};
    if (!read_at(file, 0, head)) return cut_short(size, sizeof head);
    if (own_machine != EM_NONE && head.e_machine == own_machine &&
        (ident[EI_CLASS] != ELFCLASS64 || ident[EI_DATA] != ELFDATA2LSB))
        return "has a header for " + name_of_machine(own_machine) +
               " that is not of 64 bits with the least significant byte first, so it is damaged or of another kind. "
               "Copy or build it again.";
    if (own_machine != EM_NONE && head.e_machine != own_machine)
        return "is built for " + name_of_machine(head.e_machine) + ", and this Kerf runs on " +
               name_of_machine(own_machine) + ". Build it again on this machine.";
    if (head.e_type != ET_DYN)
        return "is not a shared library but another kind of binary, so it is no Kerf plugin. Build it as a module "
               "(`kerf_add_plugin` does so), or remove it from the folder.";
    return ident[EI_CLASS] == ELFCLASS64 ? refusal_of_segments(file, head, size) : std::string();
}

}  // namespace kerf
