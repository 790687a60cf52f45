// SPDX-License-Identifier: Apache-2.0
#pragma once

// Every bound of this library assumes IEEE-754 arithmetic in double, operation by operation. Each header that computes
// or promises a number includes this one; ci/floating-point shows that each does, and that compilers are refused.
// (Contraction leaves no trace for the preprocessor: etendue::lib carries -ffp-contract=off, ci/contraction shows why.)
// Parts of -ffast-math are refused by themselves too, as far as the compiler tells: clang 14 tells the second only.
#if defined(__FAST_MATH__)
#error "etendue: -ffast-math breaks the proved error bounds; build without it"
#elif defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ != 0
#error "etendue: -ffinite-math-only removes the checks for NaN and infinity; build without it"
#elif defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || defined(__NO_SIGNED_ZEROS__)
#error "etendue: -funsafe-math-optimizations breaks the proved error bounds; build without it"
// The x87 unit keeps more digits than a double, and rounds a second time when it stores them.
#elif defined(__FLT_EVAL_METHOD__) && (__FLT_EVAL_METHOD__ == 1 || __FLT_EVAL_METHOD__ == 2)
#error "etendue: operations on doubles must round to double; on 32-bit x86 build with -msse2 -mfpmath=sse"
#endif
