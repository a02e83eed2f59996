// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "core/field/patch_table.h"
#include "core/field/spsc_ring.h"
#include "core/haptics/live_body.h"

/// The thread beside the loop.
namespace kerf {

/// Stamps the loop's records into bone of its own, without lag; finds what has come apart and makes bodies of it; makes the
/// surface anew where it changed. It shares no voxel with the loop: records go there, and finished bodies come back whole.
///
/// The loop's bits do not depend on when it does so, but for the tick at which a separation is adopted: that is an input, and is
/// recorded. In lock-step the loop waits for it (`wait_for_all`), so that the tick is always the same.
class SurfaceWorker {
public:
    /// What a viewer draws: who holds it may read it on any thread for as long as he likes.
    struct Surface {
        std::uint64_t version = 0;
        std::vector<PatchTable> patches;  ///< of each body
    };
    struct Options {
        double crumb = 0.0;        ///< [m³] smaller pieces are no bodies
        bool looks_for_pieces = true, makes_surface = true;
    };

    /// `body` and the cutting solids, as records number them, must outlive it.   [main]
    SurfaceWorker(const Body& body, std::vector<const ToolSolid*> cutting, Options options);
    ~SurfaceWorker();
    SurfaceWorker(const SurfaceWorker&) = delete;
    SurfaceWorker& operator=(const SurfaceWorker&) = delete;

    /// A record that removes bone. False when the queue is full: it is lost, and what the worker knows is no longer true.
    /// [haptic, nonblocking] one thread only
    bool push(const CutRecord& record) noexcept;
    /// What came apart, if it is made by now; it stays offered until `answer`.   [haptic, nonblocking]
    [[nodiscard]] Adoption* offered() noexcept {
        return offer_state_.load(std::memory_order_acquire) == OfferState::offered ? &offer_ : nullptr;
    }
    /// Whether the loop has taken over what is offered; if not, it is brought up to date and offered again. Records pushed before
    /// name bodies as they were, those pushed from now on as they are.   [haptic, nonblocking]
    void answer(bool is_adopted) noexcept;

    /// Until everything pushed is done and in the surface, and an offer that is due has been made.   [not the loop's thread on the
    /// clock; may block]
    void wait_for_all();
    /// The newest surface; while bone is cut there is a new one sixty times a second.   [any, but not the loop: it may wait for the
    /// worker to hand it out]
    [[nodiscard]] std::shared_ptr<const Surface> surface() const;
    /// The bone as the worker has it. Only after `wait_for_all`, and before anything else is pushed.   [main]
    [[nodiscard]] PresentBone& bone() noexcept { return bone_; }
    [[nodiscard]] std::uint64_t lost() const noexcept { return lost_.load(std::memory_order_relaxed); }

private:
    struct Message {
        CutRecord record;
        bool is_adoption = false;  ///< the offer was taken
    };
    enum class OfferState : int { none, offered, taken, refused };

    void work();
    [[nodiscard]] std::uint64_t take_all();
    void take(const Message& message);
    void make_offer();
    void make_surface();

    std::vector<const ToolSolid*> cutting_;
    Options options_;
    PresentBone bone_;
    std::vector<SurfacePatches> patches_;  ///< of each body
    std::vector<std::uint64_t> next_;      ///< of each body: its first record not yet seen
    std::vector<Separation> waiting_;
    Adoption offer_;
    std::atomic<OfferState> offer_state_{OfferState::none};

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
