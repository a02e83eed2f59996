// SPDX-License-Identifier: Apache-2.0
#include "text/file_digest.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <span>

#include "text/sha256.h"
#include "text/system_reason.h"

namespace kerf::text {
namespace {

/// Reads an open file to its end. Returns 0, or errno.
int read_all(int file, Sha256& hash) {
    std::array<unsigned char, 65536> buffer{};
    while (true) {
        const ssize_t count = read(file, buffer.data(), buffer.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return errno;
        if (count == 0) return 0;
        hash.add(std::span(buffer).first(static_cast<std::size_t>(count)));
    }
}

/// Reads the file once. Its error is empty, and so is its digest, if the file changed meanwhile.
FileDigest read_once(const std::string& path) {
    const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);  // a FIFO must not wait for a writer
    if (file < 0) return {"", {}, system_reason(errno)};
    FileDigest read{"", stamp_of(file), ""};
    struct stat opened {};
    Sha256 hash;
    if (fstat(file, &opened) != 0 || !S_ISREG(opened.st_mode))
        read.error = "it is not a regular file";
    else if (const int error = read_all(file, hash); error != 0)
        read.error = system_reason(error);
    else if (stamp_of(file) == read.stamp && stamp_of(path) == read.stamp)
        read.digest = hash.finish();
    close(file);
    return read;
}

}  // namespace

FileDigest digest_of_file(const std::string& path) {
    constexpr int attempts = 3;
    for (int attempt = 0; attempt < attempts; ++attempt)
        if (FileDigest read = read_once(path); !read.digest.empty() || !read.error.empty()) return read;
    return {"", {}, "it changes while it is read"};
}

}  // namespace kerf::text
