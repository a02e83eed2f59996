// SPDX-License-Identifier: Apache-2.0
#include "bone/image/write_nrrd.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "text/write_file.h"

namespace kerf::bone {
namespace {

/// Returns the shortest digits that read back as the same number.
std::string number_text(double value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
    return {text.data(), end.ptr};
}

std::string vector_text(Vec3 mm) {
    return "(" + number_text(mm.x) + "," + number_text(mm.y) + "," + number_text(mm.z) + ")";
}

std::string header_of(const VoxelGrid& grid, const std::string& remark, bool as_short) {
    std::string text = "NRRD0004\n# " + remark + "\n";
    text += std::string("type: ") + (as_short ? "short" : "float") + "\ndimension: 3\nspace: left-posterior-superior\n";
    text += "sizes: " + std::to_string(grid.size[0]) + " " + std::to_string(grid.size[1]) + " " +
            std::to_string(grid.size[2]) + "\nspace directions:";
    for (std::size_t axis = 0; axis < 3; ++axis) text += " " + vector_text(1e3 * grid.step(axis));
    return text + "\nkinds: domain domain domain\nendian: little\nencoding: gzip\nspace origin: " +
           vector_text(1e3 * grid.origin()) + "\n\n";
}

}  // namespace

struct NrrdWriter::Stream {
    explicit Stream(const std::string& path) : file(path) {}
    text::FileWriter file;
    z_stream packer{};
};

NrrdWriter::NrrdWriter(std::string path, const VoxelGrid& grid, const std::string& remark, bool as_short)
    : path_(std::move(path)),
      as_short_(as_short),
      left_(grid.all().voxels()),
      stream_(std::make_unique<Stream>(path_)) {
    if (deflateInit2(&stream_->packer, 4, Z_DEFLATED, 31 /* gzip */, 8, Z_DEFAULT_STRATEGY) != Z_OK) {
        error_ = "there is no memory to compress";
        return;
    }
    stream_->file.write(header_of(grid, remark, as_short));
}

NrrdWriter::~NrrdWriter() { deflateEnd(&stream_->packer); }

void NrrdWriter::pack(const void* bytes, std::size_t count, bool is_last) {
    if (!error_.empty()) return;
    std::array<unsigned char, 1 << 16> packed;
    z_stream& packer = stream_->packer;
    packer.next_in = static_cast<unsigned char*>(const_cast<void*>(bytes));
    packer.avail_in = static_cast<unsigned>(count);
    do {
        packer.next_out = packed.data();
        packer.avail_out = static_cast<unsigned>(packed.size());
        deflate(&packer, is_last ? Z_FINISH : Z_NO_FLUSH);
        const std::size_t ready = packed.size() - packer.avail_out;
        stream_->file.write(std::span<const unsigned char>(packed.data(), ready));
    } while (packer.avail_out == 0);
}

void NrrdWriter::add(std::span<const float> values) {
    constexpr std::size_t at_once = 1 << 16;
    for (std::size_t from = 0; from < values.size(); from += at_once) {
        const auto some = values.subspan(from, std::min(at_once, values.size() - from));
        left_ -= std::min(left_, some.size());
        if (!as_short_) {
            pack(some.data(), some.size_bytes(), left_ == 0);
            continue;
        }
        std::vector<std::int16_t> whole;
        for (const float value : some) whole.push_back(static_cast<std::int16_t>(std::lround(value)));
        pack(whole.data(), whole.size() * sizeof(std::int16_t), left_ == 0);
    }
}

std::string NrrdWriter::finish() {
    if (error_.empty() && left_ > 0) error_ = "voxels are missing";
    if (!error_.empty()) return path_ + ": " + error_ + ".";
    return stream_->file.finish();
}

}  // namespace kerf::bone
