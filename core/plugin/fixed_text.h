// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unistd.h>

#include <cstddef>

namespace kerf {

/// Text in a fixed buffer, for code that may take no memory. Control characters become spaces; characters that do not
/// fit are left out.   [any] async-signal-safe
template <std::size_t size>
class FixedText {
public:
    FixedText& operator<<(const char* more) noexcept {
        while (*more != '\0' && count_ + 1 < size) {
            const auto c = static_cast<unsigned char>(*more++);
            text_[count_++] = c < 0x20 || c == 0x7f ? ' ' : static_cast<char>(c);
        }
        text_[count_] = '\0';
        return *this;
    }
    FixedText& operator<<(unsigned long long number) noexcept {
        char digits[24];
        char* first = digits + sizeof digits;
        *--first = '\0';
        do *--first = static_cast<char>('0' + number % 10);
        while ((number /= 10) != 0);
        return *this << first;
    }
    void end_line() noexcept {
        if (count_ + 1 < size) text_[count_++] = '\n';
        text_[count_] = '\0';
    }
    [[nodiscard]] const char* c_str() const noexcept { return text_; }
    [[nodiscard]] bool empty() const noexcept { return count_ == 0; }
    /// Writes the text to a descriptor.
    void print(int file) const noexcept {
        for (std::size_t at = 0; at < count_;) {
            const ssize_t written = write(file, text_ + at, count_ - at);
            if (written <= 0) return;
            at += static_cast<std::size_t>(written);
        }
    }

private:
    char text_[size]{};
    std::size_t count_ = 0;
};

}  // namespace kerf
