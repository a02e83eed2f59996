// SPDX-License-Identifier: Apache-2.0
#include "tests/support/loop_guard.h"

#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/haptics/watch/watch.h"

kerf::test::Forbidden kerf::test::forbidden_here() noexcept {
    using Kind = conformance::Forbidden;
    const conformance::Counts& counts = conformance::counted_here();
    const auto count = [&](Kind kind) { return counts[static_cast<std::size_t>(kind)]; };
    return {count(Kind::allocation), count(Kind::lock), count(Kind::exception)};
}

// The strict mode would forbid reading the processor's counter as well, which is no system call.
static bool forbid_all_but_exit() {
    sock_filter program[] = {BPF_STMT(BPF_LD | BPF_W | BPF_ABS, 0),  // the call's number
                             BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_exit, 0, 1),
                             BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
                             BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS)};
    const sock_fprog filter{sizeof program / sizeof program[0], program};
    return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) == 0;
}

kerf::test::SystemCalls kerf::test::system_calls_of(const std::function<void()>& work) {
    constexpr int no_seccomp = 77;
    const pid_t child = fork();
    if (child < 0) return SystemCalls::cannot_tell;
    if (child == 0) {
        if (!forbid_all_but_exit()) _exit(no_seccomp);
        work();
        syscall(SYS_exit, 0);  // the only way out
    }
    int status = 0;
    if (waitpid(child, &status, 0) != child) return SystemCalls::cannot_tell;
    if (WIFEXITED(status)) return WEXITSTATUS(status) == 0 ? SystemCalls::none : SystemCalls::cannot_tell;
    return SystemCalls::some;
}
