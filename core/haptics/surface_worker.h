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

#include "core/field/patch_table.h"
#include "core/field/spsc_ring.h"
#include "core/haptics/simulation.h"

/// The thread beside the loop.
namespace kerf {

/// Stamps the loop's records into bone of its own, without lag; finds what has come apart and makes bodies of it; keeps
/// what was before each cut; makes the surface anew where it changed. It shares no voxel with the loop: records go
/// there, and finished bodies come back whole.
///
/// The loop's bits do not depend on when it does so, but for the ticks at which a separation is adopted or a cut is
/// taken back: those are inputs, and are recorded. In lock-step `Simulation` does the same with the same classes.
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
    SurfaceWorker(const Body& body, std::vector<const ToolSolid*> cutting, Options options);
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
    /// before `delay` ticks have passed. A simulation has one worker.   [haptic, nonblocking]
    TakenOver exchange(Simulation& simulation, std::uint64_t delay = Simulation::adoption_delay) noexcept;
    /// Undo or redo, as soon as it is made: an `exchange` will say so. False while another is under way.   [haptic,
    /// nonblocking]
    bool ask(Turn turn) noexcept;
    /// What came apart, if it is made by now.   [haptic, nonblocking]
    [[nodiscard]] const Adoption* offered() const noexcept {
        return offer_.is_out(restorations_) ? &offer_.made : nullptr;
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
        enum class Kind { cut, placed, clear_of_bone, undo, redo, adopted, restored, dropped } kind;
        CutRecord record{};       ///< of `restored`: only from which number on records are numbered
        std::uint16_t count = 0;  ///< of bodies
        Placing placing{};        ///< of the record's body
    };
    /// Something made for the loop. It is the loop's from when it is out until it is answered.
    template <class Made>
    struct Offer {
        enum State : std::uint64_t { none, out, taken, refused };
        Made made;
        /// What was made before the loop took over a restoration is void; the count of these is in the state, so that
        /// the loop need not look at what the worker may be making anew.
        std::atomic<std::uint64_t> state{none};

        void set(State now, std::uint64_t restorations) noexcept {
            state.store(restorations << 2 | now, std::memory_order_release);
        }
        [[nodiscard]] bool is(State asked) const noexcept {
            return (state.load(std::memory_order_acquire) & 3) == asked;
        }
        [[nodiscard]] bool is_out(std::uint64_t restorations) const noexcept {
            return state.load(std::memory_order_acquire) == (restorations << 2 | out);
        }
    };

    bool send(const Message& message) noexcept;
    void tell_cuts(const Simulation& simulation) noexcept;
    void tell_placings(const Simulation& simulation) noexcept;
    void take_restoration(Simulation& simulation, TakenOver& taken) noexcept;

    void work();
    [[nodiscard]] std::uint64_t take_all();
    void take(const Message& message);
    void make_offer();
    void make_restoration(Turn turn);
    void make_surface();

    // The loop's own.
    Placings told_;  ///< where the worker knows the bodies to be
    bool is_told_clear_ = true;
    std::optional<Turn> asked_;  ///< to be told
    bool is_asked_ = false;      ///< the worker knows
    std::uint64_t restorations_ = 0;

    // The worker's own.
    Options options_;
    PresentScene scene_;
    Placings placings_;
    std::vector<SurfacePatches> patches_;  ///< of each body
    std::vector<std::uint64_t> next_;      ///< of each body: its first record not yet seen
    std::uint64_t records_ = 0, restored_ = 0;

    Offer<Adoption> offer_;
    Offer<Restoration> restoration_;
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
