// SPDX-License-Identifier: Apache-2.0
#include "app/file_limit.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <string>
#include <vector>

#include "text/codes.h"

namespace kerf::app {
namespace {

constexpr rlim_t wanted_limit = 1024;

/// Returns how many more files can be opened, at most `min_open_files`.
std::size_t free_files() {
    std::vector<int> opened;
    while (opened.size() < min_open_files) {
        const int file = open("/dev/null", O_RDONLY | O_CLOEXEC);
        if (file < 0) break;
        opened.push_back(file);
    }
    for (const int file : opened) close(file);
    return opened.size();
}

}  // namespace

text::Diagnostics refusal_of_file_limit(std::size_t free, unsigned long limit) {
    return {text::error_about("kerf", text::code_text(text::Code::few_open_files),
                              "Too few files can be opened: got a limit of " + std::to_string(limit) +
                                  ", which leaves " + std::to_string(free) + ", expected " +
                                  std::to_string(min_open_files) +
                                  " or more. Write `ulimit -n 1024`, or end what has files open.")};
}

text::Diagnostics check_file_limit() {
    rlimit limit{};
    if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return {};
    if (limit.rlim_cur < wanted_limit && limit.rlim_max > limit.rlim_cur) {
        rlimit raised = limit;
        raised.rlim_cur = std::min(limit.rlim_max, wanted_limit);
        if (setrlimit(RLIMIT_NOFILE, &raised) == 0) limit = raised;
    }
    const std::size_t free = free_files();
    return free < min_open_files ? refusal_of_file_limit(free, static_cast<unsigned long>(limit.rlim_cur))
                                 : text::Diagnostics{};
}

}  // namespace kerf::app
