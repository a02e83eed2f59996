// SPDX-License-Identifier: Apache-2.0
#include "core/import/ct_body.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/import/data_file.h"
#include "core/import/image/image_file.h"
#include "core/import/planned_region.h"

namespace kerf {
namespace {

constexpr std::array<std::array<int, 3>, 6> neighbours{
    {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};

Diagnostic error(const char* code, const std::string& file, std::string message, const std::string& advice) {
    Diagnostic d;
    d.code = code;
    d.place.file = file;
    d.message = std::move(message) + " " + advice;
    return d;
}

/// Voxels that are bone, on the grid of `image`.
struct Mask {
    const VoxelImage& image;
    std::vector<std::uint8_t> is_bone;

    explicit Mask(const VoxelImage& of) : image(of), is_bone(of.values.size(), 0) {}

    /// Outside the grid there is no bone.
    [[nodiscard]] bool at(int i, int j, int k) const noexcept {
        return image.has(i, j, k) && is_bone[image.offset(i, j, k)] != 0;
    }
    [[nodiscard]] std::size_t count() const {
        return static_cast<std::size_t>(std::count(is_bone.begin(), is_bone.end(), std::uint8_t{1}));
    }
};

template <class Visit>  // visit(i, j, k, offset)
void for_each_voxel(const VoxelImage& image, const Visit& visit) {
    std::size_t at = 0;
    for (int k = 0; k < image.size[2]; ++k)
        for (int j = 0; j < image.size[1]; ++j)
            for (int i = 0; i < image.size[0]; ++i) visit(i, j, k, at++);
}

// ---- the part that matters ------------------------------------------------------------------------------------------

/// Around the axes, as far as the image goes. (An image that is turned against LPS has corners that are not in its box:
/// there is air.)
Box region_of(const std::vector<LandmarkAxis>& axes, const VoxelImage& image) {
    Box ends{{HUGE_VAL, HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}};
    for (int corner = 0; corner < 8; ++corner) {
        const auto end = [&](std::size_t axis) {
            return corner >> axis & 1 ? static_cast<double>(image.size[axis] - 1) : 0.0;
        };
        const Vec3 p = image.lps({end(0), end(1), end(2)});
        ends.low = {std::min(ends.low.x, p.x), std::min(ends.low.y, p.y), std::min(ends.low.z, p.z)};
        ends.high = {std::max(ends.high.x, p.x), std::max(ends.high.y, p.y), std::max(ends.high.z, p.z)};
    }
    return common_part(box_around(axes), ends);
}

/// The box's voxels and `margin` [m] around them; an image without voxels if they miss each other.
VoxelImage cropped(const VoxelImage& image, const Box& box, double margin) {
    std::array<double, 3> low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 at = image.index({corner & 1 ? box.high.x + margin : box.low.x - margin,
                                     corner & 2 ? box.high.y + margin : box.low.y - margin,
                                     corner & 4 ? box.high.z + margin : box.low.z - margin});
        const std::array<double, 3> index{at.x, at.y, at.z};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], index[axis]);
            high[axis] = std::max(high[axis], index[axis]);
        }
    }
    std::array<int, 3> first{};
    VoxelImage part;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double last = image.size[axis] - 1;
        if (!(high[axis] >= 0.0 && low[axis] <= last)) return {};
        first[axis] = static_cast<int>(std::floor(std::clamp(low[axis], 0.0, last)));
        part.size[axis] = static_cast<int>(std::ceil(std::clamp(high[axis], 0.0, last))) - first[axis] + 1;
        if (part.size[axis] < 2) return {};
    }
    std::array<double, 12> placed = image.lps_from_index;
    const Vec3 origin =
        image.lps({static_cast<double>(first[0]), static_cast<double>(first[1]), static_cast<double>(first[2])});
    placed[3] = origin.x;
    placed[7] = origin.y;
    placed[11] = origin.z;
    part.place(placed);
    part.values.reserve(static_cast<std::size_t>(part.size[0]) * static_cast<std::size_t>(part.size[1]) *
                        static_cast<std::size_t>(part.size[2]));
    for (int k = 0; k < part.size[2]; ++k)
        for (int j = 0; j < part.size[1]; ++j)
            for (int i = 0; i < part.size[0]; ++i)
                part.values.push_back(image.at(first[0] + i, first[1] + j, first[2] + k));
    return part;
}

bool on_one_grid(const VoxelImage& a, const VoxelImage& b) {
    if (a.size != b.size) return false;
    for (std::size_t n = 0; n < 12; ++n)
        if (!(std::abs(a.lps_from_index[n] - b.lps_from_index[n]) < 1e-5)) return false;  // 0.01 mm
    return true;
}

bool is_sheared(const VoxelImage& image) {
    const auto column = [&](std::size_t axis) {
        return normalized(
            Vec3{image.lps_from_index[axis], image.lps_from_index[4 + axis], image.lps_from_index[8 + axis]});
    };
    return std::abs(dot(column(0), column(1))) > 1e-3 || std::abs(dot(column(1), column(2))) > 1e-3 ||
           std::abs(dot(column(2), column(0))) > 1e-3;
}

// ---- the mask -------------------------------------------------------------------------------------------------------

bool is_kept(float label, const std::vector<int>& keep) {
    return std::find(keep.begin(), keep.end(), static_cast<int>(std::lround(label))) != keep.end();
}

/// Voxels that can be reached from `start` over faces, among those that hold `of`; marked in `seen`.
std::vector<std::size_t> connected(const Mask& mask, std::array<int, 3> start, bool of,
                                   std::vector<std::uint8_t>& seen) {
    std::vector<std::size_t> found;
    std::vector<std::array<int, 3>> open{start};
    seen[mask.image.offset(start[0], start[1], start[2])] = 1;
    while (!open.empty()) {
        const auto [i, j, k] = open.back();
        open.pop_back();
        found.push_back(mask.image.offset(i, j, k));
        for (const auto& step : neighbours) {
            const int x = i + step[0], y = j + step[1], z = k + step[2];
            if (!mask.image.has(x, y, z) || mask.at(x, y, z) != of) continue;
            if (auto& mark = seen[mask.image.offset(x, y, z)]; mark == 0) {
                mark = 1;
                open.push_back({x, y, z});
            }
        }
    }
    return found;
}

/// Leaves only the largest piece: what touches nothing was noise, or another bone. Returns how many there were.
int keep_largest(Mask& mask) {
    int pieces = 0;
    std::vector<std::uint8_t> seen(mask.is_bone.size(), 0);
    std::vector<std::size_t> largest;
    for_each_voxel(mask.image, [&](int i, int j, int k, std::size_t at) {
        if (mask.is_bone[at] == 0 || seen[at] != 0) return;
        ++pieces;
        if (auto piece = connected(mask, {i, j, k}, true, seen); piece.size() > largest.size())
            largest = std::move(piece);
    });
    std::fill(mask.is_bone.begin(), mask.is_bone.end(), std::uint8_t{0});
    for (const std::size_t at : largest) mask.is_bone[at] = 1;
    return pieces;
}

/// Every voxel within `radius` [m] of one that holds `value` holds it too.
void spread(Mask& mask, bool value, double radius) {
    const VoxelImage& image = mask.image;
    std::array<int, 3> reach{};
    for (std::size_t axis = 0; axis < 3; ++axis) reach[axis] = static_cast<int>(radius / image.spacing(axis));
    std::vector<std::array<int, 3>> ball;
    for (int z = -reach[2]; z <= reach[2]; ++z)
        for (int y = -reach[1]; y <= reach[1]; ++y)
            for (int x = -reach[0]; x <= reach[0]; ++x)
                if (std::hypot(x * image.spacing(0), y * image.spacing(1), z * image.spacing(2)) <= radius)
                    ball.push_back({x, y, z});

    const Mask before = mask;
    for_each_voxel(image, [&](int i, int j, int k, std::size_t at) {
        if ((before.is_bone[at] != 0) != value) return;
        const bool is_border = std::any_of(neighbours.begin(), neighbours.end(), [&](const auto& step) {
            const int x = i + step[0], y = j + step[1], z = k + step[2];
            return image.has(x, y, z) && before.at(x, y, z) != value;
        });
        if (!is_border) return;
        for (const auto& [x, y, z] : ball)
            if (image.has(i + x, j + y, k + z)) mask.is_bone[image.offset(i + x, j + y, k + z)] = value ? 1 : 0;
    });
}

void fill_cavities(Mask& mask) {
    std::vector<std::uint8_t> is_open(mask.is_bone.size(), 0);
    const auto& size = mask.image.size;
    for_each_voxel(mask.image, [&](int i, int j, int k, std::size_t at) {
        const bool is_face = i == 0 || j == 0 || k == 0 || i == size[0] - 1 || j == size[1] - 1 || k == size[2] - 1;
        if (is_face && mask.is_bone[at] == 0 && is_open[at] == 0) connected(mask, {i, j, k}, false, is_open);
    });
    for (std::size_t at = 0; at < is_open.size(); ++at)
        if (is_open[at] == 0) mask.is_bone[at] = 1;
}

/// Moves the border by at most one voxel to where the grey values cross the threshold.
void follow_grey(Mask& mask, const VoxelImage* labels, double threshold) {
    const Mask before = mask;
    const auto is_bright = [&](int i, int j, int k) {
        return static_cast<double>(mask.image.at(i, j, k)) >= threshold;
    };
    for_each_voxel(mask.image, [&](int i, int j, int k, std::size_t at) {
        const bool is_bone = before.is_bone[at] != 0;
        if (!is_bone && labels && labels->values[at] > 0.5f) return;  // another bone
        if (is_bone == is_bright(i, j, k)) return;
        for (const auto& [x, y, z] : neighbours) {
            if (!mask.image.has(i + x, j + y, k + z) || before.at(i + x, j + y, k + z) == is_bone) continue;
            // Bone darker than the threshold is no bone only if brighter bone lies behind it: cancellous bone is dark.
            const bool has_rim =
                mask.image.has(i - x, j - y, k - z) && before.at(i - x, j - y, k - z) && is_bright(i - x, j - y, k - z);
            if (!is_bone || has_rim) mask.is_bone[at] = is_bone ? 0 : 1;
        }
    });
}

// ---- the distance ---------------------------------------------------------------------------------------------------

/// Distance to a plane that crosses the axes at `ways` [m]; HUGE_VAL: it does not cross that one.
double distance_to_plane(const std::array<double, 3>& ways) {
    double sum = 0.0;
    for (const double way : ways) sum += 1.0 / (std::max(way, 1e-9) * std::max(way, 1e-9));
    return sum > 0.0 ? 1.0 / std::sqrt(sum) : HUGE_VAL;
}

/// The distance at a voxel whose neighbours along the axes lie `near` [m] from the border: |∇d| = 1, upwind.
double solved(std::array<double, 3> near, std::array<double, 3> spacing) {
    for (std::size_t a = 0; a < 2; ++a)  // nearest first
        for (std::size_t b = 0; b < 2 - a; ++b)
            if (near[b] > near[b + 1]) {
                std::swap(near[b], near[b + 1]);
                std::swap(spacing[b], spacing[b + 1]);
            }
    double distance = HUGE_VAL;
    double s0 = 0.0, s1 = 0.0, s2 = 0.0;  // Σ 1/h², Σ n/h², Σ n²/h²
    for (std::size_t axis = 0; axis < 3 && near[axis] < distance; ++axis) {
        const double w = 1.0 / (spacing[axis] * spacing[axis]);
        s0 += w;
        s1 += w * near[axis];
        s2 += w * near[axis] * near[axis];
        const double root = s1 * s1 - s0 * (s2 - 1.0);
        if (root < 0.0) break;
        distance = (s1 + std::sqrt(root)) / s0;
    }
    return distance;
}

/// `crossing_share`: of the faces between bone and air, where the values cross the threshold.
VoxelImage distances(const Mask& mask, double threshold, double& crossing_share) {
    std::size_t faces = 0, crossings = 0;
    const VoxelImage& image = mask.image;
    VoxelImage result = image;
    std::vector<double> distance(image.values.size(), HUGE_VAL);
    std::vector<std::uint8_t> is_fixed(image.values.size(), 0);
    const std::array<double, 3> spacing{image.spacing(0), image.spacing(1), image.spacing(2)};

    // Voxels beside the border: from where it crosses the lines to their neighbours.
    for_each_voxel(image, [&](int i, int j, int k, std::size_t at) {
        std::array<double, 3> ways{HUGE_VAL, HUGE_VAL, HUGE_VAL};
        const bool is_bone = mask.is_bone[at] != 0;
        for (std::size_t n = 0; n < neighbours.size(); ++n) {
            const auto& [x, y, z] = neighbours[n];
            if (!image.has(i + x, j + y, k + z) || mask.at(i + x, j + y, k + z) == is_bone) continue;
            const auto here = static_cast<double>(image.values[at]);
            const auto there = static_cast<double>(image.at(i + x, j + y, k + z));
            const bool crosses =
                is_bone ? here >= threshold && there < threshold : here < threshold && there >= threshold;
            ++faces;
            crossings += crosses;
            const double share = crosses ? (here - threshold) / (here - there) : 0.5;
            ways[n / 2] = std::min(ways[n / 2], share * spacing[n / 2]);
        }
        const double near = distance_to_plane(ways);
        if (near == HUGE_VAL) return;
        distance[at] = near;
        is_fixed[at] = 1;
    });

    // All others, in the eight directions in which the nearest border can lie; twice, for winding bone.
    for (int sweep = 0; sweep < 16; ++sweep) {
        const auto along = [&](std::size_t axis, int n) { return sweep >> axis & 1 ? image.size[axis] - 1 - n : n; };
        for (int c = 0; c < image.size[2]; ++c)
            for (int b = 0; b < image.size[1]; ++b)
                for (int a = 0; a < image.size[0]; ++a) {
                    const std::array<int, 3> v{along(0, a), along(1, b), along(2, c)};
                    const std::size_t at = image.offset(v[0], v[1], v[2]);
                    if (is_fixed[at] != 0) continue;
                    std::array<double, 3> near{HUGE_VAL, HUGE_VAL, HUGE_VAL};
                    for (std::size_t n = 0; n < neighbours.size(); ++n) {
                        const int x = v[0] + neighbours[n][0], y = v[1] + neighbours[n][1], z = v[2] + neighbours[n][2];
                        if (image.has(x, y, z)) near[n / 2] = std::min(near[n / 2], distance[image.offset(x, y, z)]);
                    }
                    distance[at] = std::min(distance[at], solved(near, spacing));
                }
    }
    for (std::size_t at = 0; at < distance.size(); ++at) {
        const double capped = std::min(distance[at], 1.0);  // [m]
        result.values[at] = static_cast<float>(mask.is_bone[at] != 0 ? -capped : capped);
    }
    crossing_share = faces > 0 ? static_cast<double>(crossings) / static_cast<double>(faces) : 0.0;
    return result;
}

// ---- the density ----------------------------------------------------------------------------------------------------

/// Gives every voxel that is not `known` the mean of its known neighbours, layer by layer from the known ones outwards.
void extend(VoxelImage& image, std::vector<std::uint8_t> known) {
    std::vector<std::array<int, 3>> front, next;
    const auto has_unknown_neighbour = [&](int i, int j, int k, const auto& visit) {
        for (const auto& [x, y, z] : neighbours)
            if (image.has(i + x, j + y, k + z) && known[image.offset(i + x, j + y, k + z)] == 0)
                visit(i + x, j + y, k + z);
    };
    constexpr std::uint8_t is_known = 1, is_next = 2;
    const auto look_from = [&](int i, int j, int k) {
        has_unknown_neighbour(i, j, k, [&](int x, int y, int z) {
            known[image.offset(x, y, z)] = is_next;
            next.push_back({x, y, z});
        });
    };
    for_each_voxel(image, [&](int i, int j, int k, std::size_t at) {
        if (known[at] == is_known) look_from(i, j, k);
    });
    while (!next.empty()) {
        front.swap(next);
        next.clear();
        for (const auto& [i, j, k] : front) {
            double sum = 0.0, count = 0.0;
            for (const auto& [x, y, z] : neighbours) {
                if (!image.has(i + x, j + y, k + z) || known[image.offset(i + x, j + y, k + z)] != is_known) continue;
                sum += static_cast<double>(image.at(i + x, j + y, k + z));
                count += 1.0;
            }
            image.values[image.offset(i, j, k)] = static_cast<float>(sum / count);
        }
        for (const auto& [i, j, k] : front) known[image.offset(i, j, k)] = is_known;
        for (const auto& [i, j, k] : front) look_from(i, j, k);
    }
}

/// Densities of the voxels that are deeper in bone than `cortex` [m], extended to all; none if there are no such
/// voxels.
std::optional<VoxelImage> densities(const VoxelImage& part, const VoxelImage& distance, double cortex,
                                    const DensityLine& line, std::vector<std::string>& notes) {
    double sum = 0.0, count = 0.0, least = HUGE_VAL, most = -HUGE_VAL;
    VoxelImage density = part;
    std::vector<std::uint8_t> known(part.values.size(), 0);
    for (std::size_t at = 0; at < part.values.size(); ++at) {
        if (static_cast<double>(distance.values[at]) >= -cortex) continue;
        known[at] = 1;
        const double by_line = line.at_zero + line.per_unit * static_cast<double>(part.values[at]);
        const double here = std::max(line.floor, by_line);
        density.values[at] = static_cast<float>(here);
        sum += here;
        count += 1.0;
        least = std::min(least, here);
        most = std::max(most, here);
    }
    const auto g_per_cm3 = [](double density_si, int digits) { return rounded(density_si * 1e-3, digits); };
    std::string note = "Density of the innermost tissue: " + g_per_cm3(line.at_zero, 2) + " + " +
                       g_per_cm3(line.per_unit, 6) + " × value g/cm3, at least " + g_per_cm3(line.floor, 2) +
                       " g/cm3; ";
    note += count > 0.0 ? "by voxel, mean " + g_per_cm3(sum / count, 2) + ", from " + g_per_cm3(least, 2) + " to " +
                              g_per_cm3(most, 2) + " g/cm3."
                        : "the same everywhere, as no voxel is deeper than the cortex.";
    notes.push_back(line.source.empty() ? note : note + " Source: " + line.source);
    if (count == 0.0) return std::nullopt;
    extend(density, std::move(known));
    return density;
}

}  // namespace

std::optional<CtBone> make_ct_bone(const Anatomy& anatomy, const VoxelImage& image, const VoxelImage* labels,
                                   Diagnostics& diagnostics) {
    const CtSource& ct = *anatomy.ct;
    const auto refuse = [&](const char* code, std::string message, const std::string& advice) {
        diagnostics.push_back(error(code, anatomy.file, std::move(message), advice));
        return std::nullopt;
    };
    if (labels && !on_one_grid(image, *labels))
        return refuse("E0630", "the voxels of `ct.labels` do not lie where those of `ct.image` do.",
                      "Resample the label map onto the image.");
    if (is_sheared(image))
        return refuse("E0632", "the image's axes are not at right angles, as after a tilted gantry.",
                      "Resample the image onto a straight grid.");

    CtBone bone;
    bone.region = region_of(anatomy.axes, image);
    const double coarsest = std::max({image.spacing(0), image.spacing(1), image.spacing(2)});
    const double margin =
        ct.closing + 3.0 * coarsest;  // so that closing and distance see both sides of the region's faces
    const Vec3 extent = bone.region.high - bone.region.low;
    const bool has_region = !anatomy.axes.empty() && extent.x > 0.0 && extent.y > 0.0 && extent.z > 0.0;
    const VoxelImage part = has_region ? cropped(image, bone.region, margin) : VoxelImage{};
    if (part.values.empty())
        return refuse("E0631", "the landmarks' axes lie outside the image.",
                      "Check that the axes are LPS, and the image is theirs.");
    const VoxelImage label_part = labels ? cropped(*labels, bone.region, margin) : VoxelImage{};

    std::vector<std::string>& notes = bone.report.notes;
    const auto millimetres = [](double metres) { return rounded(metres * 1e3, 2); };
    notes.push_back("CT: voxels of " + millimetres(image.spacing(0)) + " × " + millimetres(image.spacing(1)) + " × " +
                    millimetres(image.spacing(2)) + " mm; of it " + rounded(extent.x * 1e3, 0) + " × " +
                    rounded(extent.y * 1e3, 0) + " × " + rounded(extent.z * 1e3, 0) +
                    " mm around the planned axes. Beyond, bone goes on and cannot be cut.");

    Mask mask(part);
    for (std::size_t at = 0; at < part.values.size(); ++at)
        mask.is_bone[at] =
            labels ? is_kept(label_part.values[at], ct.keep) : static_cast<double>(part.values[at]) >= ct.threshold;
    std::string note = "Mask: " + std::to_string(mask.count()) + " voxels ";
    if (labels) {
        note += "by label";
        for (const int one : ct.keep) note += " " + std::to_string(one);
    } else {
        note += "of " + rounded(ct.threshold, 0) + " and more";
        const int pieces = keep_largest(mask);
        note += "; of " + std::to_string(pieces) + " pieces the largest is kept, " + std::to_string(mask.count()) +
                " voxels";
    }
    const auto added_by = [&](const auto& change) {
        const std::size_t before = mask.count();
        change();
        const std::size_t after = mask.count();
        return (after < before ? "took " : "added ") + std::to_string(after < before ? before - after : after - before);
    };
    if (ct.closing > 0.0)
        note += "; closing by " + millimetres(ct.closing) + " mm " + added_by([&] {
                    spread(mask, true, ct.closing);
                    spread(mask, false, ct.closing);
                });
    if (ct.fill) note += "; filling cavities " + added_by([&] { fill_cavities(mask); });
    if (mask.count() > 0) {
        const std::vector<std::uint8_t> before = mask.is_bone;
        follow_grey(mask, labels ? &label_part : nullptr, ct.threshold);
        std::size_t moved = 0;
        for (std::size_t at = 0; at < before.size(); ++at) moved += before[at] != mask.is_bone[at];
        note += "; the grey values moved " + std::to_string(moved) + " over the border";
    }
    bone.voxels = mask.count();
    if (bone.voxels == 0)
        return refuse("E0633", "no voxel around the axes is bone.",
                      labels ? "Check `ct.labels.keep`." : "Lower `ct.threshold`.");
    notes.push_back(note + ". In the end " + std::to_string(bone.voxels) + " are bone.");
    double crossing_share = 0.0;
    bone.distance = distances(mask, ct.threshold, crossing_share);
    notes.push_back("Border: between the voxels where the values cross " + rounded(ct.threshold, 0) + ", at " +
                    rounded(100.0 * crossing_share, 0) + " % of it; half way between them at the rest.");

    double cortex = 0.0;
    for (const auto& tissue : anatomy.tissues) cortex += tissue.thickness;
    double sum = 0.0;
    std::size_t deep = 0;
    for (std::size_t at = 0; at < part.values.size(); ++at)
        if (static_cast<double>(bone.distance.values[at]) < -cortex) {
            sum += static_cast<double>(part.values[at]);
            ++deep;
        }
    bone.mean_value = deep > 0 ? sum / static_cast<double>(deep) : ct.threshold;
    if (ct.density) bone.density = densities(part, bone.distance, cortex, *ct.density, notes);
    return bone;
}

std::optional<CtBone> make_ct_bone(const Anatomy& anatomy, Diagnostics& diagnostics) {
    ImportReport files;
    const auto read = [&](const std::string& written) -> std::optional<VoxelImage> {
        const std::string file = found_file(written, anatomy.file);
        auto image = read_image(file, diagnostics);
        if (!image) return std::nullopt;
        // A header without voxels names a file that has them.
        std::vector<std::string> parts{file};
        if (file.ends_with(".mhd"))
            if (const auto header = check_image_file(file, diagnostics)) parts.push_back(header->data_file);
        for (const std::string& part : parts)
            if (!hash_of_file(part, files.file_hashes.emplace_back())) {
                diagnostics.push_back(
                    error("E0620", file, "the file could be read once, but not again.", "Try again."));
                return std::nullopt;
            }
        return image;
    };
    const auto image = read(anatomy.ct->image);
    if (!image) return std::nullopt;
    std::optional<VoxelImage> labels;
    if (!anatomy.ct->labels.empty() && !(labels = read(anatomy.ct->labels))) return std::nullopt;
    auto bone = make_ct_bone(anatomy, *image, labels ? &*labels : nullptr, diagnostics);
    if (bone) bone->report.file_hashes = std::move(files.file_hashes);
    return bone;
}

}  // namespace kerf
