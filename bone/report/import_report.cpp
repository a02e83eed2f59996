// SPDX-License-Identifier: Apache-2.0
#include "bone/report/import_report.h"

#include <charconv>
#include <cstddef>
#include <fstream>

#include "core/field/fnv1a.h"
#include "text/regular_file.h"

namespace kerf::bone {

bool hash_of_file(const std::string& file, std::uint64_t& hash) {
    std::ifstream in = text::open_regular_file(file);
    Fnv1a sum;
    std::vector<char> buffer(1 << 16);
    while (in) {
        in.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
        sum.add({buffer.data(), static_cast<std::size_t>(in.gcount())});
    }
    hash = sum.value();
    return in.eof();
}

std::uint64_t hash_of_hashes(const std::vector<std::uint64_t>& hashes) {
    Fnv1a sum;
    for (const std::uint64_t one : hashes) sum.add_bytes(one, 8);
    return sum.value();
}

std::string rounded(double value, int digits) {
    char text[400];
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, digits);
    return {text, end.ptr};
}

}  // namespace kerf::bone
