// SPDX-License-Identifier: Apache-2.0
#include "bone/radiograph/radiograph.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "bone/radiograph/bone_shadow.h"
#include "kerf/exact_math.hpp"

namespace kerf::bone {
namespace {

using Pixels = std::vector<float>;

std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }

/// Blurs with weights ¼, ½, ¼ along rows and columns: a standard deviation of 0.7 pixels. The border is repeated.
void blur(Pixels& pixels, int columns, int rows) {
    Pixels above(index(columns)), row(index(columns)), smooth(index(columns));
    const auto smoothed = [&](int r, Pixels& out) {
        const float* p = pixels.data() + index(r) * index(columns);
        const int last = columns - 1;
        for (int c = 1; c < last; ++c) out[index(c)] = 0.25f * (p[c - 1] + p[c + 1]) + 0.5f * p[c];
        out[0] = 0.25f * (p[0] + p[std::min(1, last)]) + 0.5f * p[0];
        if (last > 0) out[index(last)] = 0.25f * (p[last - 1] + p[last]) + 0.5f * p[last];
    };
    smoothed(0, row);
    above = row;
    for (int r = 0; r < rows; ++r) {
        if (r + 1 < rows)
            smoothed(r + 1, smooth);
        else
            smooth = row;
        float* out = pixels.data() + index(r) * index(columns);
        for (int c = 0; c < columns; ++c) out[c] = 0.25f * (above[index(c)] + smooth[index(c)]) + 0.5f * row[index(c)];
        std::swap(above, row);
        std::swap(row, smooth);
    }
}

/// Returns the means over squares of 2 · `reach` + 1 pixels, at the border over the part in the picture.
Pixels local_means(const Pixels& pixels, int columns, int rows, int reach) {
    Pixels across(pixels.size()), means(pixels.size());
    std::vector<double> running(index(columns) + 1);
    for (int r = 0; r < rows; ++r) {
        const float* p = pixels.data() + index(r) * index(columns);
        for (int c = 0; c < columns; ++c) running[index(c) + 1] = running[index(c)] + static_cast<double>(p[c]);
        float* out = across.data() + index(r) * index(columns);
        for (int c = 0; c < columns; ++c) {
            const int first = std::max(0, c - reach), end = std::min(columns, c + reach + 1);
            out[c] = static_cast<float>((running[index(end)] - running[index(first)]) / (end - first));
        }
    }
    std::vector<double> sums(index(columns), 0.0);
    const auto add = [&](int r, double sign) {
        const float* p = across.data() + index(r) * index(columns);
        for (int c = 0; c < columns; ++c) sums[index(c)] += sign * static_cast<double>(p[c]);
    };
    for (int r = 0; r < std::min(reach, rows); ++r) add(r, 1.0);
    for (int r = 0; r < rows; ++r) {
        if (r + reach < rows) add(r + reach, 1.0);
        if (r - reach - 1 >= 0) add(r - reach - 1, -1.0);
        const double inverse = 1.0 / (std::min(rows, r + reach + 1) - std::max(0, r - reach));
        float* out = means.data() + index(r) * index(columns);
        for (int c = 0; c < columns; ++c) out[c] = static_cast<float>(sums[index(c)] * inverse);
    }
    return means;
}

/// The circle of the collimator: 49 % of the shorter side.
struct Circle {
    int columns = 0, rows = 0;

    /// Returns the pixels of a row inside the circle; the last one is not included.
    [[nodiscard]] std::pair<int, int> in_row(int r) const noexcept {
        const double radius = 0.49 * std::min(columns, rows), dy = r + 0.5 - 0.5 * rows;
        const double square = radius * radius - dy * dy;
        if (!(square > 0.0)) return {0, 0};
        const double half = std::sqrt(square);
        return {std::max(0, static_cast<int>(std::ceil(0.5 * columns - half - 0.5))),
                std::min(columns, static_cast<int>(std::floor(0.5 * columns + half - 0.5)) + 1)};
    }
};

/// Values between which a part of the pixels lies.
struct Window {
    float low = 0.0f, middle = 0.0f, high = 1.0f;  ///< 2nd, 50th and 98th percentile
};

/// Returns the percentiles of pixels in the circle at which `bone` is above a threshold; of all, if these are few.
Window window_of(const Pixels& pixels, const Pixels& bone, const Circle& circle) {
    constexpr float thin_bone = 0.03f;  // [–] about a millimetre of compact bone
    constexpr std::size_t bins = 4096;
    std::vector<std::uint32_t> counts;
    for (const float threshold : {thin_bone, -HUGE_VALF}) {
        float low = HUGE_VALF, high = -HUGE_VALF;
        std::size_t count = 0, all = 0;
        const auto for_each = [&](const auto& visit) {
            for (int r = 0; r < circle.rows; ++r) {
                const auto [begin, end] = circle.in_row(r);
                for (int c = begin; c < end; ++c) {
                    const std::size_t i = index(r) * index(circle.columns) + index(c);
                    ++all;
                    if (bone[i] > threshold) visit(pixels[i]);
                }
            }
        };
        for_each([&](float v) {
            low = std::min(low, v);
            high = std::max(high, v);
            ++count;
        });
        if (count == 0 || count * 50 < all) continue;
        if (!(high > low)) return {low - 0.5f, low, low + 0.5f};
        counts.assign(bins, 0);
        const float per_value = static_cast<float>(bins - 1) / (high - low);
        for_each([&](float v) { ++counts[static_cast<std::size_t>((v - low) * per_value)]; });
        const auto percentile = [&](double part) {
            double left = part * static_cast<double>(count);
            std::size_t bin = 0;
            while (bin + 1 < bins && left > static_cast<double>(counts[bin]))
                left -= static_cast<double>(counts[bin++]);
            return low + static_cast<float>(bin) / per_value;
        };
        return {percentile(0.02), percentile(0.5), percentile(0.98)};
    }
    return {};
}

/// Returns a number with mean 0 and standard deviation 1, about normal: the sum of four bytes of a hash.
float noise_of(std::uint64_t pixel, std::uint64_t shot) noexcept {
    std::uint64_t x = (shot + 1) * 0x9e3779b97f4a7c15u + pixel * 0xd1342543de82ef95u;
    x = (x ^ (x >> 32)) * 0xd6e8feb86659fd93u;
    x = (x ^ (x >> 32)) * 0xd6e8feb86659fd93u;
    const auto byte = [&](int shift) { return static_cast<int>(x >> shift & 0xff); };
    const int sum = byte(32) + byte(40) + byte(48) + byte(56);
    return static_cast<float>(sum - 510) * (1.0f / 147.8f);
}

/// Returns about e^(x/2), without a library: photons fall with the depth x, and their noise grows with 1/√photons.
float noise_growth(float x) noexcept {
    const float y = 1.0f + std::clamp(x, -4.0f, 4.0f) * 0.125f, y2 = y * y;
    return y2 * y2;
}

/// Returns a value compressed beyond `low` … `high`: its slope is 1 there, and it stays within ⅓ `low` … 1.
float compressed(float value, float low, float high) noexcept {
    const auto bend = [](float beyond, float room) { return beyond / (1.0f + beyond / room); };
    if (value > high) return high + bend(value - high, 1.0f - high);
    if (value < low) return low - bend(low - value, 0.67f * low);
    return value;
}

/// Multiplies metal into a picture of values 0 … 1.
void multiply_metal(Pixels& picture, Pixels metal, int columns, int rows) {
    if (std::all_of(metal.begin(), metal.end(), [](float m) { return m == 0.0f; })) return;
    for (float& m : metal) m = m == 0.0f ? 1.0f : static_cast<float>(exp_exact(-static_cast<double>(m)));
    blur(metal, columns, rows);
    for (std::size_t i = 0; i < picture.size(); ++i) picture[i] *= metal[i];
}

}  // namespace

Radiograph radiograph(const AttenuationImage& image, const Beam& beam, std::span<const MetalShape> metal,
                      const Development& development) {
    BoneShadow shadow = bone_shadow(image, beam);
    Radiograph picture;
    picture.error = std::move(shadow.error);
    if (!picture.error.empty()) return picture;
    const int columns = picture.columns = shadow.columns, rows = picture.rows = shadow.rows;
    const Circle circle{columns, rows};

    // Blur, and take away a part of the local mean.
    Pixels& depth = shadow.soft;
    for (std::size_t i = 0; i < depth.size(); ++i) depth[i] += shadow.bone[i];
    blur(depth, columns, rows);
    const double reach = 0.5 * development.neighbourhood * columns / 512.0;
    const Pixels means = local_means(depth, columns, rows, std::clamp(static_cast<int>(reach), 0, columns));
    const Window exposure = window_of(depth, shadow.bone, circle);
    Pixels sharp(depth.size());
    const float taken = static_cast<float>(development.sharpening);
    for (std::size_t i = 0; i < sharp.size(); ++i) sharp[i] = depth[i] - taken * means[i];

    // Scale to the bone; 0 is black.
    const Window window = window_of(sharp, shadow.bone, circle);
    const float range = std::max(window.high - window.low, 1e-3f);
    const float bright = static_cast<float>(development.brightest), dark = static_cast<float>(development.darkest);
    const float slope = (dark - bright) / range;
    const float noise = static_cast<float>(development.noise);
    Pixels& values = sharp;
    for (int r = 0; r < rows; ++r) {
        const auto [begin, end] = circle.in_row(r);
        for (int c = begin; c < end; ++c) {
            const std::size_t i = index(r) * index(columns) + index(c);
            const float grain = noise * noise_growth(depth[i] - exposure.middle) * noise_of(i, development.shot);
            values[i] = compressed(bright + slope * (sharp[i] + grain - window.low), dark, bright);
        }
    }
    multiply_metal(values, metal_shadow(metal, beam), columns, rows);

    picture.grey.assign(values.size(), 0);
    for (int r = 0; r < rows; ++r) {
        const auto [begin, end] = circle.in_row(r);
        for (int c = begin; c < end; ++c) {
            const std::size_t i = index(r) * index(columns) + index(c);
            picture.grey[i] = static_cast<std::uint8_t>(std::clamp(values[i] * 255.0f + 0.5f, 0.0f, 255.0f));
        }
    }
    return picture;
}

}  // namespace kerf::bone
