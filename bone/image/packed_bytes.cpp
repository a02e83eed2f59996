// SPDX-License-Identifier: Apache-2.0
#include "bone/image/packed_bytes.h"

#include <zlib.h>

#include <algorithm>
#include <fstream>
#include <vector>

#include "text/regular_file.h"

namespace kerf::bone {

struct PackedBytes::Stream {
    std::ifstream in;
    Packing packing = Packing::none;
    z_stream unpacker{};
    std::vector<unsigned char> packed = std::vector<unsigned char>(1 << 16),
                               nowhere = std::vector<unsigned char>(1 << 18);
    bool is_open = false, is_damaged = false;
    bool is_over = false;  ///< after the last piece; data behind it are not unpacked

    bool refill() {
        if (unpacker.avail_in > 0) return true;
        in.read(reinterpret_cast<char*>(packed.data()), static_cast<std::streamsize>(packed.size()));
        unpacker.avail_in = static_cast<unsigned>(in.gcount());
        unpacker.next_in = packed.data();
        return unpacker.avail_in > 0;
    }
};

PackedBytes::PackedBytes(const std::string& file, std::uint64_t offset, Packing packing)
    : stream_(std::make_unique<Stream>()) {
    Stream& s = *stream_;
    s.packing = packing;
    s.in = text::open_regular_file(file);
    s.is_open = static_cast<bool>(s.in) && inflateInit2(&s.unpacker, 15 + 32 /* zlib or gzip */) == Z_OK;
    s.in.seekg(static_cast<std::streamoff>(offset));
}

PackedBytes::~PackedBytes() { inflateEnd(&stream_->unpacker); }

bool PackedBytes::is_open() const noexcept { return stream_->is_open; }
bool PackedBytes::is_damaged() const noexcept { return stream_->is_damaged; }

PackedBytes::End PackedBytes::end() {
    Stream& s = *stream_;
    if (s.packing == Packing::none) return s.in.peek() == std::ifstream::traits_type::eof() ? End::sound : End::more;
    // zlib compares checksum and length at the end of a piece.
    char next = 0;
    const std::uint64_t count = take(&next, 1);
    return s.is_damaged ? End::damaged : count > 0 ? End::more : s.is_over ? End::sound : End::cut;
}

std::uint64_t PackedBytes::take(char* into, std::uint64_t count) {
    Stream& s = *stream_;
    if (!s.is_open) return 0;
    if (s.packing == Packing::none) {
        if (into == nullptr) {
            s.in.seekg(static_cast<std::streamoff>(count),
                       std::ios::cur);  // callers check the size of a raw file themselves
            return s.in ? count : 0;
        }
        s.in.read(into, static_cast<std::streamsize>(count));
        return static_cast<std::uint64_t>(s.in.gcount());
    }
    std::uint64_t taken = 0;
    while (taken < count && !s.is_damaged && !s.is_over && s.refill()) {
        const std::uint64_t count_of_piece =
            std::min<std::uint64_t>(count - taken, into == nullptr ? s.nowhere.size() : 1u << 30);
        s.unpacker.next_out = into == nullptr ? s.nowhere.data() : reinterpret_cast<unsigned char*>(into + taken);
        s.unpacker.avail_out = static_cast<unsigned>(count_of_piece);
        const int status = inflate(&s.unpacker, Z_NO_FLUSH);
        taken += count_of_piece - s.unpacker.avail_out;
        if (status == Z_STREAM_END) {
            inflateReset(&s.unpacker);
            s.is_over = !s.refill() || *s.unpacker.next_in != 0x1f;  // the first byte of another piece of gzip
        } else if (status != Z_OK && status != Z_BUF_ERROR) {
            s.is_damaged = true;
        }
    }
    return taken;
}

}  // namespace kerf::bone
