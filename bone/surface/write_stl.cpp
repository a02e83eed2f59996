// SPDX-License-Identifier: Apache-2.0
#include "bone/surface/write_stl.h"

#include <algorithm>
#include <array>
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

/// Returns the number that is read back [mm]. Not inlined: GCC 12 vectorizes the three calls for a vector, and leaves
/// out the rounding of two.
[[gnu::noinline]] double as_written(double mm) noexcept { return static_cast<double>(static_cast<float>(mm)); }

Vec3 as_written(Vec3 mm) noexcept { return {as_written(mm.x), as_written(mm.y), as_written(mm.z)}; }

/// Returns whether `stl_bytes` writes a triangle.
bool is_written(const std::array<std::uint32_t, 3>& t, std::size_t vertices) {
    return t[0] < vertices && t[1] < vertices && t[2] < vertices && t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
}

bool is_flat(Vec3 a, Vec3 b, Vec3 c) {
    const Vec3 area = cross(b - a, c - a);
    return !(dot(area, area) > 0.0);
}

}  // namespace

StlLoss stl_loss(const Mesh& mesh) {
    StlLoss loss;
    for (const auto& t : mesh.triangles) {
        if (!is_written(t, mesh.vertices.size())) continue;
        std::array<Vec3, 3> corners, written;  // [mm]
        for (std::size_t i = 0; i < 3; ++i) {
            corners[i] = 1000.0 * mesh.vertices[t[i]];
            written[i] = as_written(corners[i]);
            loss.displacement = std::max(loss.displacement, 1e-3 * length(written[i] - corners[i]));
        }
        if (is_flat(written[0], written[1], written[2]) && !is_flat(corners[0], corners[1], corners[2]))
            ++loss.flattened;
    }
    return loss;
}

std::vector<unsigned char> stl_bytes(const Mesh& mesh) {
    std::vector<unsigned char> bytes(header_size + 4, ' ');  // the count is written at the end
    std::copy(header.begin(), header.end(), bytes.begin());
    bytes.reserve(bytes.size() + 50 * mesh.triangles.size());

    std::uint32_t count = 0;
    const std::size_t vertex_count = mesh.vertices.size();
    for (const auto& triangle : mesh.triangles) {
        if (!is_written(triangle, vertex_count)) continue;
        const auto& [a, b, c] = triangle;
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
