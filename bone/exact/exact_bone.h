// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bone/exact/exact_track.h"
#include "bone/exact/mesh_parts.h"

namespace kerf::bone {

/// A body of a bone in the field.
struct ExactBody {
    std::size_t body = 0;            ///< number in the scene
    std::size_t separated_from = 0;  ///< the body that it was part of before
    const Body* bone = nullptr;
    bool is_present = true;  ///< false: removed from the scene, without a surface
    CutHistory history{};
    std::shared_ptr<const CutField> cut{};  ///< null: not needed, the bodies are the same as before
};

/// The exact surfaces of all bodies of one bone. The field decides which bodies exist. If it separates, so does the
/// mesh.   [worker]
class ExactBone {
public:
    /// @param uncut  surface of the bone before the first record
    ExactBone(const Body& bone, TaggedMesh uncut, const ExactTools& tools);

    /// Follows the bodies to their present state: forwards along their histories, through separations, or back to an
    /// earlier state. Pre: all of the bone's bodies, by number; with their cuts, unless the bodies are the same as in
    /// the last call and no history went back.
    /// @param may_return  bone may return to this state
    void follow(const std::vector<ExactBody>& bodies, bool may_return);
    /// Follows the bodies, cuts waiting records, and returns the surface of each body, in the order of `bodies`. Each
    /// part of the mesh is assigned to the body on which it lies. Pre: with their cuts.
    [[nodiscard]] std::vector<TaggedMesh> finish(const std::vector<ExactBody>& bodies);

    /// Returns the surfaces by body, with waiting records cut into them.
    [[nodiscard]] std::vector<std::pair<std::size_t, LocalCutting::Moment>> shown();

    [[nodiscard]] double uncut_volume() const noexcept { return uncut_volume_; }  ///< [m³]
    /// Returns the number of parts of the mesh without a body in the field.
    [[nodiscard]] std::size_t crumbs() const noexcept { return crumbs_; }
    [[nodiscard]] double crumb_volume() const noexcept { return crumb_volume_; }  ///< [m³]
    [[nodiscard]] std::size_t records() const noexcept;
    [[nodiscard]] std::size_t stretches() const noexcept;
    [[nodiscard]] int refusals() const noexcept;
    [[nodiscard]] int handed_over() const noexcept;
    /// Returns the boxes in which the surfaces lack cuts.
    [[nodiscard]] std::vector<LocalCutting::Stale> stale() const;
    /// Returns the refused attempts, for people.
    [[nodiscard]] std::vector<std::string> notes() const;

private:
    static constexpr std::size_t max_kept = 40;  ///< states that bone may return to

    struct Track {
        std::size_t body;
        std::unique_ptr<ExactTrack> surface;
    };
    struct Kept {
        std::vector<std::pair<std::size_t, ExactTrack::Moment>> tracks;
        std::size_t crumbs, records, stretches;
        double crumb_volume;
    };
    /// A part of another body: it lacks the records of that body after `done`.
    struct ReassignedPart {
        TaggedMesh mesh;
        std::size_t body;  ///< number among the bodies
        CutHistory done;
    };

    [[nodiscard]] bool follow_same_bodies(const std::vector<ExactBody>& bodies);
    [[nodiscard]] bool restore(const std::vector<ExactBody>& bodies);
    [[nodiscard]] bool separate(const std::vector<ExactBody>& bodies);
    void descend(std::unique_ptr<ExactTrack> track, const std::vector<ExactBody>& bodies);
    void add_counts_of(const ExactTrack& track);
    [[nodiscard]] std::unique_ptr<ExactTrack> new_track(const TaggedMesh& mesh, const CutHistory& done) const;
    [[nodiscard]] bool lies_on(const MeshPart& part, const ExactBody& body) const;
    void add_crumb(const MeshPart& part);
    void keep();

    const Body* bone_;
    TaggedMesh uncut_;
    double uncut_volume_;
    const ExactTools* tools_;
    std::vector<Track> tracks_;
    std::deque<Kept> kept_;
    // Of separated tracks, and of parts without a body.
    std::size_t crumbs_ = 0, records_ = 0, stretches_ = 0;
    double crumb_volume_ = 0.0;
    int refusals_ = 0, handed_over_ = 0;
    std::vector<LocalCutting::Stale> stale_;
    std::vector<std::string> notes_;
};

}  // namespace kerf::bone
