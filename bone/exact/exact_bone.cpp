// SPDX-License-Identifier: Apache-2.0
#include "bone/exact/exact_bone.h"

#include <algorithm>

namespace kerf::bone {
namespace {

CutHistory common_of(const std::vector<ExactBody>& bodies) {
    CutHistory common = bodies.front().history;
    for (const ExactBody& one : bodies) common = common.common_with(one.history);
    return common;
}

/// Groups bodies that separated later: they have a longer common history than all bodies.
std::vector<std::vector<ExactBody>> parted_after(const CutHistory& common, const std::vector<ExactBody>& bodies) {
    std::vector<std::vector<ExactBody>> groups;
    for (const ExactBody& one : bodies) {
        const auto same = std::find_if(groups.begin(), groups.end(), [&](const std::vector<ExactBody>& group) {
            return group.front().history.common_with(one.history).count() > common.count();
        });
        if (same != groups.end())
            same->push_back(one);
        else
            groups.push_back({one});
    }
    return groups;
}

}  // namespace

ExactBone::ExactBone(const Body& bone, TaggedMesh uncut, const ExactTools& tools)
    : bone_(&bone), uncut_(std::move(uncut)), uncut_volume_(signed_volume_of(uncut_.mesh)), tools_(&tools) {}

std::unique_ptr<ExactTrack> ExactBone::new_track(const TaggedMesh& mesh, const CutHistory& done) const {
    return std::make_unique<ExactTrack>(mesh, done, *tools_, bone_->grid().spacing);
}

void ExactBone::follow(const std::vector<ExactBody>& bodies, bool may_return) {
    if (!follow_same_bodies(bodies) && !restore(bodies) && !separate(bodies)) {
        tracks_.clear();
        crumbs_ = records_ = stretches_ = 0;
        crumb_volume_ = 0.0;
        descend(new_track(uncut_, {}), bodies);
    }
    if (may_return) keep();
}

bool ExactBone::follow_same_bodies(const std::vector<ExactBody>& bodies) {
    if (bodies.size() != tracks_.size()) return false;
    std::vector<ExactTrack*> surfaces;
    for (const ExactBody& one : bodies) {
        const auto track =
            std::find_if(tracks_.begin(), tracks_.end(), [&](const Track& t) { return t.body == one.body; });
        if (track == tracks_.end() || !one.history.continues(track->surface->done())) return false;
        surfaces.push_back(track->surface.get());
    }
    for (std::size_t n = 0; n < bodies.size(); ++n) surfaces[n]->follow(bodies[n].history);
    return true;
}

bool ExactBone::restore(const std::vector<ExactBody>& bodies) {
    const auto is_now = [&](const Kept& kept) {
        return kept.tracks.size() == bodies.size() &&
               std::all_of(bodies.begin(), bodies.end(), [&](const ExactBody& one) {
                   return std::any_of(kept.tracks.begin(), kept.tracks.end(), [&](const auto& track) {
                       return track.first == one.body && track.second.done == one.history;
                   });
               });
    };
    const auto found = std::find_if(kept_.rbegin(), kept_.rend(), is_now);
    if (found == kept_.rend()) return false;
    std::vector<Track> tracks;
    for (const auto& [body, moment] : found->tracks) {
        const auto same = std::find_if(tracks_.begin(), tracks_.end(),
                                       [&, b = body](const Track& t) { return t.surface != nullptr && t.body == b; });
        tracks.push_back({body, same != tracks_.end() ? std::move(same->surface) : new_track(uncut_, {})});
        tracks.back().surface->restore(moment);
    }
    tracks_ = std::move(tracks);
    crumbs_ = found->crumbs;
    crumb_volume_ = found->crumb_volume;
    records_ = found->records;
    stretches_ = found->stretches;
    return true;
}

bool ExactBone::separate(const std::vector<ExactBody>& bodies) {
    std::vector<std::vector<ExactBody>> became(tracks_.size());
    for (const ExactBody& one : bodies) {
        const auto find = [&](std::size_t body) {
            return std::find_if(tracks_.begin(), tracks_.end(), [&](const Track& track) {
                return track.body == body && one.history.continues(track.surface->done());
            });
        };
        auto track = find(one.body);
        if (track == tracks_.end()) track = find(one.separated_from);
        if (track == tracks_.end()) return false;
        became[static_cast<std::size_t>(track - tracks_.begin())].push_back(one);
    }
    std::vector<Track> before = std::move(tracks_);
    tracks_.clear();
    for (std::size_t n = 0; n < before.size(); ++n)
        if (!became[n].empty()) descend(std::move(before[n].surface), became[n]);
    return true;
}

/// Follows the common history of bodies, divides the mesh among them, and continues with each. Parts that are separate
/// in the field may still be connected in the mesh. Then the body on which most of the part lies gets it.
void ExactBone::descend(std::unique_ptr<ExactTrack> track, const std::vector<ExactBody>& bodies) {
    if (bodies.size() == 1) {
        track->follow(bodies.front().history);
        tracks_.push_back({bodies.front().body, std::move(track)});
        return;
    }
    const CutHistory common = common_of(bodies);
    track->follow(common);
    track->finish();
    const std::vector<std::vector<ExactBody>> groups = parted_after(common, bodies);
    std::vector<TaggedMesh> meshes(groups.size());
    for (const MeshPart& part : parts_of(track->mesh())) {
        std::size_t nearest = 0;
        double largest = 0.0;
        bool is_in_the_field = false;
        for (std::size_t g = 0; g < groups.size(); ++g) {
            std::vector<const CutField*> cuts;
            for (const ExactBody& one : groups[g]) cuts.push_back(one.cut.get());
            const auto on = fraction_on(part, *bone_, cuts);
            is_in_the_field = is_in_the_field || on.has_value();
            if (on.value_or(0.0) <= largest) continue;
            largest = *on;
            nearest = g;
        }
        // A part beyond the field was never cut and belongs to the first body.
        if (largest > 0.0 || !is_in_the_field)
            append(part.mesh, meshes[nearest]);
        else
            add_crumb(part);
    }
    add_counts_of(*track);
    for (std::size_t g = 0; g < groups.size(); ++g) {
        auto child = new_track(meshes[g], common);
        for (const LocalCutting::Stale& stale : track->stale()) child->mark_stale(stale.box, stale.why);
        descend(std::move(child), groups[g]);
    }
}

std::vector<TaggedMesh> ExactBone::finish(const std::vector<ExactBody>& bodies) {
    follow(bodies, false);
    std::vector<TaggedMesh> meshes(bodies.size());
    std::vector<ReassignedPart> late;
    for (const Track& track : tracks_) {
        track.surface->finish();
        const auto own = static_cast<std::size_t>(
            std::find_if(bodies.begin(), bodies.end(), [&](const ExactBody& one) { return one.body == track.body; }) -
            bodies.begin());
        for (const MeshPart& part : parts_of(track.surface->mesh())) {
            if (lies_on(part, bodies[own])) {
                append(part.mesh, meshes[own]);
                continue;
            }
            const auto other =
                std::find_if(bodies.begin(), bodies.end(), [&](const ExactBody& one) { return lies_on(part, one); });
            if (other == bodies.end())
                add_crumb(part);
            else
                late.push_back({part.mesh, static_cast<std::size_t>(other - bodies.begin()),
                                other->history.common_with(track.surface->done())});
        }
    }
    for (const ReassignedPart& one : late) {
        const auto track = new_track(one.mesh, one.done);
        track->follow(bodies[one.body].history);
        track->finish();
        for (const MeshPart& part : parts_of(track->mesh()))
            if (lies_on(part, bodies[one.body]))
                append(part.mesh, meshes[one.body]);
            else
                add_crumb(part);
        add_counts_of(*track);
        stale_.insert(stale_.end(), track->stale().begin(), track->stale().end());
    }
    return meshes;
}

/// Returns whether most of a part lies on a body, or beyond the field.
bool ExactBone::lies_on(const MeshPart& part, const ExactBody& body) const {
    return fraction_on(part, *bone_, {body.cut.get()}).value_or(1.0) > 0.5;
}

std::vector<std::pair<std::size_t, LocalCutting::Moment>> ExactBone::shown() {
    std::vector<std::pair<std::size_t, LocalCutting::Moment>> all;
    for (const Track& track : tracks_) all.emplace_back(track.body, track.surface->shown());
    return all;
}

void ExactBone::add_counts_of(const ExactTrack& track) {
    records_ += track.records();
    stretches_ += track.stretches();
    refusals_ += track.refusals();
    handed_over_ += track.handed_over();
    const std::vector<std::string> notes = track.notes();
    notes_.insert(notes_.end(), notes.begin(), notes.end());
}

void ExactBone::add_crumb(const MeshPart& part) {
    ++crumbs_;
    crumb_volume_ += part.volume;
}

void ExactBone::keep() {
    Kept now{{}, crumbs_, records_, stretches_, crumb_volume_};
    for (const Track& track : tracks_) now.tracks.emplace_back(track.body, track.surface->moment());
    kept_.push_back(std::move(now));
    if (kept_.size() > max_kept) kept_.pop_front();
}

std::size_t ExactBone::records() const noexcept {
    std::size_t sum = records_;
    for (const Track& track : tracks_) sum += track.surface->records();
    return sum;
}

std::size_t ExactBone::stretches() const noexcept {
    std::size_t sum = stretches_;
    for (const Track& track : tracks_) sum += track.surface->stretches();
    return sum;
}

int ExactBone::refusals() const noexcept {
    int sum = refusals_;
    for (const Track& track : tracks_) sum += track.surface->refusals();
    return sum;
}

int ExactBone::handed_over() const noexcept {
    int sum = handed_over_;
    for (const Track& track : tracks_) sum += track.surface->handed_over();
    return sum;
}

std::vector<std::string> ExactBone::notes() const {
    std::vector<std::string> all = notes_;
    for (const Track& track : tracks_) {
        const std::vector<std::string> own = track.surface->notes();
        all.insert(all.end(), own.begin(), own.end());
    }
    return all;
}

std::vector<LocalCutting::Stale> ExactBone::stale() const {
    std::vector<LocalCutting::Stale> all = stale_;
    for (const Track& track : tracks_)
        all.insert(all.end(), track.surface->stale().begin(), track.surface->stale().end());
    return all;
}

}  // namespace kerf::bone
