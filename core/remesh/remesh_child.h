// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include "core/remesh/remesh_request.h"
#include "core/remesh/shared_memory.h"

namespace kerf {

/// Where strategies come from.
struct RemeshProgram {
    std::string program;   ///< kerf-remesh
    std::string module;    ///< the shared library with the strategy
    std::string strategy;  ///< "exact"
};

/// A strategy in a process of its own. It is started once, before any loop runs: `posix_spawn` costs a running loop
/// nothing, `fork` would stop it for milliseconds. A child that dies or is late costs one request; it is killed and
/// started again, `most_restarts` times.   [worker] one thread at a time
class RemeshChild {
public:
    static constexpr int most_restarts = 3;

    /// Null: why not is in `error`, for people.   [main]
    static std::unique_ptr<RemeshChild> start(const RemeshProgram& program, std::string& error);
    ~RemeshChild();
    RemeshChild(const RemeshChild&) = delete;
    RemeshChild& operator=(const RemeshChild&) = delete;

    /// Asks for one result and waits for it. A child that does not answer in time, dies or returns nonsense gives
    /// KERF_FAILED with a message; so does every request after the last restart.
    [[nodiscard]] RemeshResult remesh(const RemeshRequest& request, std::chrono::milliseconds limit);

    [[nodiscard]] std::uint32_t scope() const noexcept { return scope_; }  ///< KERF_REMESH_PATCH or KERF_REMESH_WHOLE
    [[nodiscard]] const std::string& plugin() const noexcept { return plugin_; }  ///< id and version
    [[nodiscard]] const std::string& kernel() const noexcept { return kernel_; }
    [[nodiscard]] int restarts() const noexcept { return restarts_; }
    [[nodiscard]] bool is_running() const noexcept { return pid_ > 0; }

private:
    explicit RemeshChild(RemeshProgram program) : program_(std::move(program)) {}
    [[nodiscard]] std::string spawn();
    /// Ends the child and waits until it has gone. Returns how it ended, for people.
    std::string end();
    /// Ends it, and starts another one if that may be.
    [[nodiscard]] RemeshResult lost(const std::string& why);

    RemeshProgram program_;
    pid_t pid_ = -1;
    int socket_ = -1;
    SharedMemory request_, result_;
    std::uint64_t number_ = 0;
    std::uint32_t scope_ = 0;
    std::string plugin_, kernel_;
    int restarts_ = 0;
};

}  // namespace kerf
