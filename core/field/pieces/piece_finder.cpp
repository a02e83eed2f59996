// SPDX-License-Identifier: Apache-2.0
#include "core/field/pieces/piece_finder.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <utility>

namespace kerf {

namespace {

/// Returns the representative of a set, and shortens the path to it. The representative is the lowest node.
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

/// Joins each component of a brick with those that it touches in the next brick along an axis.
void join_along(std::vector<std::uint32_t>& parent, std::size_t axis, std::span<const BrickBits> low,
                std::uint32_t low_node, std::span<const BrickBits> high, std::uint32_t high_node) noexcept {
    for (std::size_t a = 0; a < low.size(); ++a)
        for (std::size_t b = 0; b < high.size(); ++b)
            if (touch_along(axis, low[a], high[b]))
                join(parent, low_node + static_cast<std::uint32_t>(a), high_node + static_cast<std::uint32_t>(b));
}

constexpr std::uint32_t none = ~std::uint32_t{0};

}  // namespace

PieceFinder::PieceFinder(const Body& body, const CutField& cut)
    : grid_(body.grid()),
      step_{1, static_cast<std::size_t>(grid_.bricks[0]),
            static_cast<std::size_t>(grid_.bricks[0]) * static_cast<std::size_t>(grid_.bricks[1])},
      bits_(grid_.brick_count()),
      count_(grid_.brick_count(), 0),
      samples_(grid_.brick_count(), 0),
      sides_(grid_.brick_count()),
      is_full_(grid_.brick_count(), 0),
      slot_(grid_.brick_count(), -1),
      first_node_(grid_.brick_count()) {
    for (std::size_t b = 0; b < grid_.brick_count(); ++b) set_components(b, solid_bits(body, cut, b));
    for (std::size_t b = 0; b < grid_.brick_count(); ++b)
        if (count_[b] != 0) update_contacts(b);
    search_graph();  // allocates the memory for later searches
    size_.resize(parent_.size());
    whole_searches_ = 0;
}

void PieceFinder::set_components(std::size_t brick, const BrickBits& bits) {
    bits_[brick] = bits;
    samples_[brick] = static_cast<std::uint16_t>(bits.count());
    is_full_[brick] = bits.is_full();
    if (bits.is_empty() && slot_[brick] < 0) {
        count_[brick] = 0;
        return;
    }
    std::size_t found = is_full_[brick];
    std::vector<BrickBits> components;
    if (is_full_[brick] == 0) {
        for (BrickBits left = bits; !left.is_empty(); ++found) {
            const BrickBits one = take_component(left);
            if (found == 0 && left.is_empty()) continue;  // the usual case: one component with all samples
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

void PieceFinder::update_contacts(std::size_t brick) noexcept {
    const auto at = grid_.brick_coordinates(brick);
    for (std::size_t a = 0; a < 3; ++a) {
        if (at[a] > 0) update_contact(a, brick - step_[a], brick);
        if (at[a] + 1 < grid_.bricks[a]) update_contact(a, brick, brick + step_[a]);
    }
}

/// Updates the contact between a brick and the next one along an axis.
void PieceFinder::update_contact(std::size_t axis, std::size_t low, std::size_t high) noexcept {
    const bool has_both = count_[low] != 0 && count_[high] != 0,
               needs_components = has_both && (count_[low] > 1 || count_[high] > 1);
    const bool touches = has_both && !needs_components &&
                         ((is_full_[low] & is_full_[high]) != 0 || touch_along(axis, bits_[low], bits_[high]));
    const auto put = [](std::uint8_t& bits, std::size_t side, bool is_set) {
        bits = static_cast<std::uint8_t>((bits & ~(1u << side)) | (is_set ? 1u << side : 0u));
    };
    put(sides_[low].touches, 2 * axis + 1, touches);
    put(sides_[high].touches, 2 * axis, touches);
    put(sides_[low].needs_components, 2 * axis + 1, needs_components);
    put(sides_[high].needs_components, 2 * axis, needs_components);
}

/// Returns whether a dirty brick cannot have split its piece: it had and has one component, and still touches all
/// neighbours that it touched. Returns false if a neighbour has several components.
bool PieceFinder::is_unsplit(const Dirty& dirty) const noexcept {
    const Sides &was = dirty.sides, &is = sides_[dirty.brick];
    return dirty.components.empty() && count_[dirty.brick] == 1 && (was.needs_components | is.needs_components) == 0 &&
           (was.touches & ~is.touches) == 0;
}

std::vector<LoosePart> PieceFinder::update(const CutField& cut, std::span<const std::size_t> changed) {
    std::vector<Dirty> dirty;
    for (const std::size_t b : changed) {
        if (count_[b] == 0) continue;
        const std::int16_t* removed = cut.stored(b);
        if (removed == nullptr) continue;
        // A cut only removes samples, so only samples that were bone can remain.
        BrickBits now = solid_bits(removed, removed);
        for (std::size_t z = 0; z < 8; ++z) now.slice[z] &= bits_[b].slice[z];
        if (now == bits_[b]) continue;
        Dirty& d = dirty.emplace_back();
        d.brick = b;
        d.before = bits_[b];
        d.sides = sides_[b];
        if (count_[b] > 1) d.components = many_[static_cast<std::size_t>(slot_[b])];
        set_components(b, now);
    }
    for (const Dirty& d : dirty) update_contacts(d.brick);
    std::erase_if(dirty, [&](const Dirty& d) { return is_unsplit(d); });
    split_components_.clear();
    while (!dirty.empty()) search_box(take_neighbours(dirty));
    if (split_components_.empty()) return {};

    search_graph();
    std::map<std::uint32_t, std::vector<std::uint32_t>> parts_of;  // by the first root: roots of all parts
    for (const auto& places : split_components_) {
        std::vector<std::uint32_t> roots;
        roots.reserve(places.size());
        for (const auto& [brick, component] : places) roots.push_back(parent_[node(brick, component)]);
        std::sort(roots.begin(), roots.end());
        roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
        if (roots.size() > 1) parts_of[roots.front()].insert(parts_of[roots.front()].end(), roots.begin(), roots.end());
    }
    if (parts_of.empty()) return {};

    // Two components of a box may belong to one piece, connected outside the box: join lists that have a part in
    // common.
    std::vector<std::vector<std::uint32_t>> pieces;
    for (auto& [first, roots] : parts_of) {
        std::vector<std::uint32_t> all = roots;
        for (auto p = pieces.begin(); p != pieces.end();) {
            const bool is_shared = std::any_of(p->begin(), p->end(), [&](std::uint32_t r) {
                return std::find(all.begin(), all.end(), r) != all.end();
            });
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

    std::vector<LoosePart> loose = loose_parts_of(pieces);
    for (const LoosePart& part : loose) remove_bone(part.bone);
    return loose;
}

std::vector<LoosePart> PieceFinder::loose_parts_of(const std::vector<std::vector<std::uint32_t>>& pieces) {
    // Find the size of each part.
    size_.assign(parent_.size(), {0, 0, 0, none});
    for (std::size_t b = 0; b < bits_.size(); ++b) {
        if (count_[b] == 0) continue;
        if (count_[b] == 1) {
            Size& size = size_[parent_[first_node_[b]]];
            size.samples += samples_[b];
            ++(is_full_[b] != 0 ? size.full_bricks : size.others);
            continue;
        }
        const auto all = components(b);
        for (std::size_t c = 0; c < all.size(); ++c) {
            Size& size = size_[parent_[node(b, c)]];
            size.samples += static_cast<std::uint32_t>(all[c].count());
            ++size.others;
        }
    }

    // Collect all parts except the largest of each piece.
    std::vector<LoosePart> loose;
    for (const auto& piece : pieces) {
        const std::uint32_t stays =
            *std::max_element(piece.begin(), piece.end(), [&](std::uint32_t a, std::uint32_t b) {
                return size_[a].samples != size_[b].samples ? size_[a].samples < size_[b].samples : a > b;
            });
        for (const std::uint32_t root : piece) {
            if (root == stays) continue;
            size_[root].part = static_cast<std::uint32_t>(loose.size());
            LoosePart& part = loose.emplace_back();
            part.samples = size_[root].samples;
            part.bone.reserve(size_[root].full_bricks, size_[root].others);
        }
    }
    for (std::size_t b = 0; b < bits_.size(); ++b) {
        if (count_[b] == 0) continue;
        const auto part_of = [&](std::size_t c) { return size_[parent_[node(b, c)]].part; };
        if (is_full_[b] != 0) {
            if (const std::uint32_t part = part_of(0); part != none) loose[part].bone.add_full(b);
            continue;
        }
        const auto all = components(b);
        for (std::size_t c = 0; c < all.size(); ++c) {
            const std::uint32_t part = part_of(c);
            if (part == none) continue;
            // Add components of a brick together if they are connected outside of it.
            BrickBits together = all[c];
            bool is_first = true;
            for (std::size_t other = 0; other < all.size(); ++other) {
                if (other == c || part_of(other) != part) continue;
                is_first = is_first && other > c;
                together |= all[other];
            }
            if (is_first) loose[part].bone.add(b, together);
        }
    }
    return loose;
}

/// Removes from `left` one brick and, repeatedly, all bricks at most two bricks away from the box around those removed.
/// Returns them. So distant cuts are processed separately.
std::vector<PieceFinder::Dirty> PieceFinder::take_neighbours(std::vector<Dirty>& left) {
    std::vector<Dirty> near;
    near.push_back(std::move(left.back()));
    left.pop_back();
    Box box{grid_.brick_coordinates(near.front().brick), grid_.brick_coordinates(near.front().brick)};
    for (bool has_grown = true; has_grown;) {
        has_grown = false;
        for (std::size_t n = 0; n < left.size();) {
            const auto at = grid_.brick_coordinates(left[n].brick);
            bool meets = true;
            for (std::size_t a = 0; a < 3; ++a) meets = meets && at[a] >= box.first[a] - 2 && at[a] <= box.last[a] + 2;
            if (!meets) {
                ++n;
                continue;
            }
            for (std::size_t a = 0; a < 3; ++a) {
                box.first[a] = std::min(box.first[a], at[a]);
                box.last[a] = std::max(box.last[a], at[a]);
            }
            near.push_back(std::move(left[n]));
            left[n] = std::move(left.back());
            left.pop_back();
            has_grown = true;
        }
    }
    return near;
}

/// Finds the components of the box around dirty bricks that have split. Adds their parts to `split_components_`.
void PieceFinder::search_box(const std::vector<Dirty>& dirty) {
    Box box{grid_.brick_coordinates(dirty.front().brick), grid_.brick_coordinates(dirty.front().brick)};
    for (const Dirty& d : dirty) {
        const auto at = grid_.brick_coordinates(d.brick);
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
        return grid_.brick_index(box.first[0] + static_cast<int>(n % extent(0)),
                                 box.first[1] + static_cast<int>(n / extent(0) % extent(1)),
                                 box.first[2] + static_cast<int>(n / extent(0) / extent(1)));
    };

    // `part_of` is the index in `dirty` of each brick of the box, or `none` if the brick is unchanged.
    box_.part_of.assign(bricks, none);
    for (std::size_t d = 0; d < dirty.size(); ++d) {
        const auto at = grid_.brick_coordinates(dirty[d].brick);
        const auto in = [&](std::size_t a) { return static_cast<std::size_t>(at[a] - box.first[a]); };
        box_.part_of[(in(2) * extent(1) + in(1)) * extent(0) + in(0)] = static_cast<std::uint32_t>(d);
    }
    const auto before = [&](std::size_t n) -> std::span<const BrickBits> {
        if (box_.part_of[n] == none) return components(brick_at(n));
        return dirty[box_.part_of[n]].before_components();
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

    // Each present component lies in one former component. If a former component contains two, it has split.
    const auto for_each_component = [&](const auto& what) {  // what(brick, component, former root, present root)
        for (std::size_t n = 0; n < bricks; ++n) {
            const auto was = before(n), is = after(n);
            for (std::size_t c = 0; c < is.size(); ++c) {
                std::size_t from = 0;
                if (box_.part_of[n] == none)
                    from = c;
                else
                    while (from + 1 < was.size() && !was[from].meets(is[c])) ++from;
                what(n, c, root_of(box_.before, box_.first_before[n] + static_cast<std::uint32_t>(from)),
                     root_of(box_.after, box_.first_after[n] + static_cast<std::uint32_t>(c)));
            }
        }
    };
    std::map<std::uint32_t, std::map<std::uint32_t, std::pair<std::size_t, std::size_t>>> parts;
    std::vector<std::uint32_t> only(box_.before.size(), none);
    for_each_component([&](std::size_t, std::size_t, std::uint32_t old_root, std::uint32_t new_root) {
        if (only[old_root] == none) only[old_root] = new_root;
        if (only[old_root] != new_root) parts[old_root];
    });
    if (parts.empty()) return;
    for_each_component([&](std::size_t n, std::size_t c, std::uint32_t old_root, std::uint32_t new_root) {
        if (const auto part = parts.find(old_root); part != parts.end())
            part->second.try_emplace(new_root, brick_at(n), c);
    });
    for (const auto& [root, places] : parts) {
        auto& list = split_components_.emplace_back();
        for (const auto& [new_root, place] : places) list.push_back(place);
    }
}

void PieceFinder::search_graph() {
    ++whole_searches_;
    constexpr unsigned last_along_x = 1u << 0;
    std::uint32_t nodes = 0;
    for (std::size_t b = 0; b < bits_.size(); ++b) {
        if ((sides_[b].touches & last_along_x) != 0) {
            first_node_[b] = first_node_[b - 1];
            continue;
        }
        first_node_[b] = nodes;
        nodes += count_[b];
    }
    begin_apart(parent_, nodes);
    join_everything();
    // The parent of a node never comes after it: one pass makes every parent a root.
    for (std::uint32_t& parent : parent_) parent = parent_[parent];
}

void PieceFinder::join_everything() {
    constexpr unsigned next_along[3] = {1u << 1, 1u << 3, 1u << 5},
                       next = next_along[0] | next_along[1] | next_along[2];
    std::array<std::pair<std::uint32_t, std::uint32_t>, 3>
        joined;  // the last pair joined along each axis, as two rows meet in many bricks
    joined.fill({none, none});
    for (std::size_t b = 0; b < bits_.size(); ++b) {
        const unsigned touches = sides_[b].touches, needs_components = sides_[b].needs_components;
        if (((touches | needs_components) & next) == 0) continue;
        for (std::size_t a = 0; a < 3; ++a) {
            const std::size_t other = b + step_[a];
            if ((needs_components & next_along[a]) != 0) {
                join_along(parent_, a, components(b), first_node_[b], components(other), first_node_[other]);
            } else if ((touches & next_along[a]) != 0 && a > 0) {
                const std::pair both{first_node_[b], first_node_[other]};
                if (std::exchange(joined[a], both) != both) join(parent_, both.first, both.second);
            }
        }
    }
}

void PieceFinder::remove_bone(const SampleSet& bone) {
    bone.for_each([&](std::size_t brick, const BrickBits& bits) {
        if (count_[brick] > 1) {
            set_components(brick, bits_[brick].without(bits));
            update_contacts(brick);
            return;
        }
        // The brick has one component, which is removed: remove all its contacts too.
        count_[brick] = samples_[brick] = 0;
        is_full_[brick] = 0;
        sides_[brick] = {};
    });
}

SampleSet PieceFinder::bone() const {
    SampleSet all;
    for (std::size_t b = 0; b < bits_.size(); ++b)
        if (count_[b] != 0) all.add(b, bits_[b]);
    return all;
}

std::size_t PieceFinder::samples() const noexcept {
    std::size_t sum = 0;
    for (const std::uint16_t of_brick : samples_) sum += of_brick;
    return sum;
}

std::size_t PieceFinder::count_pieces() {
    search_graph();
    std::size_t pieces = 0;
    for (std::uint32_t n = 0; n < parent_.size(); ++n) pieces += parent_[n] == n;
    return pieces;
}

}  // namespace kerf
