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
#include "core/field/surface/surface_patches.h"
#include "core/haptics/loop/haptic_loop.h"
#include "core/haptics/scene/bone_scene.h"

/// The worker thread of a scene.
namespace kerf {

/// Follows the loop on another thread. It stamps the loop's records into the present bone, finds separated pieces and
/// makes bodies of them, stores undo steps, and updates the surface where it changed. Loop and worker have no voxel in
/// common: the loop sends records, and the worker returns complete bodies.
///
/// The worker's timing changes only the ticks at which a separation, an undo or a redo is taken over. Those ticks are
/// recorded as inputs, so a replay has the same bits. In lock-step, `Simulation` does the same with a `BoneScene`.
class SurfaceWorker {
public:
    /// A surface for a viewer. A published one never changes, so any thread may read it.
    struct Surface {
        std::uint64_t version = 0;
        std::vector<PatchTable> patches;  ///< for each body
    };
    struct Options {
        double crumb = 0.0;  ///< [m³] smaller pieces do not become bodies
        bool finds_pieces = true, makes_surface = true;
    };

    /// Starts the thread. `cutting` has the solids at the numbers that records name. Pre: `body` and the solids outlive
    /// this worker.   [main]
    SurfaceWorker(const Body& body, std::vector<const ToolSolid*> cutting, Options options,
                  BodyOwnership belongings = {});
    ~SurfaceWorker();
    SurfaceWorker(const SurfaceWorker&) = delete;
    SurfaceWorker& operator=(const SurfaceWorker&) = delete;

    /// What the loop took over from the worker in one `exchange`.
    struct TakenOver {
        bool separation = false;            ///< a separation was taken over
        std::optional<HistoryChange> turn;  ///< the undo or redo that was taken over
        /// A requested undo or redo that was impossible: no step is left, or the tool is not clear of bone or has cut
        /// since the request.
        std::optional<HistoryChange> refused_change;
    };
    /// Sends the loop's records of a tick to the worker, and lets the loop take over the worker's offers. To be called
    /// after each tick. A separation is taken over at least `delay` ticks after its record. A loop has one worker.
    /// [haptic, nonblocking]
    TakenOver exchange(HapticLoop& loop, std::uint64_t delay = HapticLoop::adoption_delay) noexcept;
    /// Returns the owners of zones and steps after the last `exchange`.   [haptic, nonblocking]
    [[nodiscard]] const Owners& owners() const noexcept { return owners_; }
    /// Requests an undo or redo. A later `exchange` returns the result. Returns false while another request is pending.
    /// [haptic, nonblocking]
    bool request(HistoryChange turn) noexcept;
    /// Returns the offer of a separation that the loop may take over, or null if none is ready.   [haptic, nonblocking]
    [[nodiscard]] const Offer* offered() const noexcept {
        return separation_.is_out(turns_) ? &separation_.offer : nullptr;
    }

    /// Sends a record that removes bone; `exchange` calls this. Returns false if the queue is full: the record is lost,
    /// and the worker's bone is wrong from then on.   [haptic, nonblocking] one thread only
    bool push(const CutRecord& record) noexcept;

    /// Waits until all records sent are applied and in the surface, and refused separations are offered again.
    /// [blocks; not on the thread of a loop on the clock]
    void wait_for_all();
    /// Returns the newest surface. During a cut there is a new one about sixty times a second.
    /// [any thread except the loop's: it may wait for the worker]
    [[nodiscard]] std::shared_ptr<const Surface> surface() const;
    /// Returns the worker's bone. Pre: `wait_for_all` has returned, and no record was sent since.   [main]
    [[nodiscard]] PresentBone& bone() noexcept { return scene_.bone(); }
    [[nodiscard]] std::uint64_t lost() const noexcept { return lost_.load(std::memory_order_relaxed); }

private:
    struct Message {
        enum class Kind { cut, body_changed, clear_of_bone, undo, redo, parted, turned, dropped } kind;
        CutRecord record{};       ///< `cut`; `turned`: `sequence` is the next number; `body_changed`: only `body`
        std::uint16_t count = 0;  ///< `body_changed`: number of bodies
        BodyState body_state{};   ///< `body_changed`: state of body `record.body`
    };
    /// An offer and its state. In state `out` only the loop may use the offer, in the other states only the worker.
    struct Slot {
        enum State : std::uint64_t { none, out, taken, refused };
        Offer offer;
        /// A state, and above it the number of undos and redos taken over when the offer was made. An offer with
        /// another number than the loop's is outdated: the worker may be rewriting it, so the loop does not read it.
        std::atomic<std::uint64_t> state{none};

        void set(State now, std::uint64_t turns) noexcept { state.store(turns << 2 | now, std::memory_order_release); }
        [[nodiscard]] bool is(State expected) const noexcept {
            return (state.load(std::memory_order_acquire) & 3) == expected;
        }
        [[nodiscard]] bool is_out(std::uint64_t turns) const noexcept {
            return state.load(std::memory_order_acquire) == (turns << 2 | out);
        }
    };

    bool send(const Message& message) noexcept;
    void send_cuts(const HapticLoop& loop) noexcept;
    void send_body_states(const HapticLoop& loop) noexcept;
    [[nodiscard]] bool take(Slot& slot, HapticLoop& loop) noexcept;
    void take_turn(HapticLoop& loop, TakenOver& taken) noexcept;

    void work();
    [[nodiscard]] std::uint64_t take_all();
    void take(const Message& message);
    void offer_separation();
    void withdraw_separation();
    void offer_turn(HistoryChange turn);
    void withdraw_turn();
    void make_surface();

    // Members used by the loop's thread.
    BodyStates sent_states_;        ///< states last sent to the worker
    std::size_t sent_records_ = 0;  ///< number of records of `closed` in this tick that were examined and sent
    bool is_clear_sent_ = true;
    std::optional<HistoryChange> requested_;  ///< requested, not yet sent
    HistoryChange sent_turn_ = HistoryChange::undo;
    bool is_request_pending_ = false;  ///< sent to the worker, not yet answered
    std::uint64_t turns_ = 0;
    Owners owners_;

    // Members used by the worker's thread.
    Options options_;
    BoneScene scene_;
    BodyStates body_states_;
    std::vector<SurfacePatches> patches_;  ///< for each body
    std::uint64_t turned_ = 0;

    Slot separation_, turn_;
    SpscRing<Message> queue_;
    std::atomic<std::uint64_t> lost_{0}, pushed_{0}, done_{0};
    mutable std::mutex mutex_;  ///< guards the members below; the loop never locks it
    std::condition_variable wake_, idle_;
    std::shared_ptr<const Surface> surface_;
    bool is_surface_old_ = false;  ///< bone changed after the last surface; only the worker sets it
    int waiting_for_all_ = 0;      ///< number of threads in `wait_for_all`
    bool is_stopping_ = false;
    std::thread thread_;
};

}  // namespace kerf
