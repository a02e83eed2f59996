// SPDX-License-Identifier: Apache-2.0
extern "C" __attribute__((visibility("hidden"))) const char kerf_how[];
extern "C" const char kerf_how[] = KERF_HOW;
