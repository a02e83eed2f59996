// SPDX-License-Identifier: Apache-2.0
#include "bench/dense_field.h"

#include <algorithm>
#include <cmath>

namespace kerf::bench {

DenseField::DenseField(Vec3 low, Vec3 high, double spacing, const PlainPapers::Drill& drill)
    : low_(low), spacing_(spacing), drill_(drill) {
    const Vec3 extent = (1.0 / spacing) * (high - low);
    size_[0] = static_cast<int>(extent.x + 1.5);
    size_[1] = static_cast<int>(extent.y + 1.5);
    size_[2] = static_cast<int>(extent.z + 1.5);
    samples_.resize(static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(size_[1]) *
                    static_cast<std::size_t>(size_[2]));
    const Vec3 middle = 0.5 * (low + high), half = 0.5 * (high - low);
    for (int k = 0; k < size_[2]; ++k)
        for (int j = 0; j < size_[1]; ++j)
            for (int i = 0; i < size_[0]; ++i) {
                const Vec3 p = low + spacing * Vec3{double(i), double(j), double(k)} - middle;
                at(i, j, k) = std::max({std::abs(p.x) - half.x, std::abs(p.y) - half.y, std::abs(p.z) - half.z});
            }
}

DenseField::Answer DenseField::interpolate(Vec3 p) const {
    const Vec3 g = (1.0 / spacing_) * (p - low_);
    const int i = static_cast<int>(std::floor(g.x)), j = static_cast<int>(std::floor(g.y)),
              k = static_cast<int>(std::floor(g.z));
    if (i < 0 || j < 0 || k < 0 || i + 1 >= size_[0] || j + 1 >= size_[1] || k + 1 >= size_[2])
        return {4.0 * spacing_, {0, 0, 0}};
    const double fx = g.x - i, fy = g.y - j, fz = g.z - k;
    const auto lerp = [](double a, double b, double t) { return a + (b - a) * t; };
    const double x00 = value(i + 1, j, k) - value(i, j, k), x10 = value(i + 1, j + 1, k) - value(i, j + 1, k);
    const double x01 = value(i + 1, j, k + 1) - value(i, j, k + 1),
                 x11 = value(i + 1, j + 1, k + 1) - value(i, j + 1, k + 1);
    const double c00 = value(i, j, k) + x00 * fx, c10 = value(i, j + 1, k) + x10 * fx;
    const double c01 = value(i, j, k + 1) + x01 * fx, c11 = value(i, j + 1, k + 1) + x11 * fx;
    const double c0 = lerp(c00, c10, fy), c1 = lerp(c01, c11, fy);
    return {lerp(c0, c1, fz),
            {lerp(lerp(x00, x10, fy), lerp(x01, x11, fy), fz), lerp(c10 - c00, c11 - c01, fz), c1 - c0}};
}

double DenseField::cutting(const Pose& body_from_tool, const std::vector<Vec3>& elements) const {
    double sum = 0.0;
    for (const Vec3 element : elements)
        sum += std::clamp(0.5 - 4.0 * interpolate(body_from_tool * element).distance / spacing_, 0.0, 1.0);
    return sum;
}

Vec3 DenseField::contact(const Pose& body_from_tool, const std::vector<Vec3>& points) const {
    Vec3 sum{0, 0, 0};
    const Quat tool_from_body = conjugate(body_from_tool.rotation);
    for (const Vec3 point : points) {
        const Answer a = interpolate(body_from_tool * point);
        sum = sum + a.distance * rotate(tool_from_body, normalized(a.gradient));
    }
    return sum;
}

void DenseField::remove(const Pose& body_from_tool) {
    const Pose tool_from_body = inverse(body_from_tool);
    const Vec3 tip = body_from_tool * Vec3{0, 0, 0}, end = body_from_tool * Vec3{0, 0, -drill_.length};
    const auto first = [&](double a, double b, double low) {
        return std::max(0, static_cast<int>(std::floor((std::min(a, b) - drill_.radius - low) / spacing_)) - 1);
    };
    const auto last = [&](double a, double b, double low, int size) {
        return std::min(size - 1, static_cast<int>(std::floor((std::max(a, b) + drill_.radius - low) / spacing_)) + 2);
    };
    // To the cone and to the cylinder behind it
    const double slant = std::sqrt(drill_.radius * drill_.radius + drill_.point_depth * drill_.point_depth);
    const double cone_r = drill_.point_depth / slant, cone_z = drill_.radius / slant;
    for (int k = first(tip.z, end.z, low_.z); k <= last(tip.z, end.z, low_.z, size_[2]); ++k)
        for (int j = first(tip.y, end.y, low_.y); j <= last(tip.y, end.y, low_.y, size_[1]); ++j)
            for (int i = first(tip.x, end.x, low_.x); i <= last(tip.x, end.x, low_.x, size_[0]); ++i) {
                const Vec3 p = tool_from_body * (low_ + spacing_ * Vec3{double(i), double(j), double(k)});
                const double r = std::sqrt(p.x * p.x + p.y * p.y);
                const double depth = std::min({-cone_r * r - cone_z * p.z, drill_.radius - r, p.z + drill_.length});
                double& sample = at(i, j, k);
                sample = std::max(sample, depth);
            }
}

}  // namespace kerf::bench
