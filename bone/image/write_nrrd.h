// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "bone/image/voxel_image.h"

namespace kerf::bone {

/// Writes a volume as .nrrd: LPS, millimetres, compressed, slab by slab, so that memory never has it twice. Readers see
/// the old file or the whole new one. The file has voxels and their position, and nothing that identifies the patient.
class NrrdWriter {
public:
    /// `remark`: one line of comment. `as_short`: values are whole and fit into 16 bits; otherwise they are floats.
    NrrdWriter(std::string path, const VoxelGrid& grid, const std::string& remark, bool as_short);
    ~NrrdWriter();
    NrrdWriter(const NrrdWriter&) = delete;
    NrrdWriter& operator=(const NrrdWriter&) = delete;

    /// Writes the next voxels, i fastest.
    void add(std::span<const float> values);

    /// Moves the finished file to its path. Returns the error for people; empty on success.   [main]
    [[nodiscard]] std::string finish();

private:
    struct Stream;
    void pack(const void* bytes, std::size_t count, bool is_last);

    std::string path_, error_;
    bool as_short_;
    std::size_t left_;  ///< voxels not yet written
    std::unique_ptr<Stream> stream_;
};

}  // namespace kerf::bone
