// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sqlite3.h>
#include <sys/wait.h>

#include <cstddef>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "tests/support/recorded_folder.h"
#include "tests/support/temporary_folder.h"

/// The program as a user or a script sees it.
namespace kerf::test {

/// What one call of the program came to.
struct Ended {
    int exit_code = -1;
    std::string out, err;
};

/// Runs a command of the shell. No badge of this machine has an effect: a test that needs some names its own folder.
inline Ended shell(const std::string& words) {
    const TemporaryFolder folder;
    const std::string command =
        "export KERF_BADGES=${KERF_BADGES:-off}; { " + words + "; } > " + (folder / "out") + " 2> " + (folder / "err");
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents_of(folder / "out"), contents_of(folder / "err")};
}

/// `environment` precedes the program, as in a shell. What `arguments` redirects stays redirected.
inline Ended kerf(const std::string& arguments, const std::string& environment = "") {
    return shell(environment + " " KERF_BUILD_DIR "/bin/kerf " + arguments);
}

/// How `kerf run` ended for an operation, and where its files are.
struct RanOperation {
    Ended ended;
    std::string folder;
};

/// Returns the run of a shipped procedure, "pedicle-screw/expert", that a ctest fixture has made; runs it into
/// `own` where there is none.
inline RanOperation ran_operation(const std::string& operation, const TemporaryFolder& own) {
    if (const std::string folder = recorded_folder(operation); !folder.empty()) {
        const std::string status = contents_of(folder + ".status");
        if (status.empty()) throw std::runtime_error(folder + ": its fixture has left nothing");
        return {{std::atoi(status.c_str()), contents_of(folder + ".out"), ""}, folder};
    }
    const std::size_t slash = operation.find('/');
    const std::string folder = own / "run";
    return {kerf("run " KERF_SOURCE_DIR "/procedures/" + operation.substr(0, slash) + ".yaml --hand " +
                 operation.substr(slash + 1) + " --out " + folder),
            folder};
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
