// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace kerf::test {

/// A display without a screen, 1300 × 850 pixels, that belongs to this process and ends with it: by Xvfb.
class OwnDisplay {
public:
    /// Starts the display, and lets DISPLAY name it. Throws std::runtime_error if it does not start.
    OwnDisplay() {
        int ends[2];
        if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("there is no pipe");
        child_ = fork();
        if (child_ == 0) {
            prctl(PR_SET_PDEATHSIG, SIGTERM);
            dup2(ends[1], STDOUT_FILENO);
            dup2(open("/dev/null", O_WRONLY | O_CLOEXEC), STDERR_FILENO);
            execlp("Xvfb", "Xvfb", "-displayfd", "1", "-screen", "0", "1300x850x24", "-nolisten", "tcp", nullptr);
            _exit(127);
        }
        close(ends[1]);
        std::string number;
        for (char c = 0; read(ends[0], &c, 1) == 1 && c != '\n';) number += c;
        close(ends[0]);
        if (child_ < 0 || number.empty()) throw std::runtime_error("Xvfb does not start; install xvfb");
        setenv("DISPLAY", (":" + number).c_str(), 1);
    }
    ~OwnDisplay() {
        kill(child_, SIGTERM);
        waitpid(child_, nullptr, 0);
    }
    OwnDisplay(const OwnDisplay&) = delete;
    OwnDisplay& operator=(const OwnDisplay&) = delete;

private:
    pid_t child_ = -1;
};

}  // namespace kerf::test
