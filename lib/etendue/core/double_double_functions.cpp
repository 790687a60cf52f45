// SPDX-License-Identifier: Apache-2.0
#include "etendue/core/double_double_functions.hpp"

#include <cmath>

#include "etendue/core/contract.hpp"

namespace etendue {

namespace {

struct Constant {
  double high, low;
  operator DoubleDouble() const { return {high, low}; }
};

/// The tables' step: what is left of an argument is at most half of it.
constexpr double kStep = 0x1p-5;
constexpr int kFirstLogarithm = 22;  // 22/32 < √½

/// ln(k/32) for k = 22 … 46, and atan(k/32) for k = 0 … 32: both rounded from 300 bits.
constexpr Constant kLogarithm[] = {{-0x1.7fafa3bd8151cp-2, 0x1.219024acd3b77p-58},
                                   {-0x1.522ae0738a3d8p-2, 0x1.8f7e9b38a6979p-57},
                                   {-0x1.269621134db92p-2, -0x1.e0efadd9db02bp-56},
                                   {-0x1.f991c6cb3b379p-3, -0x1.f665066f980a2p-57},
                                   {-0x1.a93ed3c8ad9e3p-3, -0x1.bcafa9de97203p-57},
                                   {-0x1.5bf406b543db2p-3, 0x1.1f5b44c0df7e7p-61},
                                   {-0x1.1178e8227e47cp-3, 0x1.0e63a5f01c691p-58},
                                   {-0x1.9335e5d594989p-4, 0x1.478a85704ccb7p-58},
                                   {-0x1.08598b59e3a07p-4, 0x1.dd7009902bf32p-58},
                                   {-0x1.0415d89e74444p-5, -0x1.c05cf1d753622p-59},
                                   {0x0.0p+0, 0x0.0p+0},
                                   {0x1.f829b0e783300p-6, 0x1.33e3f04f1ef23p-60},
                                   {0x1.f0a30c01162a6p-5, 0x1.85f325c5bbacdp-59},
                                   {0x1.6f0d28ae56b4cp-4, -0x1.906d99184b992p-58},
                                   {0x1.e27076e2af2e6p-4, -0x1.61578001e0162p-60},
                                   {0x1.29552f81ff523p-3, 0x1.301771c407dbfp-57},
                                   {0x1.5ff3070a793d4p-3, -0x1.bc60efafc6f6ep-58},
                                   {0x1.9525a9cf456b4p-3, 0x1.d904c1d4e2e26p-57},
                                   {0x1.c8ff7c79a9a22p-3, -0x1.4f689f8434012p-57},
                                   {0x1.fb9186d5e3e2bp-3, -0x1.caaae64f21acbp-57},
                                   {0x1.1675cababa60ep-2, 0x1.ce63eab883717p-61},
                                   {0x1.2e8e2bae11d31p-2, -0x1.8f4cdb95ebdf9p-56},
                                   {0x1.4618bc21c5ec2p-2, 0x1.f42decdeccf1dp-56},
                                   {0x1.5d1bdbf5809cap-2, 0x1.4236383dc7fe1p-56},
                                   {0x1.739d7f6bbd007p-2, -0x1.8c76ceb014b04p-56}};

constexpr Constant kArctangent[] = {{0x0.0p+0, 0x0.0p+0},
                                    {0x1.ffd55bba97625p-6, -0x1.5ec431444912cp-60},
                                    {0x1.ff55bb72cfdeap-5, -0x1.c934d86d23f1dp-60},
                                    {0x1.7ee182602f10fp-4, -0x1.cfb654c0c3d98p-58},
                                    {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
                                    {0x1.3d6eee8c6626cp-3, 0x1.61a3b0ce9281bp-57},
                                    {0x1.7b97b4bce5b02p-3, 0x1.347b0b4f881cap-58},
                                    {0x1.b90d7529260a2p-3, 0x1.17b10d2e0e5abp-61},
                                    {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
                                    {0x1.18bf5a30bf178p-2, 0x1.30ca4748b1bf9p-57},
                                    {0x1.362773707ebccp-2, -0x1.963a544b672d8p-57},
                                    {0x1.530ad9951cd4ap-2, -0x1.2566480884082p-57},
                                    {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
                                    {0x1.8b24d394a1b25p-2, 0x1.b6d0ba3748fa8p-56},
                                    {0x1.a64eec3cc23fdp-2, -0x1.24dec1b50b7ffp-56},
                                    {0x1.c0db4c94ec9f0p-2, -0x1.cc1ce70934c34p-56},
                                    {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
                                    {0x1.f40dd0b541418p-2, -0x1.a3992dc382a23p-57},
                                    {0x1.0657e94db30d0p-1, -0x1.d5b495f6349e6p-56},
                                    {0x1.1255d9bfbd2a9p-1, -0x1.2bdaee1c0ee35p-58},
                                    {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
                                    {0x1.2958e59308e31p-1, -0x1.09e73b0c6c087p-56},
                                    {0x1.345f01cce37bbp-1, 0x1.1021137c71102p-55},
                                    {0x1.3f13fb89e96f4p-1, 0x1.ecf8b492644f0p-56},
                                    {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
                                    {0x1.538f57b89061fp-1, -0x1.1bb74abda520cp-55},
                                    {0x1.5d58987169b18p-1, 0x1.0028e4bc5e7cap-57},
                                    {0x1.66d663923e087p-1, -0x1.6ea6febe8bbbap-56},
                                    {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
                                    {0x1.78f6bbd5d315ep-1, 0x1.406a089803740p-55},
                                    {0x1.819d0b7158a4dp-1, -0x1.bf76229d3b917p-56},
                                    {0x1.89ff5ff57f1f8p-1, -0x1.55b9a5e177a1bp-55},
                                    {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}};

constexpr Constant kLogarithmOfTwo = {0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};
constexpr Constant kPi = {0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};
constexpr Constant kHalfPi = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
/// 1/3, 1/5, 1/7
constexpr Constant kInverseOdd[] = {{0x1.5555555555555p-2, 0x1.5555555555555p-56},
                                    {0x1.999999999999ap-3, -0x1.999999999999ap-57},
                                    {0x1.2492492492492p-3, 0x1.2492492492492p-57}};

/// x + x³/3 + x⁵/5 + … (sign = 1), or with alternating signs (sign = −1), for |x| ≤ 2^-6: from x⁹ on, double will do.
DoubleDouble odd_series(const DoubleDouble& x, double sign) {
  const DoubleDouble square = x * x;
  const double q = sign * square.high;
  const double tail = 1.0 / 9 + q * (1.0 / 11 + q * (1.0 / 13 + q * (1.0 / 15 + q * (1.0 / 17 + q / 19))));
  const DoubleDouble signed_square = square * sign;
  DoubleDouble sum = DoubleDouble(kInverseOdd[2]) + q * tail;
  sum = DoubleDouble(kInverseOdd[1]) + signed_square * sum;
  sum = DoubleDouble(kInverseOdd[0]) + signed_square * sum;
  return x + x * (signed_square * sum);
}

/// atan(y/x) for 0 ≤ y ≤ x.
DoubleDouble arctangent(const DoubleDouble& y, const DoubleDouble& x) {
  const int k = static_cast<int>(std::lround(y.high / x.high / kStep));
  const double c = k * kStep;
  return DoubleDouble(kArctangent[k]) + odd_series((y - x * c) / (x + y * c), -1);
}

}  // namespace

DoubleDouble log(const DoubleDouble& x) {
  require(x.high > 0, "log: the argument is positive");
  int exponent = std::ilogb(x.high);
  if (std::ldexp(x.high, -exponent) > 1.41) ++exponent;
  const DoubleDouble m(std::ldexp(x.high, -exponent), std::ldexp(x.low, -exponent));
  const int k = static_cast<int>(std::lround(m.high / kStep));
  const DoubleDouble c(k * kStep);
  const DoubleDouble series = odd_series((m - c) / (m + c), 1);
  const DoubleDouble near_one = DoubleDouble(kLogarithm[k - kFirstLogarithm]) + series * 2.0;
  return exponent == 0 ? near_one : DoubleDouble(kLogarithmOfTwo) * exponent + near_one;
}

DoubleDouble angle_of(const DoubleDouble& y, const DoubleDouble& x) {
  require(!(y.high < 0), "angle_of: y is not negative");
  const DoubleDouble across = x.high < 0 ? -x : x;
  if (y.high == 0 && across.high == 0) return {};
  const DoubleDouble acute = across < y ? DoubleDouble(kHalfPi) - arctangent(across, y) : arctangent(y, across);
  return x.high < 0 ? DoubleDouble(kPi) - acute : acute;
}

}  // namespace etendue
