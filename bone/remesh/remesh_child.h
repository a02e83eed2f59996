// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bone/remesh/remesh_request.h"
#include "bone/remesh/shared_memory.h"

namespace kerf::bone {

/// A strategy's program, module and parameters.
struct RemeshProgram {
    std::string program;                ///< kerf-remesh
    std::string module;                 ///< the plugin's library
    std::string strategy;               ///< its id in the plugin: "displace"
    std::vector<double> parameters{};   ///< SI, declared order; empty: defaults
    std::optional<double> tolerance{};  ///< [m] for all requests, if one of the parameters is a tolerance
};

/// A strategy in a separate process. It is started once, before any loop runs: `posix_spawn` does not delay a running
/// loop, `fork` would stop it for milliseconds. A child that dies or is late costs one request; it is killed and
/// started again, `max_restarts` times.   [worker] one thread at a time
class RemeshChild {
public:
    static constexpr int max_restarts = 3;

    /// Starts a child. Null on failure; then `error` has the reason, for people.   [main]
    static std::unique_ptr<RemeshChild> start(const RemeshProgram& program, std::string& error);
    ~RemeshChild();
    RemeshChild(const RemeshChild&) = delete;
    RemeshChild& operator=(const RemeshChild&) = delete;

    /// Requests one result and waits for it. A child that does not answer in time, dies or returns invalid data gives
    /// KERF_FAILED with a message; so does every request after the last restart. The first patch with a cut is
    /// requested twice. If the two results differ, later results of this strategy are refused.
    [[nodiscard]] RemeshResult remesh(const RemeshRequest& request, std::chrono::milliseconds limit);

    [[nodiscard]] std::uint32_t scope() const noexcept { return scope_; }  ///< KERF_REMESH_PATCH or KERF_REMESH_WHOLE
    /// [m] of the strategy; 0: none.
    [[nodiscard]] double tolerance() const noexcept { return program_.tolerance.value_or(0.0); }
    [[nodiscard]] const RemeshProgram& program() const noexcept { return program_; }
    [[nodiscard]] const std::string& plugin() const noexcept { return plugin_; }  ///< id and version
    [[nodiscard]] const std::string& kernel() const noexcept { return kernel_; }
    [[nodiscard]] int restarts() const noexcept { return restarts_; }
    [[nodiscard]] bool is_running() const noexcept { return pid_ > 0; }

private:
    explicit RemeshChild(RemeshProgram program) : program_(std::move(program)) {}
    [[nodiscard]] RemeshResult answer_of(const RemeshRequest& request, std::chrono::milliseconds limit);
    [[nodiscard]] std::string spawn();
    /// Ends the child and waits for its exit. Returns how it ended, for people.
    std::string end();
    /// Ends the child, and starts another one if restarts are left.
    [[nodiscard]] RemeshResult lost(const std::string& why);

    RemeshProgram program_;
    pid_t pid_ = -1;
    int socket_ = -1;
    SharedMemory request_, result_;
    std::uint64_t number_ = 0;
    std::uint32_t scope_ = 0;
    std::string plugin_, kernel_;
    int restarts_ = 0;
    bool is_repeated_ = false, is_constant_ = true;
};

}  // namespace kerf::bone
