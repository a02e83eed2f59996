// SPDX-License-Identifier: Apache-2.0
#include "core/plugin/own_streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <csignal>

namespace kerf {

namespace {

// A plugin that closes the first descriptors does not meet these. The lower one is for a small limit of open files.
constexpr int preferred = 500, first_free = 10;

std::FILE *output = nullptr, *errors = nullptr;  // null: stdout and stderr
volatile std::sig_atomic_t error_file = STDERR_FILENO;

/// Opens a stream on a copy of a descriptor. Returns null if there is none.
std::FILE* copy_of(int descriptor) noexcept {
    int copy = fcntl(descriptor, F_DUPFD_CLOEXEC, preferred);
    if (copy < 0) copy = fcntl(descriptor, F_DUPFD_CLOEXEC, first_free);
    if (copy < 0) return nullptr;
    const int flags = fcntl(copy, F_GETFL);
    // A stream in the wrong direction is one that was closed: writing to it fails later, as it should.
    std::FILE* stream = fdopen(copy, (flags & O_ACCMODE) == O_RDONLY ? "r" : "w");
    if (stream == nullptr) close(copy);
    return stream;
}

}  // namespace

std::FILE* own_output() noexcept { return output != nullptr ? output : stdout; }
std::FILE* own_errors() noexcept { return errors != nullptr ? errors : stderr; }
int own_error_file() noexcept { return error_file; }

bool separate_streams(int file) noexcept {
    std::FILE* const of_output = copy_of(STDOUT_FILENO);
    std::FILE* const of_errors = copy_of(STDERR_FILENO);
    if (of_output == nullptr || of_errors == nullptr || dup2(file, STDOUT_FILENO) < 0 ||
        dup2(file, STDERR_FILENO) < 0) {
        if (of_output != nullptr) std::fclose(of_output);
        if (of_errors != nullptr) std::fclose(of_errors);
        return false;
    }
    std::setvbuf(of_errors, nullptr, _IONBF, 0);
    output = of_output;
    errors = of_errors;
    error_file = fileno(of_errors);
    return true;
}

void unite_streams() noexcept {
    output = errors = nullptr;
    error_file = STDERR_FILENO;
}

}  // namespace kerf
