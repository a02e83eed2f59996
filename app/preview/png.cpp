// SPDX-License-Identifier: Apache-2.0
#include "app/preview/png.h"

#include <zlib.h>

namespace kerf::app {
namespace {

void put(std::string& out, std::uint32_t value) {
    for (const int shift : {24, 16, 8, 0}) out.push_back(static_cast<char>(value >> shift));
}

void chunk(std::string& out, const std::string& kind, const std::string& data) {
    put(out, static_cast<std::uint32_t>(data.size()));
    const std::string body = kind + data;
    out += body;
    put(out, static_cast<std::uint32_t>(
                 crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()))));
}

}  // namespace

std::string png_of(const Picture& picture) {
    const std::size_t row = 3 * static_cast<std::size_t>(picture.width);
    std::string lines;
    for (int y = 0; y < picture.height; ++y) {
        lines.push_back('\0');  // no filter
        lines.append(reinterpret_cast<const char*>(picture.rgb.data()) + static_cast<std::size_t>(y) * row, row);
    }
    uLongf size = compressBound(static_cast<uLong>(lines.size()));
    std::string packed(size, '\0');
    compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(lines.data()),
              static_cast<uLong>(lines.size()), 9);
    packed.resize(size);

    std::string header;
    put(header, static_cast<std::uint32_t>(picture.width));
    put(header, static_cast<std::uint32_t>(picture.height));
    header += std::string("\x08\x02\x00\x00\x00", 5);  // 8 bits, red green blue
    std::string out = "\x89PNG\r\n\x1a\n";
    chunk(out, "IHDR", header);
    chunk(out, "IDAT", packed);
    chunk(out, "IEND", "");
    return out;
}

std::string png_link(const Picture& picture) {
    static constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const std::string bytes = png_of(picture);
    std::string text = "data:image/png;base64,";
    for (std::size_t at = 0; at < bytes.size(); at += 3) {
        std::uint32_t three = 0;
        for (std::size_t n = 0; n < 3; ++n)
            three = three << 8 | (at + n < bytes.size() ? static_cast<unsigned char>(bytes[at + n]) : 0u);
        for (std::size_t n = 0; n < 4; ++n)
            text.push_back(at + n <= bytes.size() ? letters[three >> (18 - 6 * n) & 63] : '=');
    }
    return text;
}

}  // namespace kerf::app
