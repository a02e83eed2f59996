// SPDX-License-Identifier: Apache-2.0
#include "app/window/coarse_block.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace kerf::window {

namespace {

constexpr int brick_samples = 8;
using Vertex = run::ViewedVertex;

/// Position in samples from the block's first one.
std::array<double, 3> in_samples(const Vertex& vertex, const run::ViewedBodySurface& surface, const Block& block) {
    const double origin[3] = {surface.origin.x, surface.origin.y, surface.origin.z};
    std::array<double, 3> at{};
    for (std::size_t axis = 0; axis < 3; ++axis)
        at[axis] = (static_cast<double>(vertex.position[axis]) - origin[axis]) / surface.spacing -
                   brick_samples * block.first_brick[axis];
    return at;
}

/// Returns whether a point lies on a face of its block, so that another block may have it too.
bool is_on_face(const std::array<double, 3>& at) {
    constexpr double end = brick_samples * Block::edge, tolerance = 1e-2;
    return std::any_of(at.begin(), at.end(), [](double a) { return a < tolerance || a > end - tolerance; });
}

/// Main direction of a normal, 0 … 5.
unsigned direction_of(const Vertex& vertex) {
    unsigned axis = 0;
    for (unsigned i = 1; i < 3; ++i)
        if (std::abs(vertex.normal[i]) > std::abs(vertex.normal[axis])) axis = i;
    return 2 * axis + (vertex.normal[axis] < 0 ? 1 : 0);
}

/// Vertices that become one, and their sums.
struct Cluster {
    std::array<double, 3> position{}, normal{};
    double light = 0.0;
    int count = 0;
    std::uint8_t tissue = 0;

    void add(const Vertex& vertex) {
        for (std::size_t i = 0; i < 3; ++i) {
            position[i] += static_cast<double>(vertex.position[i]);
            normal[i] += vertex.normal[i];
        }
        light += vertex.light;
        tissue = vertex.tissue;
        ++count;
    }
    [[nodiscard]] Vertex mean() const {
        Vertex vertex{};
        const double length = std::max(1e-9, std::hypot(normal[0], normal[1], normal[2]));
        for (std::size_t i = 0; i < 3; ++i) {
            vertex.position[i] = static_cast<float>(position[i] / count);
            vertex.normal[i] = static_cast<std::int8_t>(std::lround(127.0 * normal[i] / length));
        }
        vertex.light = static_cast<std::uint8_t>(std::lround(light / count));
        vertex.tissue = tissue;
        return vertex;
    }
};

/// Collects the patches of a block.
class Collector {
public:
    Collector(const run::ViewedBodySurface& surface, const Block& block, int lattice)
        : surface_(&surface), block_(&block), lattice_(lattice) {}

    void add(const run::ViewedPatch& patch) {
        number_.clear();
        for (const Vertex& vertex : patch.vertices) number_.push_back(numbered(vertex));
        for (const auto& [a, b, c] : patch.triangles) {
            const std::array<std::uint16_t, 3> triangle{number_[a], number_[b], number_[c]};
            if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) continue;
            mesh_.triangles.push_back(triangle);
        }
    }
    [[nodiscard]] BlockMesh take() {
        for (std::size_t c = 0; c < clusters_.size(); ++c)
            if (clusters_[c].count > 0) mesh_.vertices[c] = clusters_[c].mean();
        return std::move(mesh_);
    }

private:
    std::uint16_t numbered(const Vertex& vertex) {
        const auto next = static_cast<std::uint16_t>(mesh_.vertices.size());
        if (lattice_ > 1) {
            const std::array<double, 3> at = in_samples(vertex, *surface_, *block_);
            if (!is_on_face(at)) {
                const auto [place, is_new] = numbers_.try_emplace(key_of(at, vertex), next);
                if (!is_new) {
                    clusters_[place->second].add(vertex);
                    return place->second;
                }
                mesh_.vertices.push_back(vertex);
                clusters_.resize(mesh_.vertices.size());
                clusters_.back().add(vertex);
                return next;
            }
        }
        mesh_.vertices.push_back(vertex);
        clusters_.resize(mesh_.vertices.size());
        return next;
    }
    [[nodiscard]] std::uint32_t key_of(const std::array<double, 3>& at, const Vertex& vertex) const {
        std::uint32_t key = 0;
        for (const double a : at) key = key << 5 | static_cast<std::uint32_t>(a / lattice_);
        return (key << 8 | vertex.tissue) << 3 | direction_of(vertex);
    }

    const run::ViewedBodySurface* surface_;
    const Block* block_;
    int lattice_;
    BlockMesh mesh_;
    std::unordered_map<std::uint32_t, std::uint16_t> numbers_;
    std::vector<Cluster> clusters_;      ///< by vertex; without a count: it stays as it is
    std::vector<std::uint16_t> number_;  ///< of each vertex of a patch
};

}  // namespace

BlockMesh block_mesh(const run::ViewedBodySurface& surface, const Block& block, int lattice) {
    Collector collector(surface, block, lattice);
    const auto& n = surface.bricks;
    for (int k = block.first_brick[2]; k < std::min(n[2], block.first_brick[2] + Block::edge); ++k)
        for (int j = block.first_brick[1]; j < std::min(n[1], block.first_brick[1] + Block::edge); ++j)
            for (int i = block.first_brick[0]; i < std::min(n[0], block.first_brick[0] + Block::edge); ++i) {
                const auto brick = static_cast<std::size_t>((k * n[1] + j) * n[0] + i);
                if (const auto& patch = surface.patches[brick]; patch != nullptr) collector.add(*patch);
            }
    return collector.take();
}

}  // namespace kerf::window
