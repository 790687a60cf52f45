// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "etendue/core/floating_point.hpp"

/// Before the definition of a function that spends its time in std::fma (exact products): it is compiled twice, and where the
/// processor has the instruction it is used; elsewhere the C library is called, some ten times slower. Both round once, so the
/// bits are the same. Sanitizers do not stand the choice at load time, and clang 14 gives such functions names of its own.
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__FMA__)
#define ETENDUE_USES_FMA __attribute__((target_clones("fma", "default"), flatten))
#else
#define ETENDUE_USES_FMA
#endif
