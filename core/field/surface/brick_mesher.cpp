// SPDX-License-Identifier: Apache-2.0
#include "core/field/surface/brick_mesher.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "core/field/grid/kernel/crossing.h"
#include "core/field/grid/point_block.h"
#include "core/field/surface/cell_cases.h"

namespace kerf {

namespace {

constexpr int outside_grid = 8192;  ///< [quanta] value of samples outside the grid: about a voxel

constexpr std::array<int, 3> sample_of(int slot) noexcept {
    return {(slot & 15) - 1, (slot >> 4 & 15) - 1, (slot >> 8 & 15) - 1};
}

/// The numbers of the set bits of a byte, in ascending order.
struct SetBits {
    std::uint16_t count = 0;
    std::array<std::uint16_t, 8> at{};
};
constexpr std::array<SetBits, 256> set_bits = [] {
    std::array<SetBits, 256> all{};
    for (unsigned byte = 0; byte < 256; ++byte)
        for (unsigned bit = 0; bit < 8; ++bit)
            if ((byte >> bit & 1) != 0) all[byte].at[all[byte].count++] = static_cast<std::uint16_t>(bit);
    return all;
}();

/// Writes `first` + n for each set bit n of a byte, and arbitrary values up to eight. Returns the end of the list
/// without these.
inline std::uint16_t* list(std::uint16_t* to, unsigned byte, int first) noexcept {
    std::array<std::uint16_t, 8> slot_count =
        set_bits[byte & 255].at;  // a copy, so that the compiler can exclude aliasing
    for (std::uint16_t& slot : slot_count) slot = static_cast<std::uint16_t>(slot + first);
    std::memcpy(to, slot_count.data(), sizeof slot_count);
    return to + set_bits[byte & 255].count;
}

}  // namespace

BrickPatch::BrickPatch(const PatchView& patch)
    : vertices_(patch.vertices.begin(), patch.vertices.end()),
      tissue_(patch.tissue.begin(), patch.tissue.end()),
      edges_(patch.edges.begin(), patch.edges.end()),
      triangles_(patch.triangles.begin(), patch.triangles.end()) {
    for (const std::uint16_t edge : edges_) {
        const std::array<int, 3> low = sample_of(edge & 0xfff);
        for (int axis = 0; axis < 3; ++axis) {
            const int from = low[static_cast<std::size_t>(axis)], to = from + (edge >> 12 == axis);
            sides_ |= unsigned{from <= 0} << 2 * axis | unsigned{to >= brick_edge} << (2 * axis + 1);
        }
    }
}

bool BrickPatch::is_same_as(const PatchView& other) const noexcept {
    const auto same = [](const auto& a, const auto& b) {
        return a.size() == b.size() &&
               (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(*a.data())) == 0);
    };
    return same(edges_, other.edges) && same(triangles_, other.triangles) && same(vertices_, other.vertices) &&
           same(tissue_, other.tissue);
}

BrickMesher::BrickMesher(const Body& body) : body_(&body), locator_(body.grid(), {}, frame_of(identity_pose())) {
    const Grid& g = body.grid();
    frame_ = {{static_cast<float>(g.origin.x), static_cast<float>(g.origin.y), static_cast<float>(g.origin.z)},
              static_cast<float>(g.spacing),
              {}};
    if (!body.region.is_bounded()) return;
    const std::array<double, 3> low{body.region.low.x, body.region.low.y, body.region.low.z};
    const std::array<double, 3> high{body.region.high.x, body.region.high.y, body.region.high.z};
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (int i = -1; i <= g.samples(axis) + 1; ++i) {
            const Vec3 p = g.sample_position(i, i, i);
            const double at = axis == 0 ? p.x : axis == 1 ? p.y : p.z;
            beyond_[axis].push_back(quantised(std::max(low[axis] - at, at - high[axis]), g.quantum()));
        }
}

std::array<int, 3> BrickMesher::coordinates_of(std::size_t brick) const noexcept {
    const auto& bricks = body_->grid().bricks;
    const int b = static_cast<int>(brick);
    return {b % bricks[0], b / bricks[0] % bricks[1], b / bricks[0] / bricks[1]};
}

bool BrickMesher::may_cross(const CutField& cut, std::size_t brick) const noexcept {
    const LevelSet& surface = body_->surface;
    if (!surface.has_inside(brick)) return false;
    const bool has_both = surface.has_outside(brick) || cut.stored(brick) != nullptr;
    if (has_both && !body_->region.is_bounded()) return true;

    const std::array<int, 3> at = coordinates_of(brick);
    bool is_closed_here = false;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        is_closed_here = is_closed_here || at[axis] == 0 || at[axis] + 1 == body_->grid().bricks[axis];
        if (beyond_[axis].empty()) continue;
        const auto first = beyond_[axis].begin() + at[axis] * brick_edge + 1;
        const auto [minimum, maximum] = std::minmax_element(first, first + stored_edge);
        if (*minimum >= 0) return false;
        is_closed_here = is_closed_here || *maximum >= 0;
    }
    return has_both || is_closed_here;
}

BrickAround BrickMesher::around(const FieldShape& field, const std::array<int, 3>& at) const noexcept {
    const Grid& g = body_->grid();
    BrickAround bricks;
    bricks.own = field.samples + field.start[g.brick_index(at[0], at[1], at[2])];
    for (int side = 0; side < 6; ++side) {
        const auto axis = static_cast<std::size_t>(side / 2);
        std::array<int, 3> next = at;
        next[axis] += side % 2 == 0 ? -1 : 1;
        const bool is_in_grid = next[axis] >= 0 && next[axis] < g.bricks[axis];
        bricks.neighbour[side] =
            field.samples + field.start[is_in_grid ? g.brick_index(next[0], next[1], next[2]) : g.brick_count()];
    }
    return bricks;
}

PatchView BrickMesher::mesh(const CutField& cut, std::size_t brick) noexcept {
    const std::array<int, 3> at = coordinates_of(brick);
    const BlockKernel& kernel = block_kernel();
    const BrickAround bone = around(body_->surface.shape(), at), removed = around(cut.shape(), at);
    kernel.larger_rows(bone, removed, samples(), inside_.data());
    const bool is_cut_off = is_near_region_faces(at);
    if (is_cut_off) {
        kernel.larger_border(bone, removed, samples());
        cut_off_at_region(at);
    }

    // Samples outside the grid are outside bone: clear their bits.
    const auto& bricks = body_->grid().bricks;
    const std::array<int, 3> first{at[0] == 0 ? -1 : 0, at[1] == 0 ? -1 : 0, at[2] == 0 ? -1 : 0};
    const std::array<int, 3> end{at[0] + 1 == bricks[0] ? 8 : 9, at[1] + 1 == bricks[1] ? 8 : 9,
                                 at[2] + 1 == bricks[2] ? 8 : 9};
    const bool is_at_border = std::min({first[0], first[1], first[2]}) < 0 || std::min({end[0], end[1], end[2]}) < 9;
    if (is_at_border) clear_signs_from(end);

    unsigned some = 0, all = ~0U;
    for (int z = 1; z <= stored_edge; ++z)
        for (int y = 1; y <= stored_edge; ++y) {
            some |= inside_[static_cast<std::size_t>(z * 16 + y)];
            all &= inside_[static_cast<std::size_t>(z * 16 + y)];
        }
    constexpr unsigned whole_row = 0x3fe;
    if (some == 0 || (all == whole_row && !is_at_border)) return {};

    if (!is_cut_off) kernel.larger_border(bone, removed, samples());
    list_edges_and_cells(first);
    for (std::size_t axis = 0; axis < 3; ++axis) frame_.first[axis] = at[axis] * brick_edge;
    vertex_count_ = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::uint16_t* slots_along = edges_along_[axis].data();
        kernel.crossings(samples(), slots_along, count_along_[axis], static_cast<int>(axis), frame_,
                         &vertices_[vertex_count_]);
        for (std::size_t n = 0; n < count_along_[axis]; ++n) {
            number_[axis * slot_count + slots_along[n]] = static_cast<std::uint16_t>(vertex_count_ + n);
            edges_[vertex_count_ + n] = static_cast<std::uint16_t>(slots_along[n] | axis << 12);
        }
        vertex_count_ += count_along_[axis];
    }
    if (is_at_border) close_at_border(at);
    make_triangles();
    assign_tissues(brick);
    return {{vertices_.data(), vertex_count_},
            {tissue_.data(), vertex_count_},
            {edges_.data(), vertex_count_},
            {triangles_.data(), triangle_count_}};
}

void BrickMesher::prefetch(const CutField& cut, std::size_t brick) const noexcept {
    const auto fetch = [](const std::int16_t* first, int count) {
        constexpr int line = 32;
        for (int n = 0; n < count; n += line) __builtin_prefetch(first + n);
    };
    constexpr int stored_layer = stored_edge * stored_edge;
    const std::size_t row = static_cast<std::size_t>(body_->grid().bricks[0]),
                      layer = row * static_cast<std::size_t>(body_->grid().bricks[1]);
    for (const FieldShape& field : {body_->surface.shape(), cut.shape()}) {
        const auto samples_of = [&](std::size_t other) {
            return field.samples + field.start[std::min(other, body_->grid().brick_count())];
        };
        fetch(samples_of(brick), stored_samples);
        fetch(samples_of(brick + layer) + stored_layer, stored_layer);
        const std::int16_t* next = samples_of(brick + row) + stored_edge;
        for (int z = 0; z < stored_edge; ++z) fetch(next + z * stored_layer, stored_edge);
    }
}

bool BrickMesher::is_near_region_faces(const std::array<int, 3>& at) const noexcept {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (beyond_[axis].empty()) continue;
        const auto first = beyond_[axis].begin() + at[axis] * brick_edge;
        if (std::any_of(first, first + 11, [](std::int16_t beyond) { return beyond > -32767; })) return true;
    }
    return false;
}

void BrickMesher::cut_off_at_region(const std::array<int, 3>& at) noexcept {
    const auto beyond = [&](std::size_t axis) { return beyond_[axis].data() + at[axis] * brick_edge; };
    const std::int16_t *along_x = beyond(0), *along_y = beyond(1), *along_z = beyond(2);
    for (int z = 0; z < 11; ++z)
        for (int y = 0; y < 11; ++y) {
            std::int16_t* row = samples() + z * slot_layer + y * slot_row;
            const std::int16_t minimum = std::max(along_y[y], along_z[z]);
            unsigned signs = 0;
            for (int x = 0; x < 11; ++x) {
                row[x] = std::max({row[x], along_x[x], minimum});
                signs |= (row[x] < 0 ? 1U : 0U) << x;
            }
            const bool is_own_row = y > 0 && y < 10 && z > 0 && z < 10;
            if (is_own_row) inside_[static_cast<std::size_t>(z * 16 + y)] = static_cast<std::uint16_t>(signs & 0x3fe);
        }
}

void BrickMesher::clear_signs_from(const std::array<int, 3>& end) noexcept {
    const auto along_x = static_cast<std::uint16_t>(end[0] < 9 ? 0x1fe : 0x3fe);
    for (int z = 0; z < stored_edge; ++z)
        for (int y = 0; y < stored_edge; ++y) {
            std::uint16_t& row = inside_[static_cast<std::size_t>((z + 1) * 16 + y + 1)];
            row = y < end[1] && z < end[2] ? row & along_x : 0;
        }
}

void BrickMesher::list_edges_and_cells(const std::array<int, 3>& first) noexcept {
    std::uint16_t *along_x = edges_along_[0].data(), *along_y = edges_along_[1].data(),
                  *along_z = edges_along_[2].data();
    std::uint16_t* cells = cells_.data();
    const bool is_closed_at_x = first[0] < 0;
    for (int z = first[2]; z <= brick_edge; ++z)
        for (int y = first[1]; y <= brick_edge; ++y) {
            const int row = (z + 1) * 16 + y + 1, slot = row << 4 | 1;  // of x = 0
            const std::uint16_t* inside = &inside_[static_cast<std::size_t>(row)];
            const unsigned here = inside[0], next = inside[1], above = inside[16], both = inside[17];

            const unsigned crosses_x = (here ^ here >> 1) & 0x1ff;
            if (((crosses_x & (is_closed_at_x ? 0x1ff : 0x1fe)) | (here ^ next) | (here ^ above) | (here ^ both)) == 0)
                continue;
            if (is_closed_at_x && (crosses_x & 1) != 0) *along_x++ = static_cast<std::uint16_t>(slot - 1);
            along_x = list(along_x, crosses_x >> 1, slot);
            if (y < brick_edge) {
                const unsigned crosses_y = here ^ next;
                along_y = list(along_y, crosses_y >> 1, slot);
                *along_y = static_cast<std::uint16_t>(slot + brick_edge);
                along_y += crosses_y >> 9;
            }
            if (z < brick_edge) {
                const unsigned crosses_z = here ^ above;
                along_z = list(along_z, crosses_z >> 1, slot);
                *along_z = static_cast<std::uint16_t>(slot + brick_edge);
                along_z += crosses_z >> 9;
            }
            if (y < brick_edge && z < brick_edge) {
                const unsigned some = here | next | above | both, all = here & next & above & both;
                const unsigned crossed = (some | some >> 1) & ~(all & all >> 1);
                if (is_closed_at_x && (crossed & 1) != 0) *cells++ = static_cast<std::uint16_t>(slot - 1);
                cells = list(cells, crossed >> 1, slot);
            }
        }
    count_along_ = {static_cast<std::size_t>(along_x - edges_along_[0].data()),
                    static_cast<std::size_t>(along_y - edges_along_[1].data()),
                    static_cast<std::size_t>(along_z - edges_along_[2].data())};
    cell_count_ = static_cast<std::size_t>(cells - cells_.data());
}

void BrickMesher::make_triangles() noexcept {
    // The triangles of each case. A vertex is an offset into `number_`, from the entry of the cell's slot.
    struct Case {
        std::uint32_t count = 0;
        std::array<std::uint16_t, 3 * max_triangles> offset{};
    };
    static constexpr std::array<Case, cell_case_count> cases = [] {
        std::array<Case, cell_case_count> all{};
        for (std::size_t c = 0; c < cell_case_count; ++c) {
            all[c].count = static_cast<std::uint32_t>(cell_cases[c].count);
            for (std::size_t n = 0; n < 3 * all[c].count; ++n) {
                const std::size_t edge = cell_cases[c].triangles[n / 3][n % 3];
                const int start = edge_start[edge];
                const int corner = (start & 1) + (start >> 1 & 1) * slot_row + (start >> 2) * slot_layer;
                all[c].offset[n] = static_cast<std::uint16_t>(edge / 4 * slot_count + static_cast<std::size_t>(corner));
            }
        }
        return all;
    }();
    std::array<std::uint16_t, 3>* to = triangles_.data();
    for (std::size_t c = 0; c < cell_count_; ++c) {
        const std::uint16_t slot = cells_[c];
        const std::uint16_t* inside = &inside_[slot >> 4];
        const int x = slot & 15;
        const Case& what = cases[(inside[0] >> x & 3) | (inside[1] >> x & 3) << 2 | (inside[16] >> x & 3) << 4 |
                                 (inside[17] >> x & 3) << 6];
        const std::uint16_t* number = &number_[slot];
        const auto write = [&](std::size_t n) {
            to[n] = {number[what.offset[3 * n]], number[what.offset[3 * n + 1]], number[what.offset[3 * n + 2]]};
        };
        for (std::size_t n = 0; n < 4; ++n) write(n);  // writing unused triangles is faster than a test
        if (what.count > 4) write(4);
        to += what.count;
    }
    triangle_count_ = static_cast<std::size_t>(to - triangles_.data());
}

void BrickMesher::close_at_border(const std::array<int, 3>& at) noexcept {
    const Grid& g = body_->grid();
    const auto is_in_grid = [&](const std::array<int, 3>& s) {
        for (std::size_t n = 0; n < 3; ++n) {
            const int i = at[n] * brick_edge + s[n];
            if (i < 0 || i >= g.samples(n)) return false;
        }
        return true;
    };
    const auto value = [&](const std::array<int, 3>& s) {
        return is_in_grid(s) ? samples()[(s[0] + 1) + (s[1] + 1) * slot_row + (s[2] + 1) * slot_layer] : outside_grid;
    };
    for (std::size_t v = 0; v < vertex_count_; ++v) {
        const std::size_t axis = edges_[v] >> 12;
        const std::array<int, 3> low = sample_of(edges_[v] & 0xfff);
        std::array<int, 3> high = low;
        ++high[axis];
        const bool is_closing = !is_in_grid(low) || !is_in_grid(high);
        // Central differences where both neighbours are in the grid, else one-sided. Zero on a closing face: then
        // `crossing` returns the normal of the face.
        const auto slope = [&](const std::array<int, 3>& s) {
            SampleSlope about{};
            for (std::size_t n = 0; n < 3 && !is_closing; ++n) {
                std::array<int, 3> before = s, after = s;
                --before[n];
                ++after[n];
                const bool has_both = is_in_grid(before) && is_in_grid(after);
                const int change = value(is_in_grid(after) ? after : s) - value(is_in_grid(before) ? before : s);
                about.along[n] = has_both ? change : 2 * change;
            }
            return about;
        };
        vertices_[v] = crossing(value(low), value(high), slope(low), slope(high), static_cast<int>(axis),
                                {low[0], low[1], low[2]}, frame_);
    }
}

void BrickMesher::assign_tissues(std::size_t brick) noexcept {
    // A brick without a border of a material has one material: the first that contains it.
    const std::size_t last = body_->materials.size() - 1;
    std::size_t only = 0;
    bool is_one = true;
    for (std::size_t m = 0; m < last && is_one; ++m) {
        is_one = !body_->materials[m].border.has_border(brick);
        if (!is_one || body_->materials[m].border.is_all_solid(brick)) break;
        ++only;
    }
    if (is_one) {
        std::fill_n(tissue_.begin(), vertex_count_, static_cast<std::uint8_t>(only));
        return;
    }
    std::array<Vec3, block_capacity> inwards;
    LocatedBlock at;
    std::array<FloatBlock, KERF_MAX_TISSUES> weight;
    for (std::size_t begin = 0; begin < vertex_count_; begin += block_capacity) {
        // Sample half a voxel inwards: on the surface, the border of the outermost material would decide.
        const std::size_t count = std::min(block_capacity, vertex_count_ - begin);
        for (std::size_t n = 0; n < count; ++n) {
            const SurfaceVertex& v = vertices_[begin + n];
            const double step = 0.5 * body_->grid().spacing;
            inwards[n] = {v.position[0] - step * v.normal[0], v.position[1] - step * v.normal[1],
                          v.position[2] - step * v.normal[2]};
        }
        locator_.locate(inwards.data(), count, at);
        material_weights(*body_, at, weight);
        for (std::size_t n = 0; n < count; ++n) {
            std::size_t maximum = 0;
            for (std::size_t m = 1; m <= last; ++m)
                if (weight[m][n] > weight[maximum][n]) maximum = m;
            tissue_[begin + n] = static_cast<std::uint8_t>(maximum);
        }
    }
}

}  // namespace kerf
