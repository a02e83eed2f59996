// SPDX-License-Identifier: Apache-2.0
#include "app/interruption.h"

#include <cstddef>

namespace kerf::app {

namespace {

volatile std::sig_atomic_t is_noted = 0;  // a signal handler can only reach globals

void note(int) { is_noted = 1; }

}  // namespace

Interruption::Interruption() {
    is_noted = 0;
    struct sigaction action {};
    action.sa_handler = &note;
    action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
    for (std::size_t i = 0; i < signals.size(); ++i) {
        is_taken_[i] = sigaction(signals[i], nullptr, &before_[i]) == 0 && before_[i].sa_handler != SIG_IGN;
        if (is_taken_[i]) sigaction(signals[i], &action, nullptr);
    }
}

Interruption::~Interruption() {
    for (std::size_t i = 0; i < signals.size(); ++i)
        if (is_taken_[i]) sigaction(signals[i], &before_[i], nullptr);
}

void Interruption::come() const noexcept { is_noted = 1; }

bool Interruption::has_come() const noexcept { return is_noted != 0; }

}  // namespace kerf::app
