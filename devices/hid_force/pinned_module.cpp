// SPDX-License-Identifier: Apache-2.0
#include "pinned_module.h"

#include <dlfcn.h>
#include <sys/auxv.h>

namespace kerf::hid_force {

bool pin_module() noexcept {
    Dl_info here{}, program{};
    if (dladdr(reinterpret_cast<const void*>(&pin_module), &here) == 0) return false;
    if (dladdr(reinterpret_cast<const void*>(getauxval(AT_PHDR)), &program) != 0 && program.dli_fbase == here.dli_fbase)
        return true;  // a program is never unloaded
    return dlopen(here.dli_fname, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE) != nullptr;
}

}  // namespace kerf::hid_force
