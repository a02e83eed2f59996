// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace kerf {

/// The bytes of a file from some place on, one after another; unpacked on the way if they are packed as gzip or zlib
/// pack. Gzip in several pieces, as bgzip writes it, is one. No more is in memory than a buffer. Only regular files are
/// opened.   [main]
class PackedBytes {
public:
    enum class Packing { none, deflated };

    PackedBytes(const std::string& file, std::uint64_t offset, Packing packing);
    ~PackedBytes();
    PackedBytes(const PackedBytes&) = delete;
    PackedBytes& operator=(const PackedBytes&) = delete;

    /// The next `count` bytes, into a buffer of that size or, if it is null, nowhere. Returns how many there were:
    /// fewer at the end of the file, or where it is damaged.
    std::uint64_t take(char* into, std::uint64_t count);

    /// What follows the bytes that were taken. `sound`: nothing more, and the check sum and length behind packed data
    /// are right. `cut`: the packed data have no end. `damaged`: check sum or length are wrong.
    enum class End { sound, more, cut, damaged };
    [[nodiscard]] End end();

    [[nodiscard]] bool is_open() const noexcept;
    [[nodiscard]] bool is_damaged() const noexcept;

private:
    struct Stream;
    std::unique_ptr<Stream> stream_;
};

}  // namespace kerf
