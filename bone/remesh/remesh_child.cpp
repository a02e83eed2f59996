// SPDX-License-Identifier: Apache-2.0
#include "bone/remesh/remesh_child.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <iterator>
#include <utility>

#include "bone/remesh/remesh_channel.h"

extern "C" char** environ;

namespace kerf::bone {
namespace {

using namespace remesh_channel;
using Clock = std::chrono::steady_clock;

enum class Received { packet, late, closed };

/// Waits for one packet.
template <class Packet>
Received receive(int socket, Packet& packet, Clock::time_point end) {
    for (;;) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
        pollfd watched{socket, POLLIN, 0};
        const int ready = poll(&watched, 1, static_cast<int>(std::clamp<long long>(left, 0, 1'000'000'000)));
        if (ready < 0 && errno == EINTR) continue;
        if (ready == 0) return Received::late;
        const ssize_t got = recv(socket, &packet, sizeof packet, 0);
        if (got < 0 && errno == EINTR) continue;
        return got == static_cast<ssize_t>(sizeof packet) ? Received::packet : Received::closed;
    }
}

/// Returns a text of fixed size that may lack its terminating NUL.
template <std::size_t N>
std::string text_of(const char (&text)[N]) {
    return {text, strnlen(text, N)};
}

RemeshResult failed(std::string why) {
    RemeshResult result;
    result.message = std::move(why);
    return result;
}

}  // namespace

std::unique_ptr<RemeshChild> RemeshChild::start(const RemeshProgram& program, std::string& error) {
    std::unique_ptr<RemeshChild> child(new RemeshChild(program));
    child->request_ = SharedMemory::make("kerf-remesh-request");
    child->result_ = SharedMemory::make("kerf-remesh-result");
    error = child->request_.fd() < 0 || child->result_.fd() < 0 ? "the system gives no shared memory" : child->spawn();
    return error.empty() ? std::move(child) : nullptr;
}

RemeshChild::~RemeshChild() { end(); }

std::string RemeshChild::spawn() {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) return "the system gives no sockets";
    // Above the child's own numbers, so that no descriptor is overwritten before it is copied.
    const int in_child = fcntl(ends[1], F_DUPFD_CLOEXEC, 10), request = fcntl(request_.fd(), F_DUPFD_CLOEXEC, 10),
              result = fcntl(result_.fd(), F_DUPFD_CLOEXEC, 10);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, in_child, socket_fd);
    posix_spawn_file_actions_adddup2(&actions, request, request_fd);
    posix_spawn_file_actions_adddup2(&actions, result, result_fd);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t none;  // a caller that blocks signals must not block them in the child
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setpgroup(&attributes, 0);  // only the parent handles Ctrl-C
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
    char* const arguments[] = {program_.program.data(), program_.module.data(), program_.strategy.data(), nullptr};
    const int fault = in_child < 0 || request < 0 || result < 0
                          ? EMFILE
                          : posix_spawn(&pid_, program_.program.c_str(), &actions, &attributes, arguments, environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    for (const int fd : {in_child, request, result, ends[1]})
        if (fd >= 0) close(fd);
    socket_ = ends[0];
    if (fault != 0) {
        pid_ = -1;
        end();
        return program_.program + " cannot be started: " + std::strerror(fault);
    }
    Hello hello;
    constexpr auto limit = std::chrono::seconds(20);  // for a machine under load
    if (receive(socket_, hello, Clock::now() + limit) != Received::packet)
        return program_.program + " does not answer: it " + end();
    if (hello.scope == 0) {
        std::string why = text_of(hello.fault);
        end();
        return why;
    }
    scope_ = hello.scope;
    if (program_.parameters.empty()) {
        const auto count = std::min<std::size_t>(hello.parameter_count, std::size(hello.defaults));
        program_.parameters.assign(hello.defaults, hello.defaults + count);
    }
    plugin_ = text_of(hello.plugin_id) + " " + text_of(hello.plugin_version);
    kernel_ = text_of(hello.kernel);
    return {};
}

std::string RemeshChild::end() {
    if (socket_ >= 0) close(std::exchange(socket_, -1));
    if (pid_ <= 0) return "was not running";
    int status = 0;
    pid_t ended = 0;
    // A status of its own gives more information than our signal.
    for (int wait = 0; wait < 20 && ended == 0; ++wait) {
        ended = waitpid(pid_, &status, WNOHANG);
        if (ended == 0) usleep(1000);
    }
    bool is_killed = false;
    if (ended == 0) {
        is_killed = true;
        kill(pid_, SIGKILL);
        while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
        }
    }
    pid_ = -1;
    if (is_killed) return "was ended";
    if (WIFSIGNALED(status)) return "was ended by signal " + std::to_string(WTERMSIG(status));
    return "ended with status " + std::to_string(WEXITSTATUS(status));
}

RemeshResult RemeshChild::lost(const std::string& why) {
    const std::string how = end();
    if (restarts_ >= max_restarts)
        return failed(why + ": the process " + how + " and is not started again after " + std::to_string(max_restarts) +
                      " restarts");
    ++restarts_;
    const std::string fault = spawn();
    return failed(why + ": the process " + how + (fault.empty() ? " and was started again" : "; " + fault));
}

RemeshResult RemeshChild::remesh(const RemeshRequest& request, std::chrono::milliseconds limit) {
    RemeshResult result = answer_of(request, limit);
    if (!is_repeated_ && scope_ == KERF_REMESH_PATCH && result.status == KERF_OK) {
        is_repeated_ = true;
        const RemeshResult again = answer_of(request, limit);
        is_constant_ = again.status == result.status && has_same_bytes(again.mesh, result.mesh);
    }
    return is_constant_ ? std::move(result) : failed("the same request gave another result when it was made again");
}

RemeshResult RemeshChild::answer_of(const RemeshRequest& request, std::chrono::milliseconds limit) {
    if (!is_running()) return failed("the remeshing process is no longer running");
    if (!request_.grow(request_bytes(request)) || !result_.grow(result_bytes(request)))
        return failed("the system gives no memory for this mesh");
    RequestPacket request_packet;
    kerf_arena arena = request_.arena();
    if (!pack(request, program_.parameters, arena, request_packet.in))
        return failed("the request does not fit its memory");
    if (program_.tolerance) request_packet.in.tolerance = *program_.tolerance;
    request_packet.number = ++number_;
    request_packet.request_capacity = arena.capacity;
    request_packet.result_capacity = result_.arena().capacity;
    request_packet.request_used = arena.used;
    if (send(socket_, &request_packet, sizeof request_packet, MSG_NOSIGNAL) !=
        static_cast<ssize_t>(sizeof request_packet))
        return lost("the request could not be sent");
    ResultPacket answer;
    const auto end = Clock::now() + limit;
    Received received = receive(socket_, answer, end);
    const bool is_cancelled = received == Received::late;
    if (is_cancelled) {
        std::atomic_ref(*reinterpret_cast<std::uint32_t*>(arena.base + request_packet.in.cancel)).store(1);
        constexpr auto grace = std::chrono::milliseconds(200);
        received = receive(socket_, answer, Clock::now() + grace);
    }
    const std::string no_answer = "no answer within " + std::to_string(limit.count()) + " ms";
    if (received == Received::late) return lost(no_answer);
    if (received == Received::closed || answer.number != request_packet.number) return lost("the answer was cut short");
    RemeshResult result = unpack(answer.status, answer.out, result_.arena());
    if (result.status == KERF_REMESH_CANCELLED)
        result.message = is_cancelled ? no_answer : "it answers CANCELLED, and was not cancelled";
    return result;
}

}  // namespace kerf::bone
