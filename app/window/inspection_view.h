// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "app/window/mesh_section.h"
#include "app/window/projection.h"
#include "app/window/slice_picture.h"
#include "app/window/theme.h"
#include "run/view/viewed_run.h"

namespace kerf::window {

/// The parts of an inspection that are shown.
struct InspectionLayers {
    bool contacts = false, field = false, coupling = false;

    [[nodiscard]] bool is_any() const noexcept { return contacts || field || coupling; }
};

inline constexpr InspectionLayers all_layers{true, true, true};

/// Returns the layers that follow these when the key is pressed: all, then each alone, then none.   [any] pure
[[nodiscard]] InspectionLayers next_layers(const InspectionLayers& layers);

/// Returns the force of which an arrow of full length is [N]: 10, 20, 50, 100 … N, at least the largest force.
[[nodiscard]] double full_arrow(const run::ViewedInspection& inspection);

/// Paints an inspection over the picture: samples and forces of the law, slices of the bone, the coupling. Pre of all
/// functions: a context of OpenGL 3.3 is current.
class InspectionView {
public:
    /// Pre: `scene` outlives this object.
    explicit InspectionView(const run::ViewedScene& scene) : scene_(&scene) {}

    /// Paints the layers over the picture between two corners [pixels]. Without an inspection it paints a sentence.
    void paint(const std::shared_ptr<const run::ViewedInspection>& inspection, const InspectionLayers& layers,
               const Projection& projection, ImVec2 low, ImVec2 high, const Fonts& fonts, ImDrawList& list);

private:
    struct Slice {
        SliceTexture texture;
        std::vector<SectionLine> section;  ///< of the tool
        std::size_t tool = ~std::size_t{0};
    };
    void show_section(const run::ViewedInspection& inspection, const run::ViewedSlice& shown, Slice& slice) const;
    void paint_slice(const run::ViewedInspection& inspection, const std::shared_ptr<const run::ViewedSlice>& shown,
                     Slice& slice, const std::string& words, ImVec2 low, float edge, const Fonts& fonts,
                     ImDrawList& list) const;
    void paint_slices(const run::ViewedInspection& inspection, ImVec2 low, ImVec2 high, const Fonts& fonts,
                      ImDrawList& list);

    const run::ViewedScene* scene_;
    Slice along_, across_;
};

/// Colours of the kinds of channels and samples.
namespace inspection_theme {
inline constexpr ImU32 cut = IM_COL32(0xf5, 0x8f, 0x3d, 255), contact = IM_COL32(0x4c, 0xc9, 0xf0, 255),
                       friction = IM_COL32(0xc7, 0x9b, 0xf2, 255), hold = IM_COL32(0x8f, 0xd1, 0x4f, 255),
                       wall = IM_COL32(0xf0, 0x6a, 0x5a, 255), free = IM_COL32(0xc4, 0xcc, 0xd4, 150),
                       spring = IM_COL32(0xf2, 0xe0, 0x5c, 255);
}  // namespace inspection_theme
[[nodiscard]] ImU32 colour_of(const run::ViewedChannel& channel);

}  // namespace kerf::window
