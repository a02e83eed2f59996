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

bool is_limited(__rlimit_resource resource) noexcept {
    rlimit limit{};
    return getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
}

/// Returns advice for the memory that is limited; null if none is.
const char* memory_advice() noexcept {
    if (is_limited(RLIMIT_AS)) return "The memory is limited: raise its limit (`ulimit -v`)";
    if (is_limited(RLIMIT_DATA)) return "The memory is limited: raise its limit (`ulimit -d`)";
    return nullptr;
}

}  // namespace

const char* memory_limit_command() noexcept {
    return is_limited(RLIMIT_DATA) && !is_limited(RLIMIT_AS) ? "ulimit -d" : "ulimit -v";
}

std::string system_reason(int error) {
    switch (error) {
        case ENOSPC:
        case EDQUOT:
            return "the disk is full. Free some space, or give a folder on another disk";
        case EFBIG:
            return too_large();
        case ENOMEM:
            return std::string("out of memory. Free some, or raise the limit (`") + memory_limit_command() + "`)";
        default:
            return std::generic_category().message(error);
    }
}

std::string with_memory_limit(std::string problem) {
    if (const char* const advice = memory_advice(); advice != nullptr) problem += std::string(" ") + advice + ".";
    return problem;
}

const char* thread_advice() noexcept {
    const char* const of_memory = memory_advice();
    return of_memory != nullptr ? of_memory : "End other programs, or raise the limit (`ulimit -u`)";
}

}  // namespace kerf::text
