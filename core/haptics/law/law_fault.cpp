// SPDX-License-Identifier: Apache-2.0
#include "core/haptics/law/law_fault.h"

#include "core/plugin/number_text.h"
#include "core/plugin/plain_text.h"
#include "core/plugin/plugin_call.h"

namespace kerf {

namespace {

std::string number_text(double value) { return kerf::number_text(value, 6); }

std::string name_of_status(double status) {
    const auto code = static_cast<kerf_status>(status);
    if (code == KERF_FAILED) return " (KERF_FAILED)";
    if (code == KERF_OUT_OF_RANGE) return " (KERF_OUT_OF_RANGE)";
    if (code == KERF_CAPACITY) return " (KERF_CAPACITY: it needs more channels than there are)";
    return "";
}

}  // namespace

std::string name_of_law(const kerf_component& law) {
    const ComponentName name = name_of(&law);
    return quoted_plain(law.id) + (name.is_known() ? std::string(" of ") + name.plugin + " (" + name.file + ")" : "");
}

std::string text_of(const LawFault& fault) {
    if (fault.what == LawFault::What::none) return {};
    const std::string law = name_of_law(*fault.law) + ": ", index = std::to_string(fault.index);
    const std::string is = " is " + number_text(fault.value) + ", expected ";
    switch (fault.what) {
        case LawFault::What::status:
        case LawFault::What::commit_status:
            return law + (fault.what == LawFault::What::status ? "`resist`" : "`commit`") + " returned " +
                   number_text(fault.value) + name_of_status(fault.value) + ", expected 0 (KERF_OK).";
        case LawFault::What::count:
            return law + "its law's `count`" + is + "at most " + std::to_string(KERF_MAX_CHANNELS) + ".";
        case LawFault::What::channel:
            return law + "channel " + index + " (id " + std::to_string(fault.id) + "): `" + fault.field + "`" + is +
                   fault.expected + ".";
        case LawFault::What::wrench:
            return law + "`wrench[" + index + "]`" + is + "a number from -1e+05 to 1e+05.";
        case LawFault::What::signal:
            return law + "signal " + quoted_plain(fault.law->force->signals[fault.index].id) + is + "a finite number.";
        case LawFault::What::underrun:
            return law + "a call wrote in front of `" + fault.field + "`, expected no write outside of it.";
        case LawFault::What::impure:
            return law +
                   "two calls of `resist` with the same inputs gave two laws, expected one. Keep what changes in the "
                   "state, and write it in `commit`.";
        case LawFault::What::floating_point:
            return law +
                   "a call left another rounding mode, or other traps, of the floating-point unit, expected those that "
                   "it was called with. Restore them before the call returns.";
        default:
            return law + "no motion balances its law: the solve ended with a residual of " + number_text(fault.value) +
                   ".";
    }
}

}  // namespace kerf
