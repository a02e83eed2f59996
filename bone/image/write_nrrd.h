// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "bone/image/voxel_image.h"

namespace kerf {

/// A volume as .nrrd: LPS, millimetres, compressed, slab by slab, so that it never lies in memory twice. Readers see
/// the old file or the whole new one. It holds the voxels and where they are, and nothing of whose they are.
class NrrdWriter {
public:
    /// `remark`: one line of comment. `as_short`: values are whole and fit into 16 bits; else they are floats.
    NrrdWriter(std::string path, const VoxelGrid& grid, const std::string& remark, bool as_short);
    ~NrrdWriter();
    NrrdWriter(const NrrdWriter&) = delete;
    NrrdWriter& operator=(const NrrdWriter&) = delete;

    /// The next voxels, i fastest.
    void add(std::span<const float> values);

    /// Puts the file in its place. Returns why not, for people; empty if all went well.   [main]
    [[nodiscard]] std::string finish();

private:
    struct Stream;
    void pack(const void* bytes, std::size_t count, bool is_last);

    std::string path_, error_;
    bool as_short_;
    std::size_t left_;  ///< voxels that must still come
    std::unique_ptr<Stream> stream_;
};

}  // namespace kerf
