// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/watch/watch.h"

#include <dlfcn.h>
#include <linux/prctl.h>
#include <pthread.h>
#include <semaphore.h>
#include <sys/prctl.h>
#include <sys/time.h>
#include <sys/ucontext.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <typeinfo>

using kerf::conformance::Forbidden;
using kerf::conformance::Watched;

namespace {

struct Watch {
    bool is_on = false;
    Watched seen;
    kerf::conformance::Counts counts{};
};
// With this TLS model, the first access on a thread allocates nothing.
thread_local Watch watch __attribute__((tls_model("initial-exec")));

/// Unused under sanitizers, which watch the calls below themselves.
[[maybe_unused]] void note(Forbidden kind, const char* function) noexcept {
    ++watch.counts[static_cast<std::size_t>(kind)];
    if (!watch.is_on) return;
    const char*& first = watch.seen.function[static_cast<std::size_t>(kind)];
    if (first == nullptr) first = function;
}

}  // namespace

// ---- calls of the C and C++ libraries -----------------------------------------------------------------------------

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

namespace {

/// The C library's function of this name. `find`, or else its first call, searches for it.
template <class Function>
class Real {
public:
    explicit constexpr Real(const char* name) noexcept : name_(name) {}
    template <class... Arguments>
    auto operator()(Arguments... arguments) noexcept {
        if (function_ == nullptr) find();  // a constructor of another library may call it early
        return function_(arguments...);
    }
    bool find() noexcept {
        function_ = reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name_));
        return function_ != nullptr;
    }

private:
    const char* name_;
    Function* function_ = nullptr;
};

}  // namespace

extern "C" {

void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);

void* malloc(std::size_t size) {
    note(Forbidden::allocation, "malloc");
    return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
    note(Forbidden::allocation, "calloc");
    return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) {
    note(Forbidden::allocation, "realloc");
    return __libc_realloc(memory, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
    note(Forbidden::allocation, "aligned_alloc");
    return __libc_memalign(alignment, size);
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
    note(Forbidden::allocation, "posix_memalign");
    *memory = __libc_memalign(alignment, size);
    return *memory == nullptr ? ENOMEM : 0;
}
void free(void* memory) {
    if (memory != nullptr) note(Forbidden::allocation, "free");
    __libc_free(memory);
}

// Defines a function that notes its call and calls the C library's function of the same name. That one is found before
// `main`, because the search may allocate.
#define KERF_WATCH(kind, result, name, parameters, ...)          \
    static constinit Real<result parameters> real_##name(#name); \
    static const bool has_##name = real_##name.find();           \
    result name parameters {                                     \
        static_cast<void>(has_##name);                           \
        note(Forbidden::kind, #name);                            \
        return real_##name(__VA_ARGS__);                         \
    }

KERF_WATCH(lock, int, pthread_mutex_lock, (pthread_mutex_t * m) noexcept, m)
KERF_WATCH(lock, int, pthread_mutex_trylock, (pthread_mutex_t * m) noexcept, m)
KERF_WATCH(lock, int, pthread_rwlock_rdlock, (pthread_rwlock_t * l) noexcept, l)
KERF_WATCH(lock, int, pthread_rwlock_wrlock, (pthread_rwlock_t * l) noexcept, l)
KERF_WATCH(lock, int, pthread_spin_lock, (pthread_spinlock_t * l) noexcept, l)
KERF_WATCH(lock, int, pthread_cond_signal, (pthread_cond_t * c) noexcept, c)
KERF_WATCH(lock, int, pthread_cond_broadcast, (pthread_cond_t * c) noexcept, c)
KERF_WATCH(lock, int, pthread_cond_wait, (pthread_cond_t * c, pthread_mutex_t* m), c, m)
KERF_WATCH(lock, int, sem_wait, (sem_t * s), s)
KERF_WATCH(lock, int, sem_post, (sem_t * s) noexcept, s)

KERF_WATCH(output, int, puts, (const char* text), text)
KERF_WATCH(output, int, putchar, (int c), c)
KERF_WATCH(output, int, fputs, (const char* text, FILE* file), text, file)
KERF_WATCH(output, int, fputc, (int c, FILE* file), c, file)
KERF_WATCH(output, int, putc, (int c, FILE* file), c, file)
KERF_WATCH(output, std::size_t, fwrite, (const void* from, std::size_t size, std::size_t count, FILE* file), from, size,
           count, file)
KERF_WATCH(output, int, vprintf, (const char* format, va_list list), format, list)
KERF_WATCH(output, int, vfprintf, (FILE * file, const char* format, va_list list), file, format, list)
KERF_WATCH(output, int, fflush, (FILE * file), file)
KERF_WATCH(output, FILE*, fopen, (const char* path, const char* mode), path, mode)

int printf(const char* format, ...) {
    va_list list;
    va_start(list, format);
    const int count = vprintf(format, list);
    va_end(list);
    return count;
}
int fprintf(FILE* file, const char* format, ...) {
    va_list list;
    va_start(list, format);
    const int count = vfprintf(file, format, list);
    va_end(list);
    return count;
}
// With _FORTIFY_SOURCE, <stdio.h> calls these instead.
int __printf_chk(int, const char* format, ...) {
    va_list list;
    va_start(list, format);
    const int count = vprintf(format, list);
    va_end(list);
    return count;
}
int __fprintf_chk(FILE* file, int, const char* format, ...) {
    va_list list;
    va_start(list, format);
    const int count = vfprintf(file, format, list);
    va_end(list);
    return count;
}

KERF_WATCH(clock, int, clock_gettime, (clockid_t id, timespec* t) noexcept, id, t)
KERF_WATCH(clock, int, gettimeofday, (timeval* __restrict t, void* __restrict z) noexcept, t, z)
KERF_WATCH(clock, time_t, time, (time_t * t) noexcept, t)
KERF_WATCH(clock, clock_t, clock, () noexcept, )
KERF_WATCH(random, int, rand, () noexcept, )
KERF_WATCH(random, long, random, () noexcept, )
KERF_WATCH(random, double, drand48, () noexcept, )
KERF_WATCH(random, int, getentropy, (void* to, std::size_t size), to, size)
KERF_WATCH(thread, int, pthread_create,
           (pthread_t* __restrict thread, const pthread_attr_t* __restrict how, void* (*what)(void*),
            void* __restrict with) noexcept,
           thread, how, what, with)
KERF_WATCH(exception, void*, __cxa_allocate_exception, (std::size_t size) noexcept, size)
KERF_WATCH(initialisation, int, __cxa_guard_acquire, (long long* guard), guard)

}  // extern "C"

bool kerf::conformance::can_watch() noexcept { return true; }
#else
bool kerf::conformance::can_watch() noexcept { return false; }
#endif

const kerf::conformance::Counts& kerf::conformance::counted_here() noexcept { return watch.counts; }

void kerf::conformance::start_watching() noexcept {
    watch.seen = {};
    watch.is_on = true;
}
kerf::conformance::Watched kerf::conformance::stop_watching() noexcept {
    watch.is_on = false;
    return watch.seen;
}

// ---- system calls -------------------------------------------------------------------------------------------------

#if defined(PR_SET_SYSCALL_USER_DISPATCH) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

namespace {

volatile char selector = SYSCALL_DISPATCH_FILTER_ALLOW;
volatile long first_call = -1;

/// The kernel skips the caught call. Later calls are allowed, so that the handler can return.
void on_system_call(int, siginfo_t* info, void*) {
    selector = SYSCALL_DISPATCH_FILTER_ALLOW;
    if (first_call < 0) first_call = info->si_syscall;
}

bool set_dispatch(unsigned long how) noexcept {
    return prctl(PR_SET_SYSCALL_USER_DISPATCH, how, 0, 0, how == PR_SYS_DISPATCH_ON ? &selector : nullptr) == 0;
}

}  // namespace

bool kerf::conformance::can_watch_system_calls() noexcept {
    const bool can = set_dispatch(PR_SYS_DISPATCH_ON);
    if (can) set_dispatch(PR_SYS_DISPATCH_OFF);
    return can;
}
void kerf::conformance::start_watching_system_calls() noexcept {
    struct sigaction action {};
    action.sa_flags = SA_SIGINFO;
    action.sa_sigaction = &on_system_call;
    sigaction(SIGSYS, &action, nullptr);
    first_call = -1;
    set_dispatch(PR_SYS_DISPATCH_ON);
    selector = SYSCALL_DISPATCH_FILTER_BLOCK;
}
long kerf::conformance::stop_watching_system_calls() noexcept {
    selector = SYSCALL_DISPATCH_FILTER_ALLOW;
    set_dispatch(PR_SYS_DISPATCH_OFF);
    return first_call;
}
#else
bool kerf::conformance::can_watch_system_calls() noexcept { return false; }
void kerf::conformance::start_watching_system_calls() noexcept {}
long kerf::conformance::stop_watching_system_calls() noexcept { return -1; }
#endif
