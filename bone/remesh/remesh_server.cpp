// SPDX-License-Identifier: Apache-2.0
#include "bone/remesh/remesh_server.h"

#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <iterator>

#include "bone/remesh/remesh_channel.h"
#include "bone/remesh/remesh_module.h"
#include "bone/remesh/shared_memory.h"
#include "core/plugin/check_tables.h"
#include "core/plugin/plugin_call.h"

namespace kerf::bone {
namespace {

using namespace remesh_channel;

pid_t parent = 0;

extern "C" void end_as_an_orphan(int /*signal*/) {
    if (getppid() != parent) _exit(1);
}

/// Gives this process lower priority than the loop, limits its memory, and ends it within a second of its parent. The
/// parent-death signal of Linux belongs to a thread: a child restarted by a worker would end with that worker.
void be_a_good_child() {
    parent = getppid();
    struct sigaction action {};
    action.sa_handler = end_as_an_orphan;
    action.sa_flags = SA_RESTART;
    sigaction(SIGALRM, &action, nullptr);
    const itimerval each_second{{1, 0}, {1, 0}};
    setitimer(ITIMER_REAL, &each_second, nullptr);
    constexpr rlim_t max_memory = rlim_t{16} << 30;  // [bytes] of address space
    const rlimit memory{max_memory, max_memory};
    setrlimit(RLIMIT_AS, &memory);
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    static_cast<void>(!nice(10));
}

template <class Packet>
bool send_packet(const Packet& packet) {
    return send(socket_fd, &packet, sizeof packet, MSG_NOSIGNAL) == static_cast<ssize_t>(sizeof packet);
}

template <std::size_t N>
void copy_text(char (&to)[N], const char* text) {
    std::snprintf(to, N, "%s", text);
}

}  // namespace

int serve_remeshing(const std::string& module_path, const std::string& strategy, void (*before)() noexcept,
                    void (*after)() noexcept) {
    be_a_good_child();
    std::string error;
    const auto module = RemeshModule::open(module_path, error);
    const kerf_component* component = module != nullptr ? module->find(strategy) : nullptr;
    const kerf_remesher* remesher = component != nullptr ? component->remesher : nullptr;
    if (module != nullptr && remesher == nullptr) error = module_path + ": it has no strategy `" + strategy + "`.";
    Hello hello;
    static_assert(std::size(Hello{}.defaults) == max_table_rows);
    copy_text(hello.fault, error.c_str());
    if (remesher != nullptr) {
        hello.scope = remesher->scope;
        hello.parameter_count = component->param_count;
        for (std::uint32_t i = 0; i < component->param_count; ++i) hello.defaults[i] = component->params[i].def;
        copy_text(hello.plugin_id, module->entry().plugin_id);
        copy_text(hello.plugin_version, module->entry().plugin_version);
        copy_text(hello.kernel, remesher->kernel);
    }
    if (!send_packet(hello) || remesher == nullptr) return 1;

    SharedMemory request = SharedMemory::of(request_fd), result = SharedMemory::of(result_fd);
    void* cache = remesher->cache_new != nullptr ? remesher->cache_new() : nullptr;
    for (;;) {
        RequestPacket request_packet;
        const ssize_t got = recv(socket_fd, &request_packet, sizeof request_packet, 0);
        if (got < 0 && errno == EINTR) continue;
        if (got != static_cast<ssize_t>(sizeof request_packet)) break;  // the parent closed its end
        ResultPacket answer;
        answer.number = request_packet.number;
        answer.out.size = sizeof answer.out;
        if (request.map(request_packet.request_capacity) && result.map(request_packet.result_capacity)) {
            kerf_arena from = request.arena(), to = result.arena();
            from.used = request_packet.request_used;
            to.used = 64;  // an offset of 0 means none
            before();
            answer.status = call_remesh(*component, request_packet.in, from, to, answer.out, cache);
            after();
        } else {
            copy_text(answer.out.message, "the shared memory cannot be mapped");
        }
        if (!send_packet(answer)) break;
    }
    if (remesher->cache_drop != nullptr && cache != nullptr) remesher->cache_drop(cache);
    return 0;
}

}  // namespace kerf::bone
