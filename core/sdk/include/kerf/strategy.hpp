// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "kerf/plugin.hpp"
#include "kerf/remesh.h"
#include "kerf/remesh_mesh.hpp"

/// Remeshing strategies as plain structs, for KERF_PLUGIN:
///
///     struct Groove {
///         double tolerance;                                  // members are parameters
///         static constexpr auto about() {
///             return describe("groove", "One sentence.", remeshes_patches("library, version, flags"), param(…));
///         }
///         RemeshAnswer remesh(const RemeshJob&) const;       // may allocate and throw
///     };
///
/// `remesh` runs in a process of its own, one call at a time. It is a function of its job: the same job gives the same
/// answer. An exception that leaves it refuses the job, with its text as the reason.
namespace kerf {

/// One cut: the cutting part of a tool moves straight from one pose to another.
struct SweptTool {
    std::span<const kerf_profile_point> profile;  ///< (z, radius) [m] from the tip backwards, tool frame
    double kerf = 0.0;  ///< [m] thickness of a blade's cutting part; 0: the outline turns about z
    double bore = 0.0;  ///< [m] radius of a bore through the tool; 0: none
    Pose from{}, to{};  ///< body_from_tool
};

/// The task of a strategy: remove the volume that tools sweep from a mesh. A view of the request.
class RemeshJob {
public:
    RemeshJob(const kerf_remesh_in& in, const kerf_arena& arena) noexcept : in_(&in), arena_(&arena) {}

    /// Returns a copy of the mesh. A patch has a border, whose vertices are locked.
    [[nodiscard]] remeshing::Triangles mesh() const { return remeshing::read(in_->base, *arena_); }
    /// Returns one value per vertex: a vertex with 1 must be returned bit for bit. Empty: no vertex is locked.
    [[nodiscard]] std::span<const std::uint8_t> locked() const noexcept {
        return remeshing::array<std::uint8_t>(*arena_, in_->base.locked,
                                              in_->base.locked != 0 ? in_->base.vertex_count : 0);
    }
    /// Returns the cuts in chronological order. Throws std::out_of_range for a tool that does not exist.
    [[nodiscard]] std::vector<SweptTool> cuts() const {
        const auto solids = remeshing::array<kerf_cut_solid>(*arena_, in_->solids, in_->solid_count);
        std::vector<SweptTool> all;
        for (const kerf_cut& cut : remeshing::array<kerf_cut>(*arena_, in_->cuts, in_->cut_count)) {
            if (cut.solid >= solids.size()) throw std::out_of_range("a cut has a tool that does not exist");
            const kerf_cut_solid& solid = solids[cut.solid];
            all.push_back({remeshing::array<kerf_profile_point>(*arena_, solid.profile, solid.profile_count),
                           solid.kerf, solid.bore, cut.from, cut.to});
        }
        return all;
    }
    /// Returns the permitted deviation of new faces [m].
    [[nodiscard]] double tolerance() const noexcept { return in_->tolerance; }
    /// Returns 0 for the first attempt, and another number after the host has refused an answer. Use it to vary the
    /// cut.
    [[nodiscard]] std::uint64_t seed() const noexcept { return in_->nudge_seed; }
    [[nodiscard]] std::uint32_t mode() const noexcept { return in_->mode; }  ///< KERF_REMESH_PROVISIONAL …
    /// Returns whether the host no longer waits: then return RemeshAnswer::cancelled() soon.
    [[nodiscard]] bool is_cancelled() const noexcept {
        return in_->cancel != 0 && *reinterpret_cast<const volatile std::uint32_t*>(arena_->base + in_->cancel) != 0;
    }
    /// Returns `is_cancelled` as a function, valid as long as the job.
    [[nodiscard]] remeshing::Cancelled cancelled() const {
        return [this] { return is_cancelled(); };
    }

private:
    const kerf_remesh_in* in_;
    const kerf_arena* arena_;
};

/// The result of a strategy.
class RemeshAnswer {
public:
    /// Returns the mesh after the cut. Faces that stay keep their tags; new ones get KERF_FACE_WALL.
    static RemeshAnswer cut(remeshing::Triangles mesh) { return {KERF_OK, {}, std::move(mesh)}; }
    /// Reports that the cuts meet none of the faces.
    static RemeshAnswer unchanged() { return {KERF_REMESH_UNCHANGED, {}, {}}; }
    /// Reports that this strategy does not make such a cut. The host then tries the next strategy.
    static RemeshAnswer declined(std::string why) { return {KERF_REMESH_DECLINED, std::move(why), {}}; }
    /// Reports that this job cannot be done; another seed may help.
    static RemeshAnswer refused(std::string why) { return {KERF_REMESH_REFUSED, std::move(why), {}}; }
    static RemeshAnswer cancelled() { return {KERF_REMESH_CANCELLED, {}, {}}; }
    /// Returns the answer for an outcome. `mesh` is used for a cut only, `why` if it is declined or refused.
    static RemeshAnswer of(remeshing::Outcome outcome, remeshing::Triangles mesh, std::string why) {
        switch (outcome) {
            case remeshing::Outcome::cut:
                return cut(std::move(mesh));
            case remeshing::Outcome::unchanged:
                return unchanged();
            case remeshing::Outcome::declined:
                return declined(std::move(why));
            case remeshing::Outcome::cancelled:
                return cancelled();
            case remeshing::Outcome::refused:
                break;
        }
        return refused(std::move(why));
    }

    /// Writes the mesh to the arena and the message to `out`. Returns the status for the host: a refusal if the arena
    /// is too small.
    [[nodiscard]] kerf_status write(kerf_arena& to, kerf_remesh_out& out) const {
        if (status_ == KERF_OK && !remeshing::write(mesh_, to, out.result))
            return remeshing::refuse(KERF_REMESH_REFUSED, out, "the arena is too small for the result");
        return status_ == KERF_OK ? KERF_OK : remeshing::refuse(status_, out, why_);
    }

private:
    RemeshAnswer(kerf_status status, std::string why, remeshing::Triangles mesh)
        : status_(status), why_(std::move(why)), mesh_(std::move(mesh)) {}
    kerf_status status_;
    std::string why_;
    remeshing::Triangles mesh_;
};

template <class T>
concept StrategyComponent = requires(const T& strategy, const RemeshJob& job) {
    T::about();
    { strategy.remesh(job) } -> std::same_as<RemeshAnswer>;
};

/// States that a strategy gets the faces near the cuts, and the library, version and flags on which its results depend.
[[nodiscard]] constexpr Remeshes remeshes_patches(const char* kernel) noexcept { return {KERF_REMESH_PATCH, kernel}; }
/// States that a strategy gets the whole mesh, and the library, version and flags on which its results depend.
[[nodiscard]] constexpr Remeshes remeshes_whole(const char* kernel) noexcept { return {KERF_REMESH_WHOLE, kernel}; }

/// Describes the parameter `tolerance`, which RemeshJob::tolerance() returns: 1 µm to 1 mm, 20 µm by default.
template <class Strategy>
[[nodiscard]] constexpr Param<Strategy> remesh_tolerance(double Strategy::*member, const char* help,
                                                         const char* source) {
    using namespace literals;
    return param(member, {.id = "tolerance",
                          .help = help,
                          .unit = unit::um,
                          .min = 1.0_um,
                          .max = 1.0_mm,
                          .def = 20.0_um,
                          .source = source});
}

namespace detail {

template <StrategyComponent Strategy>
struct ComponentTable<Strategy> {
    static kerf_status remesh(const kerf_remesh_in* in, const kerf_arena* from, kerf_arena* to, kerf_remesh_out* out,
                              void* /*cache*/) noexcept {
        try {
            const auto params = remeshing::array<double>(*from, in->params, in->param_count);
            return value_of<Strategy>(params).remesh(RemeshJob(*in, *from)).write(*to, *out);
        } catch (const std::exception& e) {
            return remeshing::refuse(KERF_REMESH_REFUSED, *out, e.what());
        } catch (...) {
            return remeshing::refuse(KERF_REMESH_REFUSED, *out, "it threw an object that is not a std::exception");
        }
    }
    static constexpr Remeshes how = find_item<Strategy>(Remeshes{});
    static_assert(how.scope != 0, "a strategy states remeshes_patches(…) or remeshes_whole(…) in its about()");

    static constexpr std::uint32_t kind = KERF_KIND_REMESHER, version = KERF_REMESHER_VERSION;
    static constexpr kerf_remesher table{.size = sizeof(kerf_remesher),
                                         .scope = how.scope,
                                         .layout = KERF_REMESH_LAYOUT_INIT,
                                         .reserved = 0,
                                         .kernel = how.kernel,
                                         .remesh = &remesh,
                                         .cache_new = nullptr,
                                         .cache_drop = nullptr};
    static constexpr void put_into(kerf_component& component) noexcept { component.remesher = &table; }
};

}  // namespace detail

}  // namespace kerf
