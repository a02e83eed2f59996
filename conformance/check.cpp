// SPDX-License-Identifier: Apache-2.0
#include "conformance/check.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <nlohmann/json.hpp>
#include <regex>

#include "core/plugin/plain_text.h"

extern "C" char** environ;

namespace kerf::conformance {

namespace {

using Json = nlohmann::json;

/// A program whose standard output is read.
class Child {
public:
    Child(const std::string& program, const std::string& argument) {
        int pipe[2];
        if (pipe2(pipe, O_CLOEXEC) != 0) {
            error_ = std::strerror(errno);
            return;
        }
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_adddup2(&actions, pipe[1], STDOUT_FILENO);
        char* arguments[] = {const_cast<char*>(program.c_str()), const_cast<char*>(argument.c_str()), nullptr};
        const int failed = posix_spawn(&process_, program.c_str(), &actions, nullptr, arguments, environ);
        posix_spawn_file_actions_destroy(&actions);
        close(pipe[1]);
        if (failed != 0) {
            error_ = std::strerror(failed);
            process_ = -1;
            close(pipe[0]);
            return;
        }
        output_ = pipe[0];
    }
    ~Child() {
        if (process_ > 0) {
            kill(process_, SIGTERM);
            wait();
        }
        if (output_ >= 0) close(output_);
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    [[nodiscard]] const std::string& error() const noexcept { return error_; }
    /// The next line, without its end. False at the end, or when `is_interrupted` says so.
    bool read_line(std::string& line, const std::function<bool()>& is_interrupted) {
        for (;;) {
            if (const std::size_t end = bytes_.find('\n'); end != std::string::npos) {
                line = bytes_.substr(0, end);
                bytes_.erase(0, end + 1);
                return true;
            }
            pollfd waits{output_, POLLIN, 0};
            ::poll(&waits, 1, 100);
            if (is_interrupted && is_interrupted()) return false;
            if (waits.revents == 0) continue;
            char buffer[4096];
            const auto got = read(output_, buffer, sizeof buffer);
            if (got < 0 && errno == EINTR) continue;
            if (got <= 0) return false;
            bytes_.append(buffer, static_cast<std::size_t>(got));
        }
    }

private:
    void wait() {
        int status = 0;
        while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
        }
        process_ = -1;
    }
    pid_t process_ = -1;
    int output_ = -1;
    std::string bytes_, error_;
};

}  // namespace

std::string refusal_of_pattern(const std::string& pattern) {
    try {
        static_cast<void>(std::regex(pattern, std::regex::ECMAScript));
        return {};
    } catch (const std::regex_error&) {
        return quoted_plain(pattern) + " is no regular expression. Write one, as in `law` or `^law\\.pure$`.";
    }
}

PluginReport check_plugin(const std::string& path, const CheckRequest& request,
                          const std::function<void(const TestResult&)>& on_result) {
    PluginReport report{path, "", {}, ""};
    Json order{{"plugin", path}, {"level", request.level}, {"only", request.only}, {"excluded", Json::array()}};
    for (const auto& [pattern, reason] : request.excluded) order["excluded"].push_back({pattern, reason});
    Child child(request.child, order.dump(-1, ' ', false, Json::error_handler_t::replace));
    if (!child.error().empty()) {
        report.error = request.child + " cannot be started: " + child.error() + ". Install Kerf again.";
        return report;
    }
    bool has_ended = false;
    for (std::string line; !has_ended && child.read_line(line, request.is_interrupted);) {
        const Json said = Json::parse(line, nullptr, false);
        if (!said.is_object()) continue;
        has_ended = said.contains("end");
        if (said.contains("plugin")) report.plugin = said["plugin"];
        if (!said.contains("id")) continue;
        report.results.push_back({said.value("id", ""), said.value("level", 0), said.value("subject", ""),
                                  said.value("sentence", ""), static_cast<Status>(said.value("status", 2)),
                                  said.value("text", ""), said.value("output", ""), said.value("seconds", 0.0)});
        if (on_result) on_result(report.results.back());
    }
    if (!has_ended)
        report.error = request.is_interrupted && request.is_interrupted()
                           ? "interrupted"
                           : "the kit itself ended before the tests did. This is a fault of Kerf; please report it.";
    return report;
}

}  // namespace kerf::conformance
