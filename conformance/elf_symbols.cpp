// SPDX-License-Identifier: Apache-2.0
#include "conformance/elf_symbols.h"

#include <elf.h>
#include <link.h>

#include <cstddef>
#include <cstring>
#include <fstream>
#include <iterator>

namespace kerf::conformance {

namespace {

/// A file's bytes, read within their bounds.
class Bytes {
public:
    explicit Bytes(std::string bytes) : bytes_(std::move(bytes)) {}
    template <class T>
    [[nodiscard]] T at(std::size_t offset) const noexcept {
        T value{};
        if (offset <= bytes_.size() && sizeof(T) <= bytes_.size() - offset)
            std::memcpy(&value, bytes_.data() + offset, sizeof(T));
        return value;
    }
    [[nodiscard]] std::string text_at(std::size_t offset) const {
        if (offset >= bytes_.size()) return {};
        return {bytes_.data() + offset, strnlen(bytes_.data() + offset, bytes_.size() - offset)};
    }

private:
    std::string bytes_;
};

void append_folders(const std::string& path, std::vector<std::string>& to) {
    for (std::size_t at = 0; at <= path.size();) {
        const std::size_t end = std::min(path.find(':', at), path.size());
        to.push_back(path.substr(at, end - at));
        at = end + 1;
    }
}

}  // namespace

std::optional<ElfSymbols> elf_symbols(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    const Bytes bytes(std::string(std::istreambuf_iterator<char>(file), {}));
    const auto head = bytes.at<ElfW(Ehdr)>(0);
    const auto section = [&](std::size_t i) { return bytes.at<ElfW(Shdr)>(head.e_shoff + i * sizeof(ElfW(Shdr))); };
    ElfSymbols found;
    bool has_symbols = false;
    for (std::size_t i = 0; i < head.e_shnum; ++i) {
        const auto table = section(i);
        const auto names = section(table.sh_link);
        if (table.sh_type == SHT_DYNSYM) {
            has_symbols = true;
            for (std::size_t s = 1; s < table.sh_size / sizeof(ElfW(Sym)); ++s) {
                const auto symbol = bytes.at<ElfW(Sym)>(table.sh_offset + s * sizeof(ElfW(Sym)));
                const int binding = ELF64_ST_BIND(symbol.st_info);  // the same bits in both classes
                if (symbol.st_shndx == SHN_UNDEF || binding == STB_LOCAL) continue;
                found.exported.push_back(bytes.text_at(names.sh_offset + symbol.st_name));
                if (binding == STB_GNU_UNIQUE) found.unique.push_back(found.exported.back());
            }
        }
        if (table.sh_type == SHT_DYNAMIC)
            for (std::size_t d = 0; d < table.sh_size / sizeof(ElfW(Dyn)); ++d) {
                const auto entry = bytes.at<ElfW(Dyn)>(table.sh_offset + d * sizeof(ElfW(Dyn)));
                const std::string text = bytes.text_at(names.sh_offset + entry.d_un.d_val);
                if (entry.d_tag == DT_NEEDED) found.needed.push_back(text);
                if (entry.d_tag == DT_RPATH || entry.d_tag == DT_RUNPATH) append_folders(text, found.run_path);
            }
    }
    for (std::size_t i = 0; i < head.e_phnum; ++i) {
        const auto segment = bytes.at<ElfW(Phdr)>(head.e_phoff + i * sizeof(ElfW(Phdr)));
        if (segment.p_type == PT_GNU_STACK) found.has_executable_stack = (segment.p_flags & PF_X) != 0;
    }
    if (!has_symbols) return std::nullopt;
    return found;
}

}  // namespace kerf::conformance
