// SPDX-License-Identifier: Apache-2.0
#include "run/view/radiograph_worker.h"

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <exception>
#include <utility>

#include "bone/radiograph/radiograph.h"

namespace kerf::run {

namespace {

/// Half the edge of the box around the target that a radiograph shows [m]. The beam is 49 mm to each side at the
/// target, and 57 mm at the end of the box.
constexpr double reach = 100e-3;
constexpr double field = 0.15;  ///< [m] of the detector: a six-inch image intensifier, magnified

Box in_common(const Box& a, const Box& b) {
    return {{std::max(a.low.x, b.low.x), std::max(a.low.y, b.low.y), std::max(a.low.z, b.low.z)},
            {std::min(a.high.x, b.high.x), std::min(a.high.y, b.high.y), std::min(a.high.z, b.high.z)}};
}

bool contains(const Box& a, const Box& b) {
    return a.low.x <= b.low.x && a.low.y <= b.low.y && a.low.z <= b.low.z && a.high.x >= b.high.x &&
           a.high.y >= b.high.y && a.high.z >= b.high.z;
}

bool same(const Pose& a, const Pose& b) {
    return a.position == b.position && a.rotation.w == b.rotation.w && a.rotation.x == b.rotation.x &&
           a.rotation.y == b.rotation.y && a.rotation.z == b.rotation.z;
}

bone::MetalShape metal(const ViewedMesh& mesh, const Pose& world_from_shape, double attenuation) {
    return {mesh.positions, mesh.triangles, world_from_shape, attenuation};
}

/// Returns the tool in hand and the implants in the scene.
std::vector<bone::MetalShape> metal_of(const ViewedScene& scene, const ViewedState& state) {
    std::vector<bone::MetalShape> shapes;
    if (state.is_tool_in_hand && state.tool < scene.tools.size()) {
        const ViewedTool& tool = scene.tools[state.tool];
        shapes.push_back(metal(tool.mesh, state.world_from_tool,
                               tool.is_implant ? bone::titanium_attenuation : bone::steel_attenuation));
    }
    for (std::size_t b = 0; b < state.body_count; ++b) {
        const ViewedBody& body = state.bodies[b];
        if (body.kind == ViewedBody::Kind::staying_part && body.shape < scene.tools.size())
            shapes.push_back(metal(scene.tools[body.shape].staying, body.world_from_body, bone::titanium_attenuation));
        if (body.kind == ViewedBody::Kind::implant && body.shape < scene.implants.size())
            shapes.push_back(metal(scene.implants[body.shape], body.world_from_body, bone::titanium_attenuation));
    }
    return shapes;
}

}  // namespace

BoneImage picture_of(const PresentBone& bone) {
    BoneImage picture;
    for (std::size_t b = 0; b < bone.count(); ++b) {
        const PresentPiece& piece = bone.piece(b);
        picture.pieces.push_back(piece.image != nullptr ? piece.image
                                                        : std::make_shared<const PieceImage>(PieceImage{
                                                              piece.bone, piece.cut, RemovedVolume(*piece.bone),
                                                              piece.recorded_as, piece.separated_from, CutHistory{}}));
    }
    return picture;
}

void RadiographWorker::make(Exposure exposure) {
    std::unique_lock lock(mutex_);
    is_changed_.wait(lock, [this] { return waiting_.size() < max_waiting; });
    waiting_.push_back(std::move(exposure));
    if (!thread_.joinable()) thread_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
    is_changed_.notify_all();
}

bool RadiographWorker::is_idle() const {
    const std::lock_guard lock(mutex_);
    return waiting_.empty() && !is_working_;
}

// ---- the worker's thread ------------------------------------------------------------------------------------------

void RadiographWorker::work(const std::stop_token& stop) {
    constexpr int niceness = 10;
    setpriority(PRIO_PROCESS, 0, niceness);  // of this thread
    while (true) {
        std::unique_lock lock(mutex_);
        if (!is_changed_.wait(lock, stop, [this] { return !waiting_.empty(); }) || stop.stop_requested()) return;
        Exposure exposure = std::move(waiting_.front());
        waiting_.pop_front();
        is_working_ = true;
        lock.unlock();
        is_changed_.notify_all();
        auto picture = std::make_shared<const ViewedRadiograph>(made(std::move(exposure)));
        lock.lock();
        is_working_ = false;
        lock.unlock();
        on_made_(std::move(picture));
    }
}

ViewedRadiograph RadiographWorker::made(Exposure exposure) {
    ViewedRadiograph picture = std::move(exposure.radiograph);
    try {
        follow_bone(exposure);
        bone::Radiograph taken = bone::radiograph(
            *image_, bone::beam(exposure.target, picture.about_head_axis, picture.tilt, {.width = field}),
            metal_of(*scene_, exposure.state), {.shot = static_cast<std::uint64_t>(std::max(0, picture.shot))});
        picture.columns = taken.columns;
        picture.rows = taken.rows;
        picture.grey = std::move(taken.grey);
        picture.error = std::move(taken.error);
    } catch (const std::exception& fault) {
        picture.error = fault.what();
        image_.reset();
    }
    return picture;
}

/// Updates the image of attenuation. It covers the bone around the target. It is made anew around a distant target, and
/// where bone has left its box.
void RadiographWorker::follow_bone(const Exposure& exposure) {
    std::vector<bone::BodyInImage> bodies(exposure.bone.pieces.size());
    for (std::size_t b = 0; b < bodies.size(); ++b) {
        const ViewedBody& body = exposure.state.bodies[std::min(b, max_viewed_bodies - 1)];
        bodies[b] = {body.world_from_body, b < exposure.state.body_count && body.kind == ViewedBody::Kind::bone};
    }
    fit_box(exposure, bodies);
    image_->update(exposure.bone, bodies);
}

void RadiographWorker::fit_box(const Exposure& exposure, const std::vector<bone::BodyInImage>& bodies) {
    constexpr double far_away = 25e-3, margin = 10e-3;  // [m]; the margin is for bone that will be moved
    const bool is_far = !image_ || length(exposure.target - centre_) > far_away;
    const bool is_same =
        std::equal(bodies.begin(), bodies.end(), boxed_.begin(), boxed_.end(), [](const auto& a, const auto& b) {
            return a.is_bone == b.is_bone && same(a.world_from_body, b.world_from_body);
        });
    if (!is_far && is_same) return;
    if (is_far) centre_ = exposure.target;
    boxed_ = bodies;
    Box bone = empty_box;
    for (std::size_t b = 0; b < bodies.size(); ++b)
        if (bodies[b].is_bone)
            bone = joined(bone, bone::bone_box(*exposure.bone.pieces[b]->bone, bodies[b].world_from_body));
    const Box around = grown(Box{centre_, centre_}, reach);
    if (!is_far && contains(box_, in_common(bone, around))) return;
    box_ = in_common(grown(bone, margin), around);
    image_ = bone::AttenuationImage::around(box_);
}

}  // namespace kerf::run
