// SPDX-License-Identifier: Apache-2.0
#include "run/view/event_view.h"

#include <string>

#include "session/recorder.h"

namespace kerf::run {

std::optional<ViewedEvent> viewed_event(const session::EventRow& event) {
    using Kind = ViewedEvent::Kind;
    const std::string& id = event.id;
    if (id == session::missed_event || id == session::late_change_event) return std::nullopt;
    const Kind kind = id == "goal_reached"                                        ? Kind::goal
                      : id == "limit_broken" || id == "zone_entered"              ? Kind::limit
                      : id == "step_done" || id == "tool.taken"                   ? Kind::step
                      : id == "haptics.quarantined" || id == "haptics.unresisted" ? Kind::fault
                      : id == session::image_taken_event                          ? Kind::image
                                                                                  : Kind::note;
    return ViewedEvent{event.time, kind, id + (event.detail.empty() ? "" : ": " + event.detail)};
}

}  // namespace kerf::run
