// SPDX-License-Identifier: Apache-2.0
#include "app/standard_streams.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <mutex>

#include "core/plugin/own_streams.h"
#include "text/plain_numbers.h"
#include "text/printable_lines.h"

namespace kerf::app {

namespace {

void write_to(std::FILE* stream, std::string_view text) {
    const std::string safe = text::printable_lines(text);
    std::fwrite(safe.data(), 1, safe.size(), stream);
}

int first_error = 0;  // of stdout; the stream itself does not keep its code

/// What an ErrorCopy has copied.
struct Copied {
    std::mutex mutex;
    bool is_on = false;
    std::string text;
};
Copied& copied() {
    static Copied one;
    return one;
}

}  // namespace

void print(std::string_view text) {
    errno = 0;
    write_to(own_output(), text);
    if (std::ferror(own_output()) != 0 && first_error == 0) first_error = errno;
}

void print_error(std::string_view text) {
    std::fflush(own_output());  // keeps the order if both streams go to one file
    if (std::ferror(own_output()) != 0 && first_error == 0) first_error = errno;
    write_to(own_errors(), text);
    const std::lock_guard lock(copied().mutex);
    if (copied().is_on) copied().text += text::printable_lines(text);
}

ErrorCopy::ErrorCopy() {
    const std::lock_guard lock(copied().mutex);
    copied().is_on = true;
    copied().text.clear();
}

ErrorCopy::~ErrorCopy() {
    const std::lock_guard lock(copied().mutex);
    copied().is_on = false;
}

std::string ErrorCopy::text() const {
    const std::lock_guard lock(copied().mutex);
    return copied().text;
}

ExitCode complain(const std::string& error, ExitCode code) {
    print_error("kerf: " + error + "\n");
    return code;
}

std::string formatted(const char* format, ...) {
    const text::PlainNumbers point;
    std::va_list values, again;
    va_start(values, format);
    va_copy(again, values);
    const int size = std::vsnprintf(nullptr, 0, format, values);
    std::string text(size > 0 ? static_cast<std::size_t>(size) : 0, '\0');
    std::vsnprintf(text.data(), text.size() + 1, format, again);
    va_end(again);
    va_end(values);
    return text;
}

void occupy_closed_streams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (fcntl(stream, F_GETFD) != -1 || errno != EBADF) continue;
        // The lowest free descriptor is this one. It is opened in the wrong direction, so that using it fails.
        (void)open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
    }
}

ExitCode close_stdout(ExitCode code) {
    errno = 0;
    const bool has_failed = std::ferror(own_output()) != 0;
    if (std::fclose(own_output()) == 0 && !has_failed) return code;
    if (first_error == 0) first_error = errno;
    const char* why = first_error == EBADF ? "it is closed" : first_error != 0 ? std::strerror(first_error) : "unknown";
    std::fprintf(own_errors(),
                 "kerf: stdout could not be written: %s. The output is incomplete. Write it to another file.\n", why);
    return exit_fault;
}

}  // namespace kerf::app
