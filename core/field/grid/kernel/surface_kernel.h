// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/field/grid/kernel/block_kernel.h"

/// The stages of a brick's surface in `BlockKernel`: for any machine, and for AVX2.
namespace kerf {

namespace portable {
KernelStage<&BlockKernel::larger_rows> larger_rows;
KernelStage<&BlockKernel::larger_border> larger_border;
KernelStage<&BlockKernel::crossings> crossings;
}  // namespace portable

namespace avx2 {
KernelStage<&BlockKernel::larger_rows> larger_rows;
KernelStage<&BlockKernel::larger_border> larger_border;
KernelStage<&BlockKernel::crossings> crossings;
}  // namespace avx2

}  // namespace kerf
