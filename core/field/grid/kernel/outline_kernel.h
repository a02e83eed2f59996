// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/field/grid/kernel/block_kernel.h"

/// The stages of a solid's outline and of stamps in `BlockKernel`: for any machine, and for AVX2.
namespace kerf {

namespace portable {
KernelStage<&BlockKernel::depths> depths;
KernelStage<&BlockKernel::tangents> tangents;
KernelStage<&BlockKernel::deepest> deepest;
KernelStage<&BlockKernel::raise> raise;
KernelStage<&BlockKernel::find> find;
}  // namespace portable

namespace avx2 {
KernelStage<&BlockKernel::depths> depths;
KernelStage<&BlockKernel::tangents> tangents;
KernelStage<&BlockKernel::deepest> deepest;
KernelStage<&BlockKernel::raise> raise;
KernelStage<&BlockKernel::find> find;
}  // namespace avx2

}  // namespace kerf
