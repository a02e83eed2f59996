// SPDX-License-Identifier: Apache-2.0
#include "core/field/piece_finder.h"

#include <algorithm>
#include <map>

namespace kerf {

namespace {

/// The representative of a set, with the way to it shortened. Sets are joined under their lowest node.
std::uint32_t root_of(std::vector<std::uint32_t>& parent, std::uint32_t node) noexcept {
    while (parent[node] != node) node = parent[node] = parent[parent[node]];
    return node;
}

void join(std::vector<std::uint32_t>& parent, std::uint32_t a, std::uint32_t b) noexcept {
    a = root_of(parent, a);
    b = root_of(parent, b);
    if (a < b) parent[b] = a;
    if (b < a) parent[a] = b;
}

void begin_apart(std::vector<std::uint32_t>& parent, std::size_t count) {
    parent.resize(count);
    for (std::size_t n = 0; n < count; ++n) parent[n] = static_cast<std::uint32_t>(n);
}

/// Joins what touches between a brick and the next one along an axis.
void join_along(std::vector<std::uint32_t>& parent, std::size_t axis, std::span<const BrickBits> low, std::uint32_t low_node,
                std::span<const BrickBits> high, std::uint32_t high_node) noexcept {
    for (std::size_t a = 0; a < low.size(); ++a)
        for (std::size_t b = 0; b < high.size(); ++b)
            if (touch_along(axis, low[a], high[b]))
                join(parent, low_node + static_cast<std::uint32_t>(a), high_node + static_cast<std::uint32_t>(b));
}

constexpr std::uint32_t none = ~std::uint32_t{0};

}  // namespace

PieceFinder::PieceFinder(const Body& body, const CutField& cut)
    : grid_(body.grid()),
      bits_(grid_.brick_count()),
      count_(grid_.brick_count(), 0),
      slot_(grid_.brick_count(), -1),
      first_node_(grid_.brick_count()) {
    for (std::size_t b = 0; b < grid_.brick_count(); ++b) label(b, solid_bits(body, cut, b));
}

void PieceFinder::label(std::size_t brick, const BrickBits& bits) {
    bits_[brick] = bits;
    std::size_t found = 0;
    std::vector<BrickBits> components;
    if (bits.is_full()) {
        found = 1;
    } else {
        for (BrickBits left = bits; !left.is_empty(); ++found) {
            const BrickBits one = take_component(left);
            if (found == 0 && left.is_empty()) continue;  // the usual case: all that there is
            components.push_back(one);
        }
    }
    count_[brick] = static_cast<std::uint16_t>(found);
    if (found <= 1) {
        if (slot_[brick] >= 0) free_slots_.push_back(slot_[brick]);
        slot_[brick] = -1;
        return;
    }
    if (slot_[brick] < 0) {
        if (free_slots_.empty()) {
            free_slots_.push_back(static_cast<std::int32_t>(many_.size()));
            many_.emplace_back();
        }
        slot_[brick] = free_slots_.back();
        free_slots_.pop_back();
    }
    many_[static_cast<std::size_t>(slot_[brick])] = std::move(components);
}

std::vector<LoosePart> PieceFinder::update(const CutField& cut, std::span<const std::size_t> changed) {
    std::vector<Dirty> dirty;
    for (const std::size_t b : changed) {
        if (count_[b] == 0) continue;
        const std::int16_t* removed = cut.stored(b);
        if (removed == nullptr) continue;
        // What is left of the samples that were there: a cut only takes.
        BrickBits now = solid_bits(removed, removed);
        for (std::size_t z = 0; z < 8; ++z) now.slice[z] &= bits_[b].slice[z];
        if (now == bits_[b]) continue;
        Dirty& d = dirty.emplace_back();
        d.brick = b;
        d.before = bits_[b];
        if (count_[b] > 1) d.components_before = many_[static_cast<std::size_t>(slot_[b])];
        label(b, now);
    }
    if (dirty.empty()) return {};
    look_at_the_box(dirty);
    if (fallen_apart_.empty()) return {};

    look_at_everything();
    std::map<std::uint32_t, std::vector<std::uint32_t>> parts_of;  // by one of the parts: roots of all of them
    for (const auto& places : fallen_apart_) {
        std::vector<std::uint32_t> roots;
        for (const auto& [brick, component] : places) roots.push_back(root_of(parent_, node(brick, component)));
        std::sort(roots.begin(), roots.end());
        roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
        if (roots.size() > 1) parts_of[roots.front()].insert(parts_of[roots.front()].end(), roots.begin(), roots.end());
    }
    if (parts_of.empty()) return {};

    // Two components of the box may have been one piece outside of it: what shares a part belongs together.
    std::vector<std::vector<std::uint32_t>> pieces;
    for (auto& [first, roots] : parts_of) {
        std::vector<std::uint32_t> all = roots;
        for (auto p = pieces.begin(); p != pieces.end();) {
            const bool is_shared = std::any_of(p->begin(), p->end(), [&](std::uint32_t r) { return std::find(all.begin(), all.end(), r) != all.end(); });
            if (!is_shared) {
                ++p;
                continue;
            }
            all.insert(all.end(), p->begin(), p->end());
            p = pieces.erase(p);
        }
        std::sort(all.begin(), all.end());
        all.erase(std::unique(all.begin(), all.end()), all.end());
        pieces.push_back(std::move(all));
    }

    std::map<std::uint32_t, LoosePart> parts;
    for (const auto& piece : pieces)
        for (const std::uint32_t root : piece) parts[root];
    for (std::size_t b = 0; b < bits_.size(); ++b) {
        const auto all = components(b);
        for (std::size_t c = 0; c < all.size(); ++c) {
            const auto part = parts.find(root_of(parent_, node(b, c)));
            if (part == parts.end()) continue;
            part->second.samples += static_cast<std::size_t>(all[c].count());
            SampleSet& bone = part->second.bone;
            if (bone.empty() || bone.back().first != b) bone.emplace_back(b, BrickBits{});
            bone.back().second |= all[c];
        }
    }
    std::vector<LoosePart> loose;
    for (const auto& piece : pieces) {
        const std::uint32_t stays = *std::max_element(piece.begin(), piece.end(), [&](std::uint32_t a, std::uint32_t b) {
            return parts[a].samples != parts[b].samples ? parts[a].samples < parts[b].samples : a > b;
        });
        for (const std::uint32_t root : piece)
            if (root != stays) loose.push_back(std::move(parts[root]));
    }
    for (const LoosePart& part : loose) take_away(part.bone);
    return loose;
}

/// Finds components of the box around the dirty bricks that were one before and are several now.
void PieceFinder::look_at_the_box(const std::vector<Dirty>& dirty) {
    fallen_apart_.clear();
    Box box{grid_.brick_place(dirty.front().brick), grid_.brick_place(dirty.front().brick)};
    for (const Dirty& d : dirty) {
        const auto at = grid_.brick_place(d.brick);
        for (std::size_t a = 0; a < 3; ++a) {
            box.first[a] = std::min(box.first[a], at[a]);
            box.last[a] = std::max(box.last[a], at[a]);
        }
    }
    for (std::size_t a = 0; a < 3; ++a) {
        box.first[a] = std::max(box.first[a] - 1, 0);
        box.last[a] = std::min(box.last[a] + 1, grid_.bricks[a] - 1);
    }
    const auto extent = [&](std::size_t a) { return static_cast<std::size_t>(box.last[a] - box.first[a] + 1); };
    const std::size_t bricks = extent(0) * extent(1) * extent(2);
    const auto brick_at = [&](std::size_t n) {
        return grid_.brick_index(box.first[0] + static_cast<int>(n % extent(0)), box.first[1] + static_cast<int>(n / extent(0) % extent(1)),
                                 box.first[2] + static_cast<int>(n / extent(0) / extent(1)));
    };

    // What a dirty brick was; the others are as they were. `part_of` says which.
    box_.part_of.assign(bricks, none);
    for (std::size_t d = 0; d < dirty.size(); ++d) {
        const auto at = grid_.brick_place(dirty[d].brick);
        const auto in = [&](std::size_t a) { return static_cast<std::size_t>(at[a] - box.first[a]); };
        box_.part_of[(in(2) * extent(1) + in(1)) * extent(0) + in(0)] = static_cast<std::uint32_t>(d);
    }
    const auto before = [&](std::size_t n) -> std::span<const BrickBits> {
        if (box_.part_of[n] == none) return components(brick_at(n));
        const Dirty& d = dirty[box_.part_of[n]];
        return d.components_before.empty() ? std::span<const BrickBits>(&d.before, 1) : std::span<const BrickBits>(d.components_before);
    };
    const auto after = [&](std::size_t n) { return components(brick_at(n)); };
    const auto joined = [&](const auto& of, std::vector<std::uint32_t>& first, std::vector<std::uint32_t>& parent) {
        first.resize(bricks + 1);
        first[0] = 0;
        for (std::size_t n = 0; n < bricks; ++n) first[n + 1] = first[n] + static_cast<std::uint32_t>(of(n).size());
        begin_apart(parent, first[bricks]);
        const std::size_t step[3] = {1, extent(0), extent(0) * extent(1)};
        for (std::size_t n = 0; n < bricks; ++n) {
            if (first[n] == first[n + 1]) continue;
            const std::size_t at[3] = {n % extent(0), n / extent(0) % extent(1), n / step[2]};
            for (std::size_t a = 0; a < 3; ++a)
                if (at[a] + 1 < extent(a)) join_along(parent, a, of(n), first[n], of(n + step[a]), first[n + step[a]]);
        }
    };
    joined(before, box_.first_before, box_.before);
    joined(after, box_.first_after, box_.after);

    // Each component of now lies in one of before. Two that lie in the same have been parted.
    std::map<std::uint32_t, std::map<std::uint32_t, std::pair<std::size_t, std::size_t>>> parts;
    std::vector<std::uint32_t> only(box_.before.size(), none);
    for (std::size_t n = 0; n < bricks; ++n) {
        const auto was = before(n), is = after(n);
        for (std::size_t c = 0; c < is.size(); ++c) {
            std::size_t from = 0;
            if (box_.part_of[n] == none)
                from = c;
            else
                while (from + 1 < was.size() && !was[from].meets(is[c])) ++from;
            const std::uint32_t old_root = root_of(box_.before, box_.first_before[n] + static_cast<std::uint32_t>(from));
            const std::uint32_t new_root = root_of(box_.after, box_.first_after[n] + static_cast<std::uint32_t>(c));
            if (only[old_root] == none) only[old_root] = new_root;
            if (only[old_root] != new_root) parts[old_root];
        }
    }
    if (parts.empty()) return;
    for (std::size_t n = 0; n < bricks; ++n) {
        const auto was = before(n), is = after(n);
        for (std::size_t c = 0; c < is.size(); ++c) {
            std::size_t from = 0;
            if (box_.part_of[n] == none)
                from = c;
            else
                while (from + 1 < was.size() && !was[from].meets(is[c])) ++from;
            const auto part = parts.find(root_of(box_.before, box_.first_before[n] + static_cast<std::uint32_t>(from)));
            if (part == parts.end()) continue;
            part->second.try_emplace(root_of(box_.after, box_.first_after[n] + static_cast<std::uint32_t>(c)), brick_at(n), c);
        }
    }
    for (const auto& [root, places] : parts) {
        auto& list = fallen_apart_.emplace_back();
        for (const auto& [new_root, place] : places) list.push_back(place);
    }
}

void PieceFinder::look_at_everything() {
    ++whole_searches_;
    std::uint32_t nodes = 0;
    for (std::size_t b = 0; b < bits_.size(); ++b) {
        first_node_[b] = nodes;
        nodes += count_[b];
    }
    begin_apart(parent_, nodes);
    const auto nx = static_cast<std::size_t>(grid_.bricks[0]), ny = static_cast<std::size_t>(grid_.bricks[1]);
    const std::size_t step[3] = {1, nx, nx * ny};
    std::size_t b = 0;
    for (int k = 0; k < grid_.bricks[2]; ++k)
        for (int j = 0; j < grid_.bricks[1]; ++j)
            for (int i = 0; i < grid_.bricks[0]; ++i, ++b) {
                if (count_[b] == 0) continue;
                const int at[3] = {i, j, k};
                for (std::size_t a = 0; a < 3; ++a)
                    if (at[a] + 1 < grid_.bricks[a] && count_[b + step[a]] != 0)
                        join_along(parent_, a, components(b), first_node_[b], components(b + step[a]), first_node_[b + step[a]]);
            }
}

void PieceFinder::take_away(const SampleSet& bone) {
    for (const auto& [brick, bits] : bone) label(brick, bits_[brick].without(bits));
}

SampleSet PieceFinder::bone() const {
    SampleSet all;
    for (std::size_t b = 0; b < bits_.size(); ++b)
        if (count_[b] != 0) all.emplace_back(b, bits_[b]);
    return all;
}

std::size_t PieceFinder::samples() const noexcept {
    std::size_t sum = 0;
    for (std::size_t b = 0; b < bits_.size(); ++b)
        if (count_[b] != 0) sum += static_cast<std::size_t>(bits_[b].count());
    return sum;
}

std::size_t PieceFinder::count_pieces() {
    look_at_everything();
    std::size_t pieces = 0;
    for (std::uint32_t n = 0; n < parent_.size(); ++n) pieces += parent_[n] == n;
    return pieces;
}

}  // namespace kerf
