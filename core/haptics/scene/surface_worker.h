// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "core/field/spsc_ring.h"
#include "core/field/surface/patch_table.h"
#include "core/haptics/loop/haptic_loop.h"
#include "core/haptics/scene/bone_scene.h"

/// The thread beside the loop.
namespace kerf {

/// Stamps the loop's records into bone of its own, without lag; finds what has come apart and makes bodies of it; keeps
/// what was before each cut; makes the surface anew where it changed. It shares no voxel with the loop: records go
/// there, and finished bodies come back whole.
///
/// The loop's bits do not depend on when it does so, but for the ticks at which a separation is adopted or a cut is
/// taken back: those are inputs, and are recorded. In lock-step `Simulation` does the same with the same `BoneScene`.
class SurfaceWorker {
public:
    /// What a viewer draws: who holds it may read it on any thread for as long as he likes.
    struct Surface {
        std::uint64_t version = 0;
        std::vector<PatchTable> patches;  ///< of each body
    };
    struct Options {
        double crumb = 0.0;  ///< [m³] smaller pieces are no bodies
        bool looks_for_pieces = true, makes_surface = true;
    };

    /// `body` and the cutting solids, as records number them, must outlive it.   [main]
    SurfaceWorker(const Body& body, std::vector<const ToolSolid*> cutting, Options options, Belongings belongings = {});
    ~SurfaceWorker();
    SurfaceWorker(const SurfaceWorker&) = delete;
    SurfaceWorker& operator=(const SurfaceWorker&) = delete;

    /// What the loop took over from the worker.
    struct TakenOver {
        bool separation = false;
        std::optional<Turn> turn;          ///< a cut was taken back, or done again
        std::optional<Turn> refused_turn;  ///< there is none, or the tool touches bone or has cut since `ask`
    };
    /// Follows every tick: hands over what the loop has cut, and takes over what the worker has made, a separation not
    /// before `delay` ticks have passed. A loop has one worker.   [haptic, nonblocking]
    TakenOver exchange(HapticLoop& loop, std::uint64_t delay = HapticLoop::adoption_delay) noexcept;
    /// The body that each zone and step belongs to after the last `exchange`.   [haptic, nonblocking]
    [[nodiscard]] const Owners& owners() const noexcept { return owners_; }
    /// Undo or redo, as soon as it is made: an `exchange` will say so. False while another is under way.   [haptic,
    /// nonblocking]
    bool ask(Turn turn) noexcept;
    /// What came apart, if it is made by now.   [haptic, nonblocking]
    [[nodiscard]] const Offer* offered() const noexcept {
        return separation_.is_out(turns_) ? &separation_.offer : nullptr;
    }

    /// A record that removes bone; `exchange` does it. False when the queue is full: it is lost, and what the worker
    /// knows is no longer true.   [haptic, nonblocking] one thread only
    bool push(const CutRecord& record) noexcept;

    /// Until everything pushed is done and in the surface, and an offer that is due has been made.   [not the loop's
    /// thread on the clock; may block]
    void wait_for_all();
    /// The newest surface; while bone is cut there is a new one sixty times a second.   [any, but not the loop: it may
    /// wait for the worker to hand it out]
    [[nodiscard]] std::shared_ptr<const Surface> surface() const;
    /// The bone as the worker has it. Only after `wait_for_all`, and before anything else is handed over.   [main]
    [[nodiscard]] PresentBone& bone() noexcept { return scene_.bone(); }
    [[nodiscard]] std::uint64_t lost() const noexcept { return lost_.load(std::memory_order_relaxed); }

private:
    struct Message {
        enum class Kind { cut, placed, clear_of_bone, undo, redo, parted, turned, dropped } kind;
        CutRecord record{};       ///< of `turned`: only from which number on records are numbered
        std::uint16_t count = 0;  ///< of bodies
        Placing placing{};        ///< of the record's body
    };
    /// An offer, which is the loop's from when it is out until it is answered.
    struct Slot {
        enum State : std::uint64_t { none, out, taken, refused };
        Offer offer;
        /// Offers made before the loop took a turn over are void; the count of turns is in the state, so that the loop
        /// need not look at what the worker may be making anew.
        std::atomic<std::uint64_t> state{none};

        void set(State now, std::uint64_t turns) noexcept { state.store(turns << 2 | now, std::memory_order_release); }
        [[nodiscard]] bool is(State asked) const noexcept {
            return (state.load(std::memory_order_acquire) & 3) == asked;
        }
        [[nodiscard]] bool is_out(std::uint64_t turns) const noexcept {
            return state.load(std::memory_order_acquire) == (turns << 2 | out);
        }
    };

    bool send(const Message& message) noexcept;
    void tell_cuts(const HapticLoop& loop) noexcept;
    void tell_placings(const HapticLoop& loop) noexcept;
    [[nodiscard]] bool take(Slot& slot, HapticLoop& loop) noexcept;
    void take_turn(HapticLoop& loop, TakenOver& taken) noexcept;

    void work();
    [[nodiscard]] std::uint64_t take_all();
    void take(const Message& message);
    void offer_separation();
    void withdraw_separation();
    void offer_turn(Turn turn);
    void withdraw_turn();
    void make_surface();

    // The loop's own.
    Placings told_;                 ///< where the worker knows the bodies to be
    std::size_t told_records_ = 0;  ///< of those that the loop has closed in this tick
    bool is_told_clear_ = true;
    std::optional<Turn> asked_;  ///< to be told
    Turn sent_turn_ = Turn::undo;
    bool is_asked_ = false;  ///< the worker knows of it
    std::uint64_t turns_ = 0;
    Owners owners_;

    // The worker's own.
    Options options_;
    BoneScene scene_;
    Placings placings_;
    std::vector<SurfacePatches> patches_;  ///< of each body
    std::uint64_t turned_ = 0;

    Slot separation_, turn_;
    SpscRing<Message> queue_;
    std::atomic<std::uint64_t> lost_{0}, pushed_{0}, done_{0};
    mutable std::mutex mutex_;  ///< of what follows; the loop never takes it
    std::condition_variable wake_, idle_;
    std::shared_ptr<const Surface> surface_;
    bool is_surface_old_ = false;  ///< something was done since it was made; only the worker sets it
    int waiting_for_all_ = 0;      ///< threads that do
    bool is_stopping_ = false;
    std::thread thread_;
};

}  // namespace kerf
