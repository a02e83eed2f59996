// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <vector>

#include "bone/radiograph/attenuation_image.h"
#include "core/field/pieces/present_bone.h"
#include "run/view/viewed_run.h"

namespace kerf::run {

/// Returns a copy of the present bone for readers. It lacks volumes and histories, so it restores nothing; and unlike
/// `PresentBone::image`, it counts nothing, which could change the last bits of a later count.
/// [worker] the thread of `bone`
[[nodiscard]] BoneImage picture_of(const PresentBone& bone);

/// All that a radiograph shows. It does not change with the run.
struct Exposure {
    BoneImage bone{};
    ViewedState state{};            ///< poses and kinds of all bodies, and the tool in hand
    Vec3 target{};                  ///< world [m], on the axis of the beam
    ViewedRadiograph radiograph{};  ///< without pixels
};

/// Makes radiographs on a thread of its own, one after the other.
class RadiographWorker {
public:
    using OnMade = std::function<void(std::shared_ptr<const ViewedRadiograph>)>;
    /// Pre: `scene` outlives this object.
    /// @param on_made  called on the worker's thread
    RadiographWorker(const ViewedScene& scene, OnMade on_made) : scene_(&scene), on_made_(std::move(on_made)) {}
    /// Finishes the radiograph in work, and drops those that wait.
    ~RadiographWorker() = default;
    RadiographWorker(const RadiographWorker&) = delete;
    RadiographWorker& operator=(const RadiographWorker&) = delete;

    /// Takes an exposure to make. If four wait, it blocks until one is made.   [main]
    void make(Exposure exposure);
    /// Returns whether all radiographs are made.   [any]
    [[nodiscard]] bool is_idle() const;

private:
    void work(const std::stop_token& stop);
    [[nodiscard]] ViewedRadiograph made(Exposure exposure);
    void follow_bone(const Exposure& exposure);
    void fit_box(const Exposure& exposure, const std::vector<bone::BodyInImage>& bodies);

    static constexpr std::size_t max_waiting = 4;

    const ViewedScene* scene_;
    OnMade on_made_;

    // Of the worker's thread.
    std::optional<bone::AttenuationImage> image_;
    Vec3 centre_{};                         ///< target around which the box of the image was made
    Box box_ = empty_box;                   ///< of the image
    std::vector<bone::BodyInImage> boxed_;  ///< when the box was last compared with the bone

    mutable std::mutex mutex_;  ///< guards the members below
    std::condition_variable_any is_changed_;
    std::deque<Exposure> waiting_;
    bool is_working_ = false;
    std::jthread thread_;  ///< the last member: it ends first; starts with the first exposure
};

}  // namespace kerf::run
