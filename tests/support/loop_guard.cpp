// SPDX-License-Identifier: Apache-2.0
#include "tests/support/loop_guard.h"

#include <dlfcn.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <pthread.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <typeinfo>

// These stand before the C library's own and pass everything on to them, for the whole test program and whatever it
// loads.
static thread_local kerf::test::Forbidden forbidden_count __attribute__((tls_model("initial-exec")));

kerf::test::Forbidden kerf::test::forbidden_here() noexcept { return forbidden_count; }

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
extern "C" {

void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);

void* malloc(std::size_t size) {
    ++forbidden_count.allocations;
    return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
    ++forbidden_count.allocations;
    return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) {
    ++forbidden_count.allocations;
    return __libc_realloc(memory, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
    ++forbidden_count.allocations;
    return __libc_memalign(alignment, size);
}
void free(void* memory) {
    if (memory != nullptr) ++forbidden_count.allocations;
    __libc_free(memory);
}

#define KERF_COUNT_LOCK(name, type)                                                         \
    int name(type* lock) noexcept {                                                         \
        static const auto real = reinterpret_cast<int (*)(type*)>(dlsym(RTLD_NEXT, #name)); \
        ++forbidden_count.locks;                                                            \
        return real(lock);                                                                  \
    }
KERF_COUNT_LOCK(pthread_mutex_lock, pthread_mutex_t)
KERF_COUNT_LOCK(pthread_mutex_trylock, pthread_mutex_t)
KERF_COUNT_LOCK(pthread_rwlock_rdlock, pthread_rwlock_t)
KERF_COUNT_LOCK(pthread_rwlock_wrlock, pthread_rwlock_t)
KERF_COUNT_LOCK(pthread_cond_signal, pthread_cond_t)
KERF_COUNT_LOCK(pthread_cond_broadcast, pthread_cond_t)

[[noreturn]] void __cxa_throw(void* what, std::type_info* type, void (*destroy)(void*)) {
    static const auto real =
        reinterpret_cast<void (*)(void*, std::type_info*, void (*)(void*))>(dlsym(RTLD_NEXT, "__cxa_throw"));
    ++forbidden_count.throws;
    real(what, type, destroy);
    std::abort();
}

}  // extern "C"
#endif

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
