// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace kerf::bone {

/// The bytes of a file from an offset on, in order, unpacked if they are packed as gzip or zlib. Gzip in several
/// pieces, as bgzip writes it, is one stream. It needs the memory of one buffer only. Opens regular files only.
/// [main]
class PackedBytes {
public:
    enum class Packing { none, deflated };

    PackedBytes(const std::string& file, std::uint64_t offset, Packing packing);
    ~PackedBytes();
    PackedBytes(const PackedBytes&) = delete;
    PackedBytes& operator=(const PackedBytes&) = delete;

    /// Reads the next `count` bytes into a buffer of that size, or drops them if it is null. Returns the number of
    /// bytes, which is smaller at the end of the file or at damage.
    std::uint64_t take(char* into, std::uint64_t count);

    /// State behind the bytes that were read. `sound`: no more data, and checksum and length behind packed data are
    /// right. `cut`: the packed data have no end. `damaged`: checksum or length are wrong.
    enum class End { sound, more, cut, damaged };
    [[nodiscard]] End end();

    [[nodiscard]] bool is_open() const noexcept;
    [[nodiscard]] bool is_damaged() const noexcept;

private:
    struct Stream;
    std::unique_ptr<Stream> stream_;
};

}  // namespace kerf::bone
