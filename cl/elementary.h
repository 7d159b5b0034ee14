// exp, log and x^y from additions, multiplications, fma and integer arithmetic alone. OpenCL has
// each of these rounded correctly (a division only where a device can be asked for it), so every
// device that keeps denormals gets the same bits; their own exp and pow differ by some ulps. A NaN
// may have any bits.
//
// A number that needs more than a float is the unevaluated sum of two (Dekker, Numerische
// Mathematik 18, 1971), and what a product loses comes from one fma. Largest errors in ulps of the
// exact result, denormal ones included, found by comparison with double:
//   exp_strict  0.599   all floats
//   log_strict  0.5002  all floats
//   pow_strict  0.603   4 * 10^8 pairs: x of shading, near 1, any with a finite result, any at all
// tests/tracer/elementary_test.cpp derives the limits. It compiles this file as C++, too, and holds
// the device to those bits.
#ifndef FACET_ELEMENTARY_H
#define FACET_ELEMENTARY_H

#ifdef __OPENCL_C_VERSION__
#include "vec.h"
#endif

typedef struct {
  float hi, lo;
} Sum;

// 2^n for n in -126..127.
static inline float power_of_2(int n) { return as_float((uint)(n + 127) << 23); }

// e^(x.hi + x.lo) for |x.lo| < 2^-15, as 2^n e^r with |r| <= ln2 / 2.
//
// ln2 is two floats, as in Cody and Waite (1980), but by an fma the first may have all its bits: n
// times it is a multiple of 2^-25, as is x unless n is 0; their difference is below 1/2, so exact.
// e^r = 1 + r + r^2 p(r), with p of degree 5, minimax for the relative error of e^r: 2^-33.2. What
// 1 + r loses is kept, so that only the last sum is rounded at the size of the result.
static inline float exp_of(Sum x) {
  // e^89 overflows and e^-104 rounds to 0; NaN passes.
  const float top = x.hi > 89.0f ? 89.0f : x.hi < -104.0f ? -104.0f : x.hi;
  const float rest = top == x.hi ? x.lo : 0.0f;

  // Adding 1.5 * 2^23 rounds to an integer, which is then in the low bits.
  const float shifted = fma(top, 0x1.715476p+0f, 12582912.0f);
  const float n = shifted - 12582912.0f;
  const int power = as_int(shifted) - as_int(12582912.0f);
  const float r_hi = fma(n, -0x1.62e430p-1f, top);
  const float r_lo = fma(n, 0x1.05c610p-29f, rest);
  const float r = r_hi + r_lo;
  const float r_error = (r_hi - r) + r_lo;

  float p = fma(0x1.9dfb88p-13f, r, 0x1.6d4cb8p-10f);
  p = fma(p, r, 0x1.11130ep-7f);
  p = fma(p, r, 0x1.5554e8p-5f);
  p = fma(p, r, 0x1.555554p-3f);
  p = fma(p, r, 0.5f);
  float sum = 1.0f + r;
  float more = fma(r * r, p, fma(r_error, sum, r - (sum - 1.0f)));

  // A denormal result is rounded here, once: the last place of grain + e^r is that of the result
  // before its scaling, 2^(-149 - n).
  const float grain = power < -126 ? power_of_2(-126 - power) : power == -126 ? 0.5f : 0.0f;
  const float coarse = grain + sum;
  more += sum - (coarse - grain);
  sum = (coarse + more) - grain;

  // Two factors, as 2^n itself may be outside of float's range.
  const int half_power = power >> 1;
  return (sum * power_of_2(half_power)) * power_of_2(power - half_power);
}

// ln(x) to within 2^-35 of itself (2^-35.4 over all floats). -INFINITY at 0, NaN below it.
//
// x = 2^e m with m in sqrt(1/2)..sqrt(2), and ln(m) = s + s^3 (1/12 + s^2 / 80 + ...) with s =
// 2 (m - 1) / (m + 1) (Cody and Waite 1980). What is in brackets is here of degree 3 in s^2,
// minimax for the relative error of ln(m): 2^-37.6. All but its higher terms is carried as sums.
static inline Sum log_of(float x) {
  const bool is_denormal = x < 1.17549435e-38f;
  const uint bits = as_uint(is_denormal ? x * 8388608.0f : x);
  const uint exponent = (bits - 0x3f3504f3u) & 0xff800000u;  // the bits of sqrt(1/2)
  const float e = (float)((int)exponent >> 23) - (is_denormal ? 23.0f : 0.0f);
  const float m = as_float(bits - exponent);

  // h + h_lo = (m + 1) / 2; q = 1 / h by a minimax quadratic (2^-9.6) and one step of third order.
  const float f = m - 1.0f;
  const float h = fma(0.5f, m, 0.5f);
  const float h_lo = fma(0.5f, m, 0.5f - h);
  float q = fma(fma(0x1.deab22p-1f, h, -0x1.71e3f0p+1f), h, 0x1.7a4e14p+1f);
  const float off = fma(-q, h, 1.0f);
  q = fma(q, fma(off, off, off), q);
  const float s = f * q;
  const float s_lo = fma(-s, h_lo, fma(-s, h, f)) * q;

  const float z = s * s;
  const float z_lo = fma(2.0f * s, s_lo, fma(s, s, -z));
  const float w = z + z_lo;
  const float b = fma(fma(0x1.e2f17ep-12f, w, 0x1.2438fap-9f), w, 0x1.999a7ap-7f) * w;
  const float p = 0x1.555554p-4f + b;
  const float p_lo = (b - (p - 0x1.555554p-4f)) + 0x1.fbbd36p-29f;
  const float g = z * p;
  const float g_lo = fma(z, p_lo, fma(z_lo, p, fma(z, p, -g)));
  const float c = s * g;
  const float c_lo = fma(s, g_lo, fma(s_lo, g, fma(s, g, -c)));

  // e times the first 16 bits of ln2 is exact.
  const float whole = e * 0x1.62e4p-1f;
  const float a = s + c;
  const float a_lo = (c - (a - s)) + (s_lo + c_lo);
  const float hi = whole + a;
  const float lo = (a - (hi - whole)) + fma(e, 0x1.7f7d1cp-20f, a_lo);

  const bool is_usual = x > 0.0f && x < INFINITY;
  Sum l;
  l.hi = is_usual ? hi : x == 0.0f ? -INFINITY : x > 0.0f ? x : NAN;
  l.lo = is_usual ? lo : 0.0f;
  return l;
}

// e^x: INFINITY where it is beyond float's range.
static inline float exp_strict(float x) {
  Sum s;
  s.hi = x;
  s.lo = 0.0f;
  return exp_of(s);
}

// ln x, as log_of has it.
static inline float log_strict(float x) {
  const Sum l = log_of(x);
  return l.hi + l.lo;
}

// x^y for x >= 0: 1 where x is 1 or y is 0, whatever the other; else e^(y ln x), also where one
// of them is 0 or infinite.
static inline float pow_strict(float x, float y) {
  const Sum l = log_of(x);
  Sum power;
  power.hi = y * l.hi;
  power.lo = fma(y, l.lo, fma(y, l.hi, -power.hi));
  const float usual = exp_of(power);
  return x == 1.0f || y == 0.0f ? 1.0f : usual;
}

#endif
