// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace etendue::oracle {

/// Each returns the sign of (exact result − bound): −1, 0 or 1; an infinite bound is beyond every result.
/// Sums, products, quotients and roots are decided by exact arithmetic on dyadic numbers, logarithms and angles by balls
/// of 200 bits, which the caller's bounds never meet to the last of them.
int compare_sum(double a, double b, double bound);
int compare_product(double a, double b, double bound);
int compare_quotient(double a, double b, double bound);
int compare_root(double a, double bound);
int compare_log(double a, double bound);
int compare_atan(double a, double bound);
/// The angle of (x, y), y ≥ 0, in [0, π].
int compare_angle(double y, double x, double bound);
/// Sign of (π − bound).
int compare_pi(double bound);

/// The exact sum of two doubles.
struct TwoParts {
  double high, low;
};
/// |result/ln x − 1|, rounded up; balls of 400 bits. ln x is not zero.
double relative_error_of_log(TwoParts x, TwoParts result);
/// |result − angle of (x, y)|, rounded up; balls of 400 bits.
double error_of_angle(TwoParts y, TwoParts x, TwoParts result);

/// The k-th node (or weight) of the n-point Gauss-Legendre rule lies within [lower, upper].
bool legendre_node_within(int n, int k, double lower, double upper);
bool legendre_weight_within(int n, int k, double lower, double upper);

}  // namespace etendue::oracle
