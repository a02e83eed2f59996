// SPDX-License-Identifier: Apache-2.0
#include "core/import/import_report.h"

#include <cstdio>
#include <fstream>

#include "core/field/fnv1a.h"

namespace kerf {

bool hash_of_file(const std::string& file, std::uint64_t& hash) {
    std::ifstream in(file, std::ios::binary);
    Fnv1a sum;
    std::vector<char> buffer(1 << 16);
    while (in) {
        in.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
        sum.add({buffer.data(), static_cast<std::size_t>(in.gcount())});
    }
    hash = sum.value();
    return in.eof();
}

std::string rounded(double value, int digits) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*f", digits, value);
    for (char& c : text)
        if (c == ',') c = '.';
    return text;
}

}  // namespace kerf
