// SPDX-License-Identifier: Apache-2.0
#include "oracles/exact_reals.hpp"

#include <arb.h>
#include <arb_hypgeom.h>
#include <arf.h>

#include <cmath>

namespace etendue::oracle {

namespace {

constexpr slong kBits = 200;

struct Dyadic {
  arf_t x;
  explicit Dyadic(double value = 0) {
    arf_init(x);
    arf_set_d(x, value);
  }
  Dyadic(const Dyadic&) = delete;
  Dyadic& operator=(const Dyadic&) = delete;
  ~Dyadic() { arf_clear(x); }
};

struct Enclosure {
  arb_t x;
  explicit Enclosure(double value = 0) {
    arb_init(x);
    arb_set_d(x, value);
  }
  Enclosure(const Enclosure&) = delete;
  Enclosure& operator=(const Enclosure&) = delete;
  ~Enclosure() { arb_clear(x); }
};

int sign_of_difference(const Dyadic& exact, double bound) {
  const Dyadic other(bound);
  const int order = arf_cmp(exact.x, other.x);
  return (order > 0) - (order < 0);
}

/// 0 where the balls do not tell: only an exact hit can do that.
int sign_of_difference(const Enclosure& exact, double bound) {
  const Enclosure other(bound);
  return arb_gt(exact.x, other.x) != 0 ? 1 : arb_lt(exact.x, other.x) != 0 ? -1 : 0;
}

constexpr slong kManyBits = 400;

void set(Enclosure& sum, TwoParts parts) {
  const Dyadic high(parts.high), low(parts.low);
  Dyadic exact;
  arf_add(exact.x, high.x, low.x, ARF_PREC_EXACT, ARF_RND_DOWN);
  arb_set_arf(sum.x, exact.x);
}

double magnitude(const Enclosure& a) {
  Dyadic most;
  arb_get_abs_ubound_arf(most.x, a.x, kBits);
  return arf_get_d(most.x, ARF_RND_UP);
}

bool within(const Enclosure& exact, double lower, double upper) {
  return sign_of_difference(exact, lower) > 0 && sign_of_difference(exact, upper) < 0;
}

}  // namespace

int compare_sum(double a, double b, double bound) {
  const Dyadic left(a), right(b);
  Dyadic sum;
  arf_add(sum.x, left.x, right.x, ARF_PREC_EXACT, ARF_RND_DOWN);
  return sign_of_difference(sum, bound);
}

int compare_product(double a, double b, double bound) {
  const Dyadic left(a), right(b);
  Dyadic product;
  arf_mul(product.x, left.x, right.x, ARF_PREC_EXACT, ARF_RND_DOWN);
  return sign_of_difference(product, bound);
}

int compare_quotient(double a, double b, double bound) {
  if (std::isinf(bound)) return bound > 0 ? -1 : 1;
  // a/b > bound iff a > bound · b, the other way round where b < 0.
  return (b > 0 ? -1 : 1) * compare_product(bound, b, a);
}

int compare_root(double a, double bound) {
  if (std::isinf(bound)) return bound > 0 ? -1 : 1;
  if (bound < 0) return 1;
  return -compare_product(bound, bound, a);
}

int compare_log(double a, double bound) {
  Enclosure x(a);
  arb_log(x.x, x.x, kBits);
  return sign_of_difference(x, bound);
}

int compare_atan(double a, double bound) {
  Enclosure x(a);
  arb_atan(x.x, x.x, kBits);
  return sign_of_difference(x, bound);
}

int compare_angle(double y, double x, double bound) {
  const Enclosure vertical(y), horizontal(x);
  Enclosure turn;
  arb_atan2(turn.x, vertical.x, horizontal.x, kBits);
  return sign_of_difference(turn, bound);
}

int compare_pi(double bound) {
  Enclosure x;
  arb_const_pi(x.x, kBits);
  return sign_of_difference(x, bound);
}

double relative_error_of_log(TwoParts x, TwoParts result) {
  Enclosure exact, found;
  set(exact, x);
  set(found, result);
  arb_log(exact.x, exact.x, kManyBits);
  arb_sub(found.x, found.x, exact.x, kManyBits);
  arb_div(found.x, found.x, exact.x, kManyBits);
  return magnitude(found);
}

double error_of_angle(TwoParts y, TwoParts x, TwoParts result) {
  Enclosure up, across, found;
  set(up, y);
  set(across, x);
  set(found, result);
  arb_atan2(up.x, up.x, across.x, kManyBits);
  arb_sub(found.x, found.x, up.x, kManyBits);
  return magnitude(found);
}

bool legendre_node_within(int n, int k, double lower, double upper) {
  Enclosure node, weight;
  arb_hypgeom_legendre_p_ui_root(node.x, weight.x, static_cast<ulong>(n), static_cast<ulong>(k), kBits);
  return (n % 2 == 1 && k == n / 2) ? lower <= 0 && upper >= 0 : within(node, lower, upper);
}

bool legendre_weight_within(int n, int k, double lower, double upper) {
  Enclosure node, weight;
  arb_hypgeom_legendre_p_ui_root(node.x, weight.x, static_cast<ulong>(n), static_cast<ulong>(k), kBits);
  return within(weight, lower, upper);
}

}  // namespace etendue::oracle
