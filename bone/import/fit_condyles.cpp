// SPDX-License-Identifier: Apache-2.0
#include "bone/import/fit_condyles.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "bone/import/least_squares.h"

namespace kerf::bone {
namespace {

constexpr double apart = 0.5e-3;  // [m] between rays
constexpr double patch = 6e-3;    // [m] radius of the paraboloid's patch; a condyle's radius is about 20 mm
constexpr int max_rounds = 40;
constexpr double at_rest = 1e-8;  // [–] change of the direction

/// The directions of a plane: along the line, along the shaft, and backwards.
struct Frame {
    Vec3 line{}, shaft{}, back{};
};

struct Height {
    double x = 0.0, y = 0.0, z = 0.0;  ///< [m] along the frame's directions, from the centre of the search
};

struct Apex {
    Vec3 at{};
    double residual = 0.0;  ///< [m]
};

/// Returns how far back the surface reaches around a point. Leaves out rays that start in bone.
std::vector<Height> heights_around(const BoneShape& bone, Vec3 centre, const Frame& frame, double half, double reach) {
    std::vector<Height> heights;
    const int count = static_cast<int>(std::ceil(half / apart));
    for (int i = -count; i <= count; ++i)
        for (int j = -count; j <= count; ++j) {
            const double x = i * apart, y = j * apart;
            if (x * x + y * y > half * half) continue;
            const Vec3 start = centre + x * frame.line + y * frame.shaft - reach * frame.back;
            const RayHit hit = surface_inwards(bone, start, frame.back, 2.0 * reach);
            if (hit.kind == RayHit::Kind::surface) heights.push_back({x, y, hit.radius - reach});
        }
    return heights;
}

/// Fits z = c0 + c1 x + c2 y + c3 x² + c4 xy + c5 y² and returns its apex. Nothing without an apex within the patch.
std::optional<Apex> apex_of(const std::vector<Height>& heights, Vec3 centre, const Frame& frame) {
    constexpr double scale = 1e-3;  // [m] scales all unknowns to about 1
    LeastSquares<6> equations;
    const auto row = [&](const Height& h) {
        const double x = h.x / scale, y = h.y / scale;
        return std::array<double, 6>{1.0, x, y, x * x, x * y, y * y};
    };
    for (const Height& h : heights) equations.add(row(h), h.z / scale);
    const auto c = equations.solve();
    if (!c) return std::nullopt;
    const double determinant = 4.0 * (*c)[3] * (*c)[5] - (*c)[4] * (*c)[4];
    if (!((*c)[3] < 0.0 && determinant > 0.0)) return std::nullopt;
    const Height apex{((*c)[4] * (*c)[2] - 2.0 * (*c)[5] * (*c)[1]) / determinant * scale,
                      ((*c)[4] * (*c)[1] - 2.0 * (*c)[3] * (*c)[2]) / determinant * scale, 0.0};
    if (std::hypot(apex.x, apex.y) > patch) return std::nullopt;
    const auto height_at = [&](const Height& h) {
        double sum = 0.0;
        const auto terms = row(h);
        for (std::size_t i = 0; i < terms.size(); ++i) sum += (*c)[i] * terms[i];
        return sum * scale;
    };
    double squares = 0.0;
    for (const Height& h : heights) squares += (h.z - height_at(h)) * (h.z - height_at(h));
    return Apex{centre + apex.x * frame.line + apex.y * frame.shaft + height_at(apex) * frame.back,
                std::sqrt(squares / static_cast<double>(heights.size()))};
}

/// Returns the backmost point near `guess`; nothing if the surface reaches farther back at the edge of the search.
std::optional<Vec3> backmost_near(const BoneShape& bone, Vec3 guess, const Frame& frame, double within) {
    const std::vector<Height> heights = heights_around(bone, guess, frame, within, 2.0 * within);
    const auto highest =
        std::max_element(heights.begin(), heights.end(), [](const Height& a, const Height& b) { return a.z < b.z; });
    if (highest == heights.end() || std::hypot(highest->x, highest->y) > within - 1.5 * apart) return std::nullopt;
    return guess + highest->x * frame.line + highest->y * frame.shaft + highest->z * frame.back;
}

Frame frame_of(const CondylesGuess& guess, Vec3 from, Vec3 to) {
    Frame frame;
    frame.shaft = normalized(guess.shaft_to - guess.shaft_from);
    frame.line = normalized(to - from - dot(to - from, frame.shaft) * frame.shaft);
    frame.back = cross(frame.line, frame.shaft);
    if (dot(frame.back, 0.5 * (guess.from + guess.to) - guess.shaft_from) < 0.0) frame.back = -frame.back;
    return frame;
}

}  // namespace

std::optional<FittedCondyles> fit_condyles(const BoneShape& bone, const CondylesGuess& guess, std::size_t& failed) {
    std::array<Vec3, 2> at{guess.from, guess.to};
    FittedCondyles fitted;
    Frame frame = frame_of(guess, guess.from, guess.to);
    for (failed = 0; failed < 2; ++failed) {
        const auto start = backmost_near(bone, at[failed], frame, guess.within);
        if (!start) return std::nullopt;
        at[failed] = *start;
    }
    for (int round = 0; round < max_rounds; ++round) {
        frame = frame_of(guess, at[0], at[1]);
        fitted.residual = 0.0;
        for (failed = 0; failed < 2; ++failed) {
            const auto apex = apex_of(heights_around(bone, at[failed], frame, patch, 2.0 * patch), at[failed], frame);
            if (!apex) return std::nullopt;
            at[failed] = apex->at;
            fitted.residual = std::max(fitted.residual, apex->residual);
        }
        fitted.from = at[0];
        fitted.to = at[1];
        if (length(frame_of(guess, at[0], at[1]).line - frame.line) < at_rest && round > 4) break;
    }
    return fitted;
}

}  // namespace kerf::bone
