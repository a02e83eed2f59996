// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

/// VTK's FlyingEdges3D on one thread, in a unit of its own: VTK 9.1's headers are no C++20.
class FlyingEdges {
public:
    /// Samples x fastest; spacing and origin [m].
    FlyingEdges(std::array<int, 3> size, double spacing, std::array<double, 3> origin,
                const std::vector<float>& samples);
    ~FlyingEdges();

    /// The surface where the samples are zero, with normals. How many triangles it has.
    std::size_t mesh() const;

private:
    struct Image;
    std::unique_ptr<Image> image_;
};
