// SPDX-License-Identifier: Apache-2.0
#include "bone/surface/repair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <tuple>

#include "bone/report/import_report.h"
#include "bone/surface/diagnose.h"
#include "bone/surface/triangle_tree.h"

namespace kerf::bone {
namespace {

constexpr double joining_distance = 1e-6;  // [m] between borders; far below the resolution of scanners
constexpr double widest_closable = 20e-3;  // [m] upper limit of `repair.holes_up_to`

std::string counted(std::size_t n, const char* one, const char* many) {
    return std::to_string(n) + " " + (n == 1 ? one : many);
}

/// Replaces every vertex number by `name[vertex]`.
void rename(SurfaceMesh& mesh, const std::vector<std::uint32_t>& name) {
    for (Triangle& t : mesh.triangles)
        for (std::uint32_t& v : t) v = name[v];
    drop_unused_vertices(mesh);
}

bool has_border(const std::vector<HalfEdge>& edges) {
    bool found = false;
    for_each_edge(edges, [&](const HalfEdge* first, const HalfEdge* last) { found |= last - first == 1; });
    return found;
}

// ---- faces that bound nothing ---------------------------------------------------------------------------------------

void drop_collapsed(SurfaceMesh& mesh, std::vector<std::string>& notes) {
    const std::size_t before = mesh.triangles.size();
    std::erase_if(mesh.triangles, [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
    if (const std::size_t removed_count = before - mesh.triangles.size(); removed_count > 0)
        notes.push_back("Left out " + counted(removed_count, "face", "faces") + " with the same corner twice.");
}

/// Among faces with the same three vertices, opposite faces cancel. One face of the majority remains, if any.
void drop_duplicates(SurfaceMesh& mesh, std::vector<std::string>& notes) {
    struct Entry {
        Triangle sorted;
        std::size_t face;
        bool is_even;  // an even number of swaps sorts it
    };
    std::vector<Entry> all;
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        Triangle t = mesh.triangles[f];
        bool is_even = true;
        const auto in_order = [&](std::size_t i, std::size_t j) {
            if (t[i] > t[j]) {
                std::swap(t[i], t[j]);
                is_even = !is_even;
            }
        };
        in_order(0, 1);
        in_order(1, 2);
        in_order(0, 1);
        all.push_back({t, f, is_even});
    }
    std::sort(all.begin(), all.end(),
              [](const Entry& a, const Entry& b) { return std::tie(a.sorted, a.face) < std::tie(b.sorted, b.face); });
    std::vector<std::uint8_t> is_dropped(mesh.triangles.size(), 0);
    std::size_t copies = 0, cancelled = 0;
    for (std::size_t i = 0, j; i < all.size(); i = j) {
        int balance = 0;
        for (j = i; j < all.size() && all[j].sorted == all[i].sorted; ++j) balance += all[j].is_even ? 1 : -1;
        if (j - i == 1) continue;
        bool is_kept = false;
        for (std::size_t k = i; k < j; ++k) {
            const bool is_the_one = balance != 0 && !is_kept && all[k].is_even == (balance > 0);
            is_kept |= is_the_one;
            is_dropped[all[k].face] = !is_the_one;
        }
        (is_kept ? copies : cancelled) += j - i - (is_kept ? 1 : 0);
    }
    std::size_t at = 0;
    std::erase_if(mesh.triangles, [&](const Triangle&) { return is_dropped[at++] != 0; });
    if (copies > 0) notes.push_back("Left out " + counted(copies, "face", "faces") + " that are there twice.");
    if (cancelled > 0)
        notes.push_back("Left out " + counted(cancelled, "face", "faces") +
                        " that lie back to back, with nothing between them.");
}

// ---- borders --------------------------------------------------------------------------------------------------------

/// Merges border vertices that are closer than `joining_distance`; the first one stays.
void join_borders(SurfaceMesh& mesh, std::vector<std::string>& notes) {
    std::vector<std::uint8_t> is_border(mesh.vertices.size(), 0);
    for_each_edge(half_edges_of(mesh), [&](const HalfEdge* first, const HalfEdge* last) {
        if (last - first == 1) is_border[first->low] = is_border[first->high] = 1;
    });
    using Cell = std::array<long long, 3>;
    const auto cell_of = [](Vec3 p) {
        const auto index = [](double x) { return static_cast<long long>(std::floor(x / joining_distance)); };
        return Cell{index(p.x), index(p.y), index(p.z)};
    };
    std::map<Cell, std::vector<std::uint32_t>> kept;
    std::vector<std::uint32_t> name(mesh.vertices.size());
    std::iota(name.begin(), name.end(), 0u);
    std::size_t joined = 0;
    for (std::uint32_t v = 0; v < name.size(); ++v) {
        if (is_border[v] == 0) continue;
        const Cell cell = cell_of(mesh.vertices[v]);
        std::uint32_t other = v;
        for (int n = 0; n < 27; ++n) {
            const auto found = kept.find({cell[0] + n % 3 - 1, cell[1] + n / 3 % 3 - 1, cell[2] + n / 9 - 1});
            if (found == kept.end()) continue;
            for (const std::uint32_t u : found->second)
                if (length(mesh.vertices[u] - mesh.vertices[v]) <= joining_distance) other = std::min(other, u);
        }
        if (other == v)
            kept[cell].push_back(v);
        else
            ++joined;
        name[v] = other;
    }
    if (joined == 0) return;
    rename(mesh, name);
    notes.push_back("Joined " + counted(joined, "vertex", "vertices") +
                    " of borders that lay within 1 µm of each other.");
}

/// Closes a hole by a fan around the middle of its border.
void close_hole(SurfaceMesh& mesh, const std::vector<std::uint32_t>& loop) {
    if (loop.size() == 3) {
        mesh.triangles.push_back({loop[0], loop[1], loop[2]});
        return;
    }
    Vec3 sum{};
    for (const std::uint32_t v : loop) sum = sum + mesh.vertices[v];
    const auto middle = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(sum / static_cast<double>(loop.size()));
    for (std::size_t i = 0; i < loop.size(); ++i)
        mesh.triangles.push_back({loop[i], loop[(i + 1) % loop.size()], middle});
}

std::optional<SurfaceError> close_holes(SurfaceMesh& mesh, double up_to, std::vector<std::string>& notes) {
    const std::vector<BorderLoop> loops = border_loops_of(half_edges_of(mesh));
    double widest = 0.0, widest_closed = 0.0;
    Vec3 at{};
    std::vector<const BorderLoop*> closable;
    for (const BorderLoop& loop : loops) {
        const Opening opening = opening_of(mesh, loop);
        if (opening.width <= up_to && loop.is_closed && loop.vertices.size() >= 3) {
            closable.push_back(&loop);
            widest_closed = std::max(widest_closed, opening.width);
        } else if (loop.is_closed && opening.width > widest) {
            widest = opening.width;
            at = opening.at;
        }
    }
    if (widest > 0.0) {
        const std::size_t left = loops.size() - closable.size();
        std::string advice = "Close it in the program that made the surface";
        if (widest <= widest_closable)
            advice += "; or, if the bone there does not matter, write `repair: {holes_up_to: " +
                      rounded(std::ceil(widest * 1e4) * 0.1, 1) + " mm}`";
        return SurfaceError{"E0649",
                            "the surface is open: " + counted(left, "hole", "holes") + ", the widest " +
                                rounded(widest * 1e3, 1) + " mm across, at " + position_text(at) +
                                "; what is inside must be closed.",
                            advice + "."};
    }
    for (const BorderLoop* loop : closable) close_hole(mesh, loop->vertices);
    if (!closable.empty())
        notes.push_back("Closed " + counted(closable.size(), "hole", "holes") + ", the widest " +
                        rounded(widest_closed * 1e3, 2) + " mm across, as `repair.holes_up_to` allows.");
    return std::nullopt;
}

// ---- orientation ----------------------------------------------------------------------------------------------------

/// Flips faces so that neighbours agree. The orientation with the larger area stays.
std::optional<SurfaceError> make_faces_agree(SurfaceMesh& mesh, std::vector<std::string>& notes) {
    struct Neighbour {
        std::uint32_t face;
        bool agrees;
    };
    std::vector<std::vector<Neighbour>> neighbours(mesh.triangles.size());
    bool all_agree = true;
    for_each_edge(half_edges_of(mesh), [&](const HalfEdge* first, const HalfEdge* last) {
        if (last - first != 2) return;
        const bool agrees = first[0].is_forward != first[1].is_forward;
        all_agree &= agrees;
        neighbours[first[0].face].push_back({first[1].face, agrees});
        neighbours[first[1].face].push_back({first[0].face, agrees});
    });
    if (all_agree) return std::nullopt;

    enum : std::uint8_t { unseen, as_it_is, turned };
    std::vector<std::uint8_t> state(mesh.triangles.size(), unseen);
    std::size_t turns = 0;
    for (std::uint32_t start = 0; start < state.size(); ++start) {
        if (state[start] != unseen) continue;
        std::vector<std::uint32_t> members{start};
        state[start] = as_it_is;
        double area = 0.0, turned_area = 0.0;
        for (std::size_t i = 0; i < members.size(); ++i) {
            const std::uint32_t face = members[i];
            const auto [a, b, c] = mesh.corners(mesh.triangles[face]);
            const double own = length(cross(b - a, c - a));
            area += own;
            turned_area += state[face] == turned ? own : 0.0;
            for (const Neighbour& n : neighbours[face]) {
                const std::uint8_t wanted = n.agrees == (state[face] == as_it_is) ? as_it_is : turned;
                if (state[n.face] == unseen) {
                    state[n.face] = wanted;
                    members.push_back(n.face);
                } else if (state[n.face] != wanted) {
                    return SurfaceError{
                        "E0651",
                        "the faces cannot all look outwards: going round along the surface one comes back "
                        "on its other side, near " +
                            position_text(a) + ".",
                        "Mend the surface in the program that made it."};
                }
            }
        }
        const std::uint8_t wrong = turned_area > 0.5 * area ? as_it_is : turned;
        for (const std::uint32_t face : members) {
            if (state[face] != wrong) continue;
            std::swap(mesh.triangles[face][1], mesh.triangles[face][2]);
            ++turns;
        }
    }
    notes.push_back("Turned " + counted(turns, "face", "faces") + " to look to the same side as the neighbours.");
    return std::nullopt;
}

std::optional<SurfaceError> check_edges(const SurfaceMesh& mesh) {
    std::optional<SurfaceError> wrong;
    std::size_t count = 0;
    const std::vector<HalfEdge> edges = half_edges_of(mesh);
    for_each_edge(edges, [&](const HalfEdge* first, const HalfEdge* last) {
        if (balance_of(first, last) == 0) return;
        if (count++ == 0)
            wrong = SurfaceError{"E0650", position_text(0.5 * (mesh.vertices[first->low] + mesh.vertices[first->high])),
                                 ""};
    });
    if (wrong) {
        wrong->message = counted(count, "edge", "edges") +
                         " where faces meet that have no common inside, the first at " + wrong->message +
                         "; along every edge as many faces must look to one side as to the other.";
        wrong->advice = "Mend the surface in the program that made it.";
    }
    return wrong;
}

/// One closed piece, its volume, and the pieces that contain it.
struct Part {
    SurfaceMesh mesh;
    std::vector<std::uint32_t> faces;  ///< numbers in the whole mesh
    double volume = 0.0;
    Box bounds{};
    std::vector<std::size_t> around;  ///< pieces that contain it
};

std::vector<Part> parts_of(const SurfaceMesh& mesh) {
    const Pieces pieces = pieces_of(mesh, half_edges_of(mesh));
    std::vector<Part> parts(pieces.count);
    for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
        Part& part = parts[pieces.of_face[f]];
        const auto first = static_cast<std::uint32_t>(part.mesh.vertices.size());
        for (const Vec3 corner : mesh.corners(mesh.triangles[f])) part.mesh.vertices.push_back(corner);
        part.mesh.triangles.push_back({first, first + 1, first + 2});
        part.faces.push_back(f);
    }
    for (Part& part : parts) {
        part.volume = signed_volume_of(part.mesh);
        part.bounds = bounds_of(part.mesh);
    }
    return parts;
}

bool contains(const Box& outer, const Box& inner) noexcept {
    return outer.low.x <= inner.low.x && outer.low.y <= inner.low.y && outer.low.z <= inner.low.z &&
           outer.high.x >= inner.high.x && outer.high.y >= inner.high.y && outer.high.z >= inner.high.z;
}

void find_nesting(std::vector<Part>& parts) {
    for (std::size_t outer = 0; outer < parts.size(); ++outer) {
        std::optional<TriangleTree> tree;
        for (std::size_t inner = 0; inner < parts.size(); ++inner) {
            if (inner == outer || !contains(parts[outer].bounds, parts[inner].bounds)) continue;
            if (!tree) tree.emplace(parts[outer].mesh);
            if (std::abs(tree->winding(parts[inner].mesh.vertices[0])) > 0.5) parts[inner].around.push_back(outer);
        }
    }
}

void turn(SurfaceMesh& mesh, const Part& part) {
    for (const std::uint32_t f : part.faces) std::swap(mesh.triangles[f][1], mesh.triangles[f][2]);
}

void drop(SurfaceMesh& mesh, const std::vector<Part>& parts, const std::vector<std::uint8_t>& is_dropped) {
    std::vector<std::uint8_t> face_is_dropped(mesh.triangles.size(), 0);
    for (std::size_t p = 0; p < parts.size(); ++p)
        for (const std::uint32_t f : parts[p].faces) face_is_dropped[f] = is_dropped[p];
    std::size_t at = 0;
    std::erase_if(mesh.triangles, [&](const Triangle&) { return face_is_dropped[at++] != 0; });
    drop_unused_vertices(mesh);
}

void drop_small_pieces(SurfaceMesh& mesh, double under, std::vector<std::string>& notes) {
    if (under <= 0.0) return;
    const std::vector<Part> parts = parts_of(mesh);
    std::vector<std::uint8_t> is_dropped(parts.size(), 0);
    std::size_t count = 0;
    double volume = 0.0;
    for (std::size_t p = 0; p < parts.size(); ++p) {
        if (std::abs(parts[p].volume) >= under) continue;
        is_dropped[p] = 1;
        ++count;
        volume += std::abs(parts[p].volume);
    }
    if (count == 0) return;
    drop(mesh, parts, is_dropped);
    notes.push_back("Left out " + counted(count, "piece", "pieces") + " of together " + rounded(volume * 1e9, 2) +
                    " mm3, as `repair.pieces_under` says.");
}

/// Orients outer pieces outwards and cavities in them inwards.
std::optional<SurfaceError> turn_pieces(SurfaceMesh& mesh, documents::InnerPieces inner,
                                        std::vector<std::string>& notes) {
    std::vector<Part> parts = parts_of(mesh);
    find_nesting(parts);

    // A surface that is completely inside out keeps its cavities: the contents of an outer piece are flipped with it.
    std::size_t turned = 0;
    std::vector<std::uint8_t> is_turned(parts.size(), 0);
    for (std::size_t p = 0; p < parts.size(); ++p) {
        if (!parts[p].around.empty() || parts[p].volume >= 0.0) continue;
        is_turned[p] = 1;
        for (std::size_t other = 0; other < parts.size(); ++other)
            if (std::find(parts[other].around.begin(), parts[other].around.end(), p) != parts[other].around.end())
                is_turned[other] = 1;
    }
    for (std::size_t p = 0; p < parts.size(); ++p) {
        if (is_turned[p] == 0) continue;
        turn(mesh, parts[p]);
        parts[p].volume = -parts[p].volume;
        ++turned;
    }
    if (turned > 0)
        notes.push_back(
            "Turned " +
            (turned == parts.size() ? std::string("the whole surface") : counted(turned, "piece", "pieces")) +
            ": it was inside out.");

    std::size_t cavities = 0, decided = 0;
    double hollow = 0.0;
    std::vector<std::uint8_t> is_dropped(parts.size(), 0);
    for (std::size_t p = 0; p < parts.size(); ++p) {
        if (parts[p].around.empty()) continue;
        const bool is_cavity = parts[p].around.size() % 2 == 1;
        if (is_cavity != (parts[p].volume < 0.0)) {
            const double volume = std::abs(parts[p].volume);
            if (inner == documents::InnerPieces::unsaid)
                return SurfaceError{"E0653",
                                    "a piece of " + rounded(volume * 1e9, 1) + " mm3 lies inside another, at " +
                                        position_text(parts[p].mesh.vertices[0]) +
                                        ", and its faces say that there is bone on both sides of it.",
                                    "If it is a cavity, write `repair: {inner: hollow}`; if it bounds nothing, "
                                    "`repair: {inner: solid}`."};
            ++decided;
            if (inner == documents::InnerPieces::solid) {
                is_dropped[p] = 1;
                continue;
            }
            turn(mesh, parts[p]);
        }
        if (is_cavity) {
            ++cavities;
            hollow += std::abs(parts[p].volume);
        }
    }
    if (decided > 0)
        notes.push_back(counted(decided, "piece", "pieces") + " inside others " +
                        (inner == documents::InnerPieces::hollow ? "made hollow" : "left out") +
                        ", as `repair.inner` says.");
    if (cavities > 0)
        notes.push_back("The bone has " + counted(cavities, "closed cavity", "closed cavities") + " of together " +
                        rounded(hollow * 1e9, 1) + " mm3.");
    drop(mesh, parts, is_dropped);
    return std::nullopt;
}

}  // namespace

std::size_t weld(SurfaceMesh& mesh) {
    std::vector<std::uint32_t> order(mesh.vertices.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto key = [&](std::uint32_t v) {
        const Vec3 p = mesh.vertices[v];
        return std::tuple(p.x, p.y, p.z, v);
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    std::vector<std::uint32_t> name(order.size());
    std::size_t removed_count = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool is_again = i > 0 && mesh.vertices[order[i]] == mesh.vertices[order[i - 1]];
        name[order[i]] = is_again ? name[order[i - 1]] : order[i];
        removed_count += is_again;
    }
    if (removed_count > 0) rename(mesh, name);
    return removed_count;
}

std::optional<SurfaceError> repair(SurfaceMesh& mesh, const RepairRules& rules, std::vector<std::string>& notes) {
    drop_collapsed(mesh, notes);
    drop_duplicates(mesh, notes);
    if (has_border(half_edges_of(mesh))) {
        if (const std::size_t removed_count = weld(mesh); removed_count > 0)
            notes.push_back("Made " + counted(removed_count, "vertex", "vertices") +
                            " one with another at the same place.");
        join_borders(mesh, notes);
        drop_collapsed(mesh, notes);
        drop_duplicates(mesh, notes);
    }
    if (auto error = make_faces_agree(mesh, notes)) return error;
    drop_small_pieces(mesh, rules.pieces_under, notes);
    if (auto error = close_holes(mesh, rules.holes_up_to, notes)) return error;
    if (auto error = check_edges(mesh)) return error;
    if (auto error = turn_pieces(mesh, rules.inner, notes)) return error;
    if (mesh.triangles.empty())
        return SurfaceError{"E0647", "no face is left that bounds an inside.", "A sheet without thickness is no bone."};
    return std::nullopt;
}

SurfaceMesh taken_cavities(SurfaceMesh& mesh) {
    std::vector<Part> parts = parts_of(mesh);
    SurfaceMesh found_cavities;
    if (parts.size() < 2) return found_cavities;
    find_nesting(parts);
    std::vector<std::uint8_t> is_inner(parts.size(), 0);
    for (std::size_t p = 0; p < parts.size(); ++p) {
        if (parts[p].around.empty()) continue;
        is_inner[p] = 1;
        turn(mesh, parts[p]);
        for (const std::uint32_t f : parts[p].faces) found_cavities.triangles.push_back(mesh.triangles[f]);
    }
    if (found_cavities.triangles.empty()) return found_cavities;
    found_cavities.vertices = mesh.vertices;
    drop_unused_vertices(found_cavities);
    drop(mesh, parts, is_inner);
    return found_cavities;
}

}  // namespace kerf::bone
