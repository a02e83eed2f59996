// SPDX-License-Identifier: Apache-2.0
#include "text/system_reason.h"

#include <sys/resource.h>

#include <cerrno>
#include <system_error>

namespace kerf::text {
namespace {

std::string too_large() {
    rlimit limit{};
    if (getrlimit(RLIMIT_FSIZE, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
        return "the file is too large for its disk. Give a folder on another disk";
    return "the limit of file size is " + std::to_string(limit.rlim_cur / 1024) + " kB. Raise it (`ulimit -f`)";
}

}  // namespace

std::string system_reason(int error) {
    switch (error) {
        case ENOSPC:
        case EDQUOT:
            return "the disk is full. Free some space, or give a folder on another disk";
        case EFBIG:
            return too_large();
        case ENOMEM:
            return "out of memory. Free some, or raise the limit (`ulimit -v`)";
        default:
            return std::generic_category().message(error);
    }
}

const char* thread_advice() noexcept {
    rlimit limit{};
    const bool is_memory_limited = getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
    return is_memory_limited ? "The memory is limited: raise its limit (`ulimit -v`)"
                             : "End other programs, or raise the limit (`ulimit -u`)";
}

}  // namespace kerf::text
