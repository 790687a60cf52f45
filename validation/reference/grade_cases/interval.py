# SPDX-License-Identifier: Apache-2.0
"""Real numbers with proved error bars: intervals of decimals with 50 digits, every operation rounded outwards. What the truths of the
cases are computed with; it shares nothing with what is graded."""
import decimal
import fractions
import math

DIGITS = 50
DOWN = decimal.Context(prec=DIGITS, rounding=decimal.ROUND_FLOOR)
UP = decimal.Context(prec=DIGITS, rounding=decimal.ROUND_CEILING)
# ln and exp of the module decimal are rounded to nearest, whatever the context says: one more unit of the last place covers it.
NEAREST = decimal.Context(prec=DIGITS)


class Interval:
    def __init__(self, low, high=None):
        high = low if high is None else high
        self.low = low if isinstance(low, decimal.Decimal) else below(low)
        self.high = high if isinstance(high, decimal.Decimal) else above(high)
        if not self.low <= self.high:
            raise ValueError(f"no interval: {low} … {high}")

    def __add__(self, other):
        other = of(other)
        return Interval(DOWN.add(self.low, other.low), UP.add(self.high, other.high))

    def __neg__(self):
        return Interval(self.high.copy_negate(), self.low.copy_negate())

    def __sub__(self, other):
        return self + -of(other)

    def __mul__(self, other):
        other = of(other)
        pairs = [(a, b) for a in (self.low, self.high) for b in (other.low, other.high)]
        return Interval(min(DOWN.multiply(a, b) for a, b in pairs), max(UP.multiply(a, b) for a, b in pairs))

    def __truediv__(self, other):
        other = of(other)
        if other.low <= 0 <= other.high:
            raise ZeroDivisionError("the divisor may be zero")
        return self * Interval(DOWN.divide(decimal.Decimal(1), other.high), UP.divide(decimal.Decimal(1), other.low))

    __radd__, __rmul__ = __add__, __mul__

    def __rsub__(self, other):
        return of(other) - self

    def __rtruediv__(self, other):
        return of(other) / self

    def __repr__(self):
        return f"[{self.low}, {self.high}]"

    def width(self):
        return float(UP.subtract(self.high, self.low))

    def doubles(self):
        """The least pair of doubles around it."""
        low, high = float(self.low), float(self.high)
        if decimal.Decimal(low) > self.low:
            low = math.nextafter(low, -math.inf)
        if decimal.Decimal(high) < self.high:
            high = math.nextafter(high, math.inf)
        return low, high


def below(x):
    x = fractions.Fraction(x)
    return DOWN.divide(decimal.Decimal(x.numerator), decimal.Decimal(x.denominator))


def above(x):
    x = fractions.Fraction(x)
    return UP.divide(decimal.Decimal(x.numerator), decimal.Decimal(x.denominator))


def of(x):
    return x if isinstance(x, Interval) else Interval(x)


def monotone(function, x):
    """An increasing function of the module decimal, with its rounding."""
    return Interval(function(x.low).next_minus(NEAREST), function(x.high).next_plus(NEAREST))


def sqrt(x):
    """A negative low end, left by rounding about zero, is taken as zero."""
    x = of(x)
    root = monotone(NEAREST.sqrt, Interval(max(x.low, decimal.Decimal(0)), x.high))
    return Interval(max(root.low, decimal.Decimal(0)), root.high)


def log(x):
    return monotone(NEAREST.ln, of(x))


def exp(x):
    return monotone(NEAREST.exp, of(x))


def atan_of(x):
    """arctan of a rational number: halved by tan(a/2) = t/(1 + √(1 + t²)) until Leibniz' series converges quickly."""
    x = of(x)
    for _ in range(5):
        x = x / (1 + sqrt(1 + x * x))
    power, square, total, n = x, x * x, Interval(0), 0
    while True:
        term = power / (2 * n + 1)
        if max(abs(term.low), abs(term.high)) < decimal.Decimal(10)**-58:
            bar = max(abs(term.low), abs(term.high))
            return 32 * (total + Interval(-bar, bar))  # alternating and falling: the rest is below the first term left out
        total = total + (term if n % 2 == 0 else -term)
        power, n = power * square, n + 1


def atan(x):
    x = of(x)
    return Interval(atan_of(Interval(x.low, x.low)).low, atan_of(Interval(x.high, x.high)).high)


PI = 4 * (4 * atan_of(Interval(fractions.Fraction(1, 5))) - atan_of(Interval(fractions.Fraction(1, 239))))  # Machin


def asin(x):
    x = of(x)
    return atan(x / sqrt((1 - x) * (1 + x)))


def acos(x):
    return PI / 2 - asin(x)


def sin_cos(x):
    """Taylor's series at the middle of [0, 2π]-sized arguments, both within one of their slope times the interval's width."""
    x = of(x)
    middle = Interval(x.low, x.low)
    sums, term, n = [Interval(0), Interval(1)], Interval(1), 0
    while True:
        n += 1
        term = term * middle / n
        bar = max(abs(term.low), abs(term.high))
        if n > 40 and bar < decimal.Decimal(10)**-58:
            break
        sums[n % 2 == 0] = sums[n % 2 == 0] + (term if n % 4 in (0, 1) else -term)
    spread = UP.add(UP.subtract(x.high, x.low), 2 * bar)  # the rest of the series is below its first term: n > 40 > 2|x|
    return tuple(s + Interval(-spread, spread) for s in sums)


def sin(x):
    return sin_cos(x)[0]


def cos(x):
    return sin_cos(x)[1]


def degrees(d):
    return PI * fractions.Fraction(d) / 180


def dot(a, b):
    return sum((of(x) * y for x, y in zip(a, b)), Interval(0))


def scaled(s, a):
    return [of(s) * x for x in a]


def plus(a, b):
    return [of(x) + y for x, y in zip(a, b)]


def unit(a):
    return scaled(1 / sqrt(dot(a, a)), a)
