// SPDX-License-Identifier: Apache-2.0
#include "core/plugin/loading_note.h"

#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <cstring>

#include "core/plugin/own_streams.h"
#include "core/plugin/process_notes.h"

namespace kerf {

namespace {

constexpr int exit_fault = 3;
constexpr char ending[] =
    "\n"
    "      Its own code did so while it was loaded. Take it out of its folder, or out of KERF_PLUGIN_PATH.\n";

// Globals, because a signal handler reads them. `note` is written before `note_size`; 0: no plugin is being loaded.
char note[4500];
volatile std::sig_atomic_t note_size = 0;

void show(const char* what) noexcept {
    const auto write_all = [](const char* text, std::size_t size) {
        while (size > 0) {
            const ssize_t written = write(own_error_file(), text, size);
            if (written <= 0) return;
            text += written;
            size -= static_cast<std::size_t>(written);
        }
    };
    write_all(note, static_cast<std::size_t>(note_size));
    write_all(what, std::strlen(what));
    write_all(ending, sizeof ending - 1);
    say_last_word(exit_fault);
}

void on_signal(int signal) {
    show(signal == SIGABRT ? "it aborted." : "it crashed.");
    _exit(exit_fault);
}

void on_exit() {
    if (note_size == 0) return;
    show("it ended the program.");
    _exit(exit_fault);
}

}  // namespace

LoadingNote::LoadingNote(const std::string& path) {
    static const bool is_registered = std::atexit(&on_exit) == 0;
    static_cast<void>(is_registered);
    const std::string text = "kerf: while loading the plugin " + path.substr(0, 4096) + ": ";
    std::copy(text.begin(), text.end(), note);
    note_size = static_cast<std::sig_atomic_t>(text.size());

    struct sigaction action {};
    action.sa_handler = &on_signal;
    for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &action, &before_[i]);
}

LoadingNote::~LoadingNote() {
    note_size = 0;
    for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &before_[i], nullptr);
}

}  // namespace kerf
