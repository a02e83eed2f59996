// SPDX-License-Identifier: Apache-2.0
#include "app/plugin_output.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <exception>
#include <filesystem>
#include <system_error>

#include "app/standard_streams.h"
#include "core/plugin/own_streams.h"
#include "core/plugin/process_notes.h"
#include "session/recorder.h"
#include "text/write_file.h"

namespace kerf::app {

namespace {

constexpr std::size_t max_kept = 1u << 20, max_printed = 2000;  // [bytes]
constexpr int poll_interval = 100;                              // [ms] only if a copy of the worker keeps the pipe open

/// Returns the plugin that is being called, or was last.
std::string current_plugin() {
    CallInProgress call = call_in_progress();
    if (call.call == PluginCall::none) call = last_call();
    const ComponentName name = name_of(call.component);
    return name.is_known() ? "plugin " + std::string(name.plugin) + " (" + name.path + ")" : "a plugin";
}

}  // namespace

PluginOutput::PluginOutput() {
    if (pipe2(ends_, O_CLOEXEC) != 0) ends_[0] = ends_[1] = -1;
}

PluginOutput::~PluginOutput() {
    end_reading();
    for (const int end : ends_)
        if (end >= 0) close(end);
}

void PluginOutput::separate() {
    if (ends_[1] >= 0) static_cast<void>(separate_streams(ends_[1]));
}

void PluginOutput::begin() {
    if (ends_[1] < 0) return;
    close(ends_[1]);
    ends_[1] = -1;
    sigset_t all, before;  // signals are for the thread that waits for the worker
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, &before);
    try {
        reader_ = std::thread([this] { read_all(); });
    } catch (const std::system_error&) {
        // Without a thread, plugins write into a closed pipe.
        close(ends_[0]);
        ends_[0] = -1;
    }
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

void PluginOutput::read_all() noexcept {
    std::array<char, 1 << 16> chunk{};
    for (;;) {
        pollfd ready{ends_[0], POLLIN, 0};
        const int count = poll(&ready, 1, poll_interval);
        if (count == 0 && has_worker_ended_.load()) return;
        if (count < 0 && errno != EINTR) return;
        if (count <= 0) continue;
        const ssize_t size = read(ends_[0], chunk.data(), chunk.size());
        if (size < 0 && errno == EINTR) continue;
        if (size <= 0) return;
        try {
            if (size_ == 0) plugin_ = current_plugin();
            text_.append(chunk.data(), std::min(static_cast<std::size_t>(size), max_kept - text_.size()));
        } catch (const std::exception&) {
            // There is no memory for the text; it is read all the same.
        }
        size_ += static_cast<std::size_t>(size);
    }
}

void PluginOutput::end_reading() {
    has_worker_ended_.store(true);
    if (reader_.joinable()) reader_.join();
}

void PluginOutput::report() {
    end_reading();
    if (size_ == 0) return;
    const std::string record = noted_record();
    const std::string folder = std::filesystem::path(record).parent_path().string();
    const std::string begin = "kerf: " + plugin_ + " or a library printed " + std::to_string(size_) +
                              " bytes to stdout or stderr, which belong to Kerf";
    std::error_code none;
    std::string error;
    if (!record.empty() && std::filesystem::exists(record, none)) {
        std::string text = std::string(session::notice_line) + ".\nPrinted by plugins and libraries:\n" + text_;
        if (size_ > text_.size()) text += "\n… and " + std::to_string(size_ - text_.size()) + " bytes more.\n";
        error = text::write_file(folder + "/plugins.log", text);
        if (error.empty()) return print_error(begin + ": see " + folder + "/plugins.log.\n");
    }
    const std::size_t shown = std::min(text_.size(), max_printed);
    print_error(begin + ". Text of plugins:\n" + text_.substr(0, shown) +
                (shown > 0 && text_[shown - 1] == '\n' ? "" : "\n") +
                (size_ > shown ? "… and " + std::to_string(size_ - shown) + " bytes more.\n" : ""));
}

}  // namespace kerf::app
