// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sqlite3.h>
#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include "tests/support/temporary_folder.h"

/// The program as a user or a script sees it.
namespace kerf::test {

/// What one call of the program came to.
struct Ended {
    int exit_code = -1;
    std::string out, err;
};

/// `environment` stands before the program, as in a shell. What `arguments` redirects stays redirected.
inline Ended kerf(const std::string& arguments, const std::string& environment = "") {
    const TemporaryFolder folder;
    const std::string command = "{ " + environment + " " KERF_BUILD_DIR "/bin/kerf " + arguments + "; } > " +
                                (folder / "out") + " 2> " + (folder / "err");
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents_of(folder / "out"), contents_of(folder / "err")};
}

/// Changes a database.
inline bool changed(const std::string& path, const std::string& sql) {
    sqlite3* database = nullptr;
    const bool is_done = sqlite3_open(path.c_str(), &database) == SQLITE_OK &&
                         sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK;
    sqlite3_close(database);
    return is_done;
}

}  // namespace kerf::test
