// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "bench/plain_papers.h"

/// A dense grid of distances from which the tool is taken analytically: the other way to be measured against.
namespace kerf::bench {

/// Asked and cut as our own bone is, but with one array for everything: engagement from the interpolated distance for
/// each cutting element, distance and normal for each point on the shank, and every tick each sample of the tool's
/// bounding box is raised to its depth in the tool. One point and one sample after the other, in double; nothing is
/// left out.
class DenseField {
public:
    DenseField(Vec3 low, Vec3 high, double spacing, const PlainPapers::Drill& drill);

    /// Sum of the elements' engagement.
    [[nodiscard]] double cutting(const Pose& body_from_tool, const std::vector<Vec3>& elements) const;
    /// Sum of the points' distances along their normals.
    [[nodiscard]] Vec3 contact(const Pose& body_from_tool, const std::vector<Vec3>& points) const;
    void remove(const Pose& body_from_tool);

private:
    struct Answer {
        double distance;
        Vec3 gradient;
    };
    [[nodiscard]] double& at(int i, int j, int k) {
        return samples_[(static_cast<std::size_t>(k) * static_cast<std::size_t>(size_[1]) +
                         static_cast<std::size_t>(j)) *
                            static_cast<std::size_t>(size_[0]) +
                        static_cast<std::size_t>(i)];
    }
    [[nodiscard]] double value(int i, int j, int k) const { return const_cast<DenseField*>(this)->at(i, j, k); }
    [[nodiscard]] Answer interpolate(Vec3 p) const;

    Vec3 low_;
    double spacing_;
    int size_[3];
    PlainPapers::Drill drill_;
    std::vector<double> samples_;
};

}  // namespace kerf::bench
