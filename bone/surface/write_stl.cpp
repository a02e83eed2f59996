// SPDX-License-Identifier: Apache-2.0
#include "bone/surface/write_stl.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace kerf::bone {
namespace {

// Must not begin with "solid": readers would take the file for the text form.
constexpr std::string_view header = "Kerf; mm, LPS; training and research only; not for diagnosis or treatment";
constexpr std::size_t header_size = 80;
static_assert(header.size() <= header_size);

void put(std::vector<unsigned char>& bytes, std::uint32_t value) {
    for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<unsigned char>(value >> (8 * i)));
}

void put(std::vector<unsigned char>& bytes, Vec3 v) {
    for (const double component : {v.x, v.y, v.z})
        put(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(component)));
}

}  // namespace

std::vector<unsigned char> stl_bytes(const Mesh& mesh) {
    std::vector<unsigned char> bytes(header_size + 4, ' ');  // the count is written at the end
    std::copy(header.begin(), header.end(), bytes.begin());
    bytes.reserve(bytes.size() + 50 * mesh.triangles.size());

    std::uint32_t count = 0;
    const std::size_t vertex_count = mesh.vertices.size();
    for (const auto& [a, b, c] : mesh.triangles) {
        if (a >= vertex_count || b >= vertex_count || c >= vertex_count || a == b || b == c || c == a) continue;
        const Vec3 p = mesh.vertices[a], q = mesh.vertices[b], r = mesh.vertices[c];
        put(bytes, normalized(cross(q - p, r - p)));
        for (const Vec3 corner : {p, q, r}) put(bytes, 1000.0 * corner);
        bytes.push_back(0);
        bytes.push_back(0);
        ++count;
    }
    for (std::size_t i = 0; i < 4; ++i) bytes[header_size + i] = static_cast<unsigned char>(count >> (8 * i));
    return bytes;
}

}  // namespace kerf::bone
