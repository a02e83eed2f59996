// SPDX-License-Identifier: Apache-2.0
// Runs a target once over the files of a folder: what `./dev fuzz` starts from, and all that it ever found. Files whose
// name begins with `good` must be read: a corpus that the readers refuse at the first byte would find nothing.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/fuzz/fuzz_target.h"
#include "tests/support/temporary_folder.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count);

int main(int count, char** words) {
    if (count != 2 || !std::filesystem::is_directory(words[1])) {
        std::fprintf(stderr, "usage: %s FOLDER\n", words[0]);
        return 2;
    }
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(words[1])) files.push_back(entry.path());
    std::sort(files.begin(), files.end());

    int good = 0, refused = 0;
    for (const auto& file : files) {
        const std::string name = file.filename().string(), input = kerf::test::contents_of(file.string());
        std::printf("%s\n", name.c_str());
        std::fflush(stdout);  // the last one told is the one that ended the process
        LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
        if (!name.starts_with("good")) continue;
        ++good;
        if (kerf::fuzz::reads(input)) continue;
        ++refused;
        std::fprintf(stderr, "%s is refused. Bring tests/fuzz/make_corpus.cpp up to date, and run it.\n", name.c_str());
    }
    if (good == 0) std::fprintf(stderr, "%s holds nothing good to start from.\n", words[1]);
    return good > 0 && refused == 0 ? 0 : 1;
}
