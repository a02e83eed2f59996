// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/loop/offer.h"

namespace kerf {

Offer copy_of(const Offer& offer) {
    Offer copy;
    copy.change = offer.change;
    copy.tick = offer.tick;
    copy.removing = offer.removing;
    for (std::size_t id = 0; id < offer.made.size(); ++id) {
        const Offer::NewBody& made = offer.made[id];
        if (made.body != nullptr)
            copy.made[id] = {
                live_body(made.body->id, *made.body->bone, made.body->committed, made.body->tracker.solid()),
                made.follows, made.through};
    }
    copy.body_states = offer.body_states;
    copy.separation = offer.separation;
    copy.added = offer.added;
    copy.subtracted = offer.subtracted;
    copy.owners = offer.owners;
    return copy;
}

}  // namespace kerf
