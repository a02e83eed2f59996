// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bone_screw.h"
#include "bone_thread.h"
#include "dental_implant.h"
#include "hole_before.h"
#include "kerf/plugin.hpp"
#include "pedicle_screw.h"
#include "screw_contact.h"
#include "screw_parameters.h"
#include "tap.h"
#include "thread_grip.h"
#include "thread_track.h"

/// Forces on the driver of a screw, or on the handle of a tap.
namespace kerf::implant {

using HeldThread = Held<PedicleScrew, BoneScrew, DentalImplant, Tap>;

/// The force law of a thread in bone. A helix supports the tool until it slips, the thread rubs, flutes cut, the core
/// touches its hole, the head its seat. The tool leaves a thread in the bone. Source: docs/models/screw.md.
struct ScrewInsertion : ScrewParameters {
    struct Prepared {
        ScrewThread thread{};
        ThreadPoints thread_points;
        ScrewContact contact;
    };
    /// Events that fire once, until the thread has left bone.
    struct Reported {
        bool is_in = false, has_seated = false, has_yielded = false, has_slipped = false, is_stripped = false,
             is_backing_out = false;
        bool is_crossed = false, is_cut = false;  ///< by another thread; the bone around its crests is cut
    };
    struct State {
        double angle = 0.0;       ///< [rad] turned since the thread met bone
        double front = 0.0;       ///< [rad] largest `angle`
        double torque = 0.0;      ///< [N·m] of the bone against the turn, in the last tick
        double seat_force = 0.0;  ///< [N] under the head in the last tick
        double stretch = 0.0;     ///< [m] elastic, of the thread in bone along the shaft
        double away = 0.0;        ///< [m] moved along the shaft since the thread left bone
        double grip_force = 0.0;  ///< [N] along the helix in the last tick; negative: it pulls the screw in
        double pushed = 0.0;      ///< [m] push of crests without a groove beyond the lead of the turn
        std::uint32_t held = KERF_NEW_THREAD;  ///< number of the tool's thread in bone; KERF_NEW_THREAD: none
        bool is_slipping = false;              ///< in the last tick
        HoleBefore hole;
        Reported reported;
        Prepared prepared;
    };
    struct Notes {
        double strength = 0.0, stiffness = 0.0;  ///< of the bone's thread [N], [N/m]
        double engaged = 0.0;                    ///< [m]
        float left = 1.0f, front = 0.0f;         ///< [–] remaining strength, bone fraction at the first crest
        float lost = 0.0f, bite = 0.0f;          ///< [m] slip of the bone, [–] depth of the crests in it
        float middle = 0.0f, across = 0.0f;      ///< [m], [N]: centre and limit of the sideways support
        float spread = 0.0f;                     ///< [m] along the shaft, of the sideways support
        float leading = 0.0f, last = 0.0f;       ///< [m] of z, ends of the engaged part, towards tip and head
        std::int32_t body = -1;
    };
    struct Signals {
        double torque = 0.0, turned = 0.0, engaged = 0.0, clamp = 0.0, slip = 0.0, pull_out = 0.0;
    };
    enum class Happened { going_in, head_contact, yield, slipped, stripped, backing_out, cross_threaded };

    static constexpr auto about() {
        return describe(
            "screw_insertion",
            "A thread that holds bone along its helix until it slips, friction, cutting flutes, core and head.",
            ScrewParameters::about(), budget_us(100), work({.channels = 16, .points = 414, .queries = 5}),
            signal(&Signals::torque,
                   {.id = "torque", .help = "Torque of the bone against the turn.", .unit = unit::N_m}),
            signal(&Signals::turned,
                   {.id = "turned", .help = "Angle turned since the thread met bone.", .unit = unit::deg}),
            signal(&Signals::engaged, {.id = "engaged", .help = "Length of thread in bone.", .unit = unit::mm}),
            signal(&Signals::clamp, {.id = "clamp", .help = "Force under the head.", .unit = unit::N}),
            signal(&Signals::slip,
                   {.id = "slip", .help = "Slip that the bone around the thread has suffered.", .unit = unit::mm}),
            signal(&Signals::pull_out,
                   {.id = "pull_out", .help = "Estimate of the force that pulls the screw out.", .unit = unit::N}),
            event(Happened::going_in, {.id = "implant.going_in", .help = "The thread is in bone."}),
            event(Happened::head_contact, {.id = "implant.head_contact", .help = "The head seats."}),
            event(Happened::yield, {.id = "implant.yield", .help = "The thread begins to slip in bone."}),
            event(Happened::slipped,
                  {.id = "implant.slipped", .help = "The bone around the thread has lost 1 mm to slip."}),
            event(Happened::stripped,
                  {.id = "implant.stripped", .help = "The thread of the bone is stripped.", .is_damage = true}),
            event(Happened::backing_out, {.id = "implant.backing_out", .help = "The screw is turned out."}),
            event(Happened::cross_threaded, {.id = "implant.cross_threaded",
                                             .help = "The thread crosses one of another lead.",
                                             .is_damage = true}));
    }

    void begin(const HeldThread& tool, const BoneQuery& bone, State& state) const noexcept;
    [[nodiscard]] Notes resist(const HeldThread& tool, const BoneQuery& bone, const State& state,
                               Channels& channels) const noexcept;
    void commit(const HeldThread& tool, const BoneQuery& bone, const Noted<Notes>& advance, State& state,
                Signals& signals, Actions& actions) const noexcept;

private:
    void add_track(const ThreadTrack& track, const BoneThread& found, Channels& channels) const noexcept;
    /// Moves the tool in the thread, and extends the thread where it turns into new bone.
    void turn_in(const Noted<Notes>& advance, double dt, ThreadTrack& track, State& state) const noexcept;
    void report(const Notes& notes, State& state, Actions& actions) const noexcept;
};

}  // namespace kerf::implant
