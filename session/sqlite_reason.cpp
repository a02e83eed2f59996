// SPDX-License-Identifier: Apache-2.0
#include "session/sqlite_reason.h"

#include <sqlite3.h>
#include <sys/resource.h>

#include <cerrno>

#include "text/system_reason.h"

namespace kerf::session {
namespace {

constexpr int primary(int code) noexcept { return code & 0xff; }

/// Returns errno of a failed access to a file; 0 if it is unknown. SQLite does not always keep that of a failed write.
int system_error(sqlite3* database, int code) {
    if (const int error = database != nullptr ? sqlite3_system_errno(database) : 0; error != 0) return error;
    const bool is_write = code == SQLITE_IOERR || code == SQLITE_IOERR_WRITE || code == SQLITE_IOERR_SHMSIZE;
    rlimit limit{};
    const bool is_limited = getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
    return is_write && is_limited ? EFBIG : 0;
}

}  // namespace

std::string outside_reason(sqlite3* database, int code) {
    if (database != nullptr && primary(sqlite3_extended_errcode(database)) == primary(code))
        code = sqlite3_extended_errcode(database);
    const int error = system_error(database, code);
    const std::string cause = error != 0 ? text::system_reason(error) : std::string(sqlite3_errstr(code));
    switch (primary(code)) {
        case SQLITE_FULL:
            return text::system_reason(ENOSPC);
        case SQLITE_NOMEM:
            return text::system_reason(ENOMEM);
        case SQLITE_BUSY:
        case SQLITE_LOCKED:
        case SQLITE_PROTOCOL:
            return "another program has locked the file. Wait until that has ended";
        case SQLITE_IOERR:
            if (code == SQLITE_IOERR_CORRUPTFS || code == SQLITE_IOERR_DATA) return {};
            if (code == SQLITE_IOERR_NOMEM) return text::system_reason(ENOMEM);
            return error == EFBIG || error == ENOSPC || error == EDQUOT || error == ENOMEM
                       ? cause
                       : "the disk reports an error (" + cause + "). Check the disk, or copy the file to another one";
        case SQLITE_CANTOPEN:
            return "a file could not be opened (" + cause + "). Check the permissions of its folder";
        case SQLITE_PERM:
        case SQLITE_AUTH:
        case SQLITE_READONLY:
            return std::string(sqlite3_errstr(code)) + ". Check the permissions of the file and its folder";
        default:
            return {};
    }
}

}  // namespace kerf::session
