// Several doubles in one register, with the arithmetic that contact laws are written in.
//
// Included only by the sources that are compiled once per instruction set (kernel_*.cpp): all that it makes lives in a
// namespace that carries the name of the instruction set, so that nothing compiled for a newer processor can be linked
// into code for an older one.
#pragma once

#define HWY_COMPILE_ONLY_STATIC
#include <hwy/highway.h>

#include "granum/math/triple.hpp"

#include <cstddef>
#include <cstdint>

namespace granum::dem::GRANUM_KERNEL
{
namespace hn = hwy::HWY_NAMESPACE;
using math::Triple;

using Tag = hn::CappedTag<double, 8>;
using Register = hn::Vec<Tag>;
inline constexpr std::size_t width = hn::MaxLanes(Tag());

struct Mask
{
    hn::Mask<Tag> m;
    HWY_INLINE friend Mask operator&(Mask a, Mask b) { return {hn::And(a.m, b.m)}; }
    HWY_INLINE friend Mask operator|(Mask a, Mask b) { return {hn::Or(a.m, b.m)}; }
    HWY_INLINE friend Mask operator!(Mask a) { return {hn::Not(a.m)}; }
    HWY_INLINE unsigned bits() const
    {
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
        return static_cast<unsigned>(m.raw);
#endif
        alignas(8) std::uint8_t bytes[8] = {};
        hn::StoreMaskBits(Tag(), m, bytes);
        return bytes[0];
    }
    HWY_INLINE bool none() const
    {
        return hn::AllFalse(Tag(), m);
    }
};

struct Lanes
{
    Register v;

    Lanes() = default;
    HWY_INLINE Lanes(Register given) : v(given) {}
    HWY_INLINE Lanes(double all) : v(hn::Set(Tag(), all)) {}

    HWY_INLINE friend Lanes operator+(Lanes a, Lanes b) { return hn::Add(a.v, b.v); }
    HWY_INLINE friend Lanes operator-(Lanes a, Lanes b) { return hn::Sub(a.v, b.v); }
    HWY_INLINE friend Lanes operator*(Lanes a, Lanes b) { return hn::Mul(a.v, b.v); }
    HWY_INLINE friend Lanes operator/(Lanes a, Lanes b) { return hn::Div(a.v, b.v); }
    HWY_INLINE friend Lanes operator-(Lanes a) { return hn::Neg(a.v); }
    HWY_INLINE Lanes& operator+=(Lanes b) { return v = hn::Add(v, b.v), *this; }
    HWY_INLINE Lanes& operator-=(Lanes b) { return v = hn::Sub(v, b.v), *this; }
    HWY_INLINE Lanes& operator*=(Lanes b) { return v = hn::Mul(v, b.v), *this; }
    HWY_INLINE friend Mask operator<(Lanes a, Lanes b) { return {hn::Lt(a.v, b.v)}; }
    HWY_INLINE friend Mask operator>(Lanes a, Lanes b) { return {hn::Gt(a.v, b.v)}; }
    HWY_INLINE friend Mask operator!=(Lanes a, Lanes b) { return {hn::Ne(a.v, b.v)}; }
    HWY_INLINE friend Mask operator<=(Lanes a, Lanes b) { return {hn::Le(a.v, b.v)}; }
    HWY_INLINE friend Mask operator>=(Lanes a, Lanes b) { return {hn::Ge(a.v, b.v)}; }
};

HWY_INLINE Lanes mul_add(Lanes a, Lanes b, Lanes c)
{
    return hn::MulAdd(a.v, b.v, c.v);
}
HWY_INLINE Lanes mul_sub(Lanes a, Lanes b, Lanes c)
{
    return hn::MulSub(a.v, b.v, c.v);
}
HWY_INLINE Lanes neg_mul_add(Lanes a, Lanes b, Lanes c)
{
    return hn::NegMulAdd(a.v, b.v, c.v);
}
HWY_INLINE Lanes max(Lanes a, Lanes b)
{
    return hn::Max(a.v, b.v);
}
HWY_INLINE Lanes min(Lanes a, Lanes b)
{
    return hn::Min(a.v, b.v);
}
HWY_INLINE Lanes abs(Lanes a)
{
    return hn::Abs(a.v);
}
HWY_INLINE bool any(Mask m)
{
    return !m.none();
}
HWY_INLINE Lanes select(Mask m, Lanes a, Lanes b)
{
    return hn::IfThenElse(m.m, a.v, b.v);
}
HWY_INLINE Lanes load(double const* from)
{
    return hn::Load(Tag(), from);
}
HWY_INLINE Lanes load_anywhere(double const* from)
{
    return hn::LoadU(Tag(), from);
}
HWY_INLINE void store(Lanes a, double* to)
{
    hn::Store(a.v, Tag(), to);
}
HWY_INLINE double sum(Lanes a)
{
    return hn::GetLane(hn::SumOfLanes(Tag(), a.v));
}

#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
// An estimate of 14 bits and a series in what it misses: exact to about one unit in the last place, in a third of the
// time that the divider takes.
HWY_INLINE Lanes missing(Lanes a, Lanes b)  // 1 - a b
{
    return hn::NegMulAdd(a.v, b.v, hn::Set(Tag(), 1.0));
}
HWY_INLINE Lanes reciprocal(Lanes a)
{
    Lanes const r = Register{_mm512_rcp14_pd(a.v.raw)}, miss = missing(a, r);
    Lanes const near = mul_add(r, miss, r);
    return mul_add(near, miss * miss, near);
}
HWY_INLINE Lanes reciprocal_sqrt(Lanes a)
{
    Lanes const r = Register{_mm512_rsqrt14_pd(a.v.raw)}, miss = missing(a * r, r);
    Lanes const series = mul_add(mul_add(Lanes(5.0 / 16), miss, Lanes(3.0 / 8)), miss, Lanes(0.5));
    return mul_add(series, r * miss, r);
}
HWY_INLINE Lanes inverse_fourth_root(Lanes a)
{
    Lanes const half = Register{_mm512_rsqrt14_pd(a.v.raw)};
    Lanes const r = half * Lanes(Register{_mm512_rsqrt14_pd(half.v.raw)}), square = r * r,
                miss = missing(a * square, square);
    Lanes series = mul_add(Lanes(195.0 / 2048), miss, Lanes(15.0 / 128));
    series = mul_add(mul_add(series, miss, Lanes(5.0 / 32)), miss, Lanes(0.25));
    return mul_add(series, r * miss, r);
}
HWY_INLINE Lanes sqrt(Lanes a)
{
    Lanes const r = reciprocal_sqrt(a);
    return Register{
        _mm512_maskz_mul_pd(_mm512_cmp_pd_mask(a.v.raw, _mm512_setzero_pd(), _CMP_GT_OQ), a.v.raw, r.v.raw)};
}
#else
HWY_INLINE Lanes reciprocal(Lanes a)
{
    return Lanes(1.0) / a;
}
HWY_INLINE Lanes sqrt(Lanes a)
{
    return hn::Sqrt(a.v);
}
HWY_INLINE Lanes reciprocal_sqrt(Lanes a)
{
    return Lanes(1.0) / sqrt(a);
}
HWY_INLINE Lanes inverse_fourth_root(Lanes a)
{
    return Lanes(1.0) / sqrt(sqrt(a));
}
#endif

HWY_INLINE Lanes exact_sqrt(Lanes a)
{
    return hn::Sqrt(a.v);
}
HWY_INLINE Lanes power_of_two_below(Lanes a)
{
    hn::RebindToUnsigned<Tag> const bits;
    return hn::BitCast(Tag(), hn::And(hn::BitCast(bits, a.v), hn::Set(bits, 0x7FF0000000000000u)));
}

// Two registers of contacts that know nothing of each other: where one waits for a result, the other goes on.
struct BothMask
{
    Mask a, b;
    HWY_INLINE friend BothMask operator&(BothMask m, BothMask n) { return {m.a & n.a, m.b & n.b}; }
    HWY_INLINE friend BothMask operator|(BothMask m, BothMask n) { return {m.a | n.a, m.b | n.b}; }
    HWY_INLINE friend BothMask operator!(BothMask m) { return {!m.a, !m.b}; }
};

struct Both
{
    Lanes a, b;

    Both() = default;
    HWY_INLINE Both(double all) : a(all), b(a) {}
    HWY_INLINE Both(Lanes one, Lanes other) : a(one), b(other) {}
    HWY_INLINE Lanes& part(std::size_t which) { return which == 0 ? a : b; }

    HWY_INLINE friend Both operator+(Both x, Both y) { return {x.a + y.a, x.b + y.b}; }
    HWY_INLINE friend Both operator-(Both x, Both y) { return {x.a - y.a, x.b - y.b}; }
    HWY_INLINE friend Both operator*(Both x, Both y) { return {x.a * y.a, x.b * y.b}; }
    HWY_INLINE friend Both operator/(Both x, Both y) { return {x.a / y.a, x.b / y.b}; }
    HWY_INLINE friend Both operator-(Both x) { return {-x.a, -x.b}; }
    HWY_INLINE Both& operator+=(Both y) { return *this = *this + y; }
    HWY_INLINE friend BothMask operator<(Both x, Both y) { return {x.a < y.a, x.b < y.b}; }
    HWY_INLINE friend BothMask operator>(Both x, Both y) { return {x.a > y.a, x.b > y.b}; }
    HWY_INLINE friend BothMask operator<=(Both x, Both y) { return {x.a <= y.a, x.b <= y.b}; }
    HWY_INLINE friend BothMask operator>=(Both x, Both y) { return {x.a >= y.a, x.b >= y.b}; }
};

HWY_INLINE Both mul_add(Both x, Both y, Both z)
{
    return {mul_add(x.a, y.a, z.a), mul_add(x.b, y.b, z.b)};
}
HWY_INLINE Both mul_sub(Both x, Both y, Both z)
{
    return {mul_sub(x.a, y.a, z.a), mul_sub(x.b, y.b, z.b)};
}
HWY_INLINE Both neg_mul_add(Both x, Both y, Both z)
{
    return {neg_mul_add(x.a, y.a, z.a), neg_mul_add(x.b, y.b, z.b)};
}
HWY_INLINE Both max(Both x, Both y)
{
    return {max(x.a, y.a), max(x.b, y.b)};
}
HWY_INLINE Both min(Both x, Both y)
{
    return {min(x.a, y.a), min(x.b, y.b)};
}
HWY_INLINE Both abs(Both x)
{
    return {abs(x.a), abs(x.b)};
}
HWY_INLINE bool any(BothMask m)
{
    return any(m.a | m.b);
}
HWY_INLINE Both select(BothMask m, Both x, Both y)
{
    return {select(m.a, x.a, y.a), select(m.b, x.b, y.b)};
}
HWY_INLINE Both reciprocal(Both x)
{
    return {reciprocal(x.a), reciprocal(x.b)};
}
HWY_INLINE Both sqrt(Both x)
{
    return {sqrt(x.a), sqrt(x.b)};
}
HWY_INLINE Both reciprocal_sqrt(Both x)
{
    return {reciprocal_sqrt(x.a), reciprocal_sqrt(x.b)};
}
HWY_INLINE Both inverse_fourth_root(Both x)
{
    return {inverse_fourth_root(x.a), inverse_fourth_root(x.b)};
}

// The same pointer, of which the compiler forgets what it has read there: more addresses than registers would be kept
// in places dearer than the memory that they come from.
template <class T>
HWY_INLINE T const* read_again(T const* from)
{
    __asm__("" : "+r"(from));
    return from;
}

// Numbers of `width` rows, each at its own distance from `base`.
struct Addresses
{
    double* base;
    std::uint32_t const* distance;

    HWY_INLINE double* at(std::size_t lane) const { return base + distance[lane]; }
    HWY_INLINE void forget() { distance = read_again(distance); }
};

// Four numbers of `width` rows: out[k] holds the k-th numbers behind `offset` of the rows.
HWY_INLINE void gather_quads(Addresses const& rows, std::size_t offset, Lanes* out)
{
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
    auto const both = [&](std::size_t k) {
        return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_load_pd(rows.at(k) + offset)),
                                  _mm256_load_pd(rows.at(k + 4) + offset), 1);
    };
    __m512d const r0 = both(0), r1 = both(1), r2 = both(2), r3 = both(3);
    __m512d const xz0 = _mm512_unpacklo_pd(r0, r1), yw0 = _mm512_unpackhi_pd(r0, r1);
    __m512d const xz1 = _mm512_unpacklo_pd(r2, r3), yw1 = _mm512_unpackhi_pd(r2, r3);
    __m512i const low = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13),
                  high = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
    out[0] = Register{_mm512_permutex2var_pd(xz0, low, xz1)};
    out[1] = Register{_mm512_permutex2var_pd(yw0, low, yw1)};
    out[2] = Register{_mm512_permutex2var_pd(xz0, high, xz1)};
    out[3] = Register{_mm512_permutex2var_pd(yw0, high, yw1)};
#elif HWY_TARGET == HWY_AVX2
    Tag const d;
    auto const r0 = hn::Load(d, rows.at(0) + offset), r1 = hn::Load(d, rows.at(1) + offset);
    auto const r2 = hn::Load(d, rows.at(2) + offset), r3 = hn::Load(d, rows.at(3) + offset);
    auto const xz0 = hn::InterleaveLower(d, r0, r1), yw0 = hn::InterleaveUpper(d, r0, r1);
    auto const xz1 = hn::InterleaveLower(d, r2, r3), yw1 = hn::InterleaveUpper(d, r2, r3);
    out[0] = hn::ConcatLowerLower(d, xz1, xz0), out[1] = hn::ConcatLowerLower(d, yw1, yw0);
    out[2] = hn::ConcatUpperUpper(d, xz1, xz0), out[3] = hn::ConcatUpperUpper(d, yw1, yw0);
#else
    alignas(64) double values[4][8];
    for (std::size_t lane = 0; lane < width; ++lane)
        for (std::size_t k = 0; k < 4; ++k) values[k][lane] = rows.at(lane)[offset + k];
    for (std::size_t k = 0; k < 4; ++k) out[k] = load(values[k]);
#endif
}

// Three numbers of each lane, turned into rows of three and a zero.
struct Rows
{
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
    __m512d of[4];  // each holds a row in its lower and one in its upper half: 0 4, 1 5, 2 6, 3 7

    HWY_INLINE explicit Rows(Triple<Lanes> const& in)
    {
        __m512d const zero = _mm512_setzero_pd(), x = in.x.v.raw, y = in.y.v.raw, z = in.z.v.raw;
        __m512i const even = _mm512_setr_epi64(0, 1, 8, 9, 4, 5, 12, 13),
                      odd = _mm512_setr_epi64(2, 3, 10, 11, 6, 7, 14, 15);
        __m512d const xy0 = _mm512_unpacklo_pd(x, y), xy1 = _mm512_unpackhi_pd(x, y);
        __m512d const z0 = _mm512_unpacklo_pd(z, zero), z1 = _mm512_unpackhi_pd(z, zero);
        of[0] = _mm512_permutex2var_pd(xy0, even, z0), of[1] = _mm512_permutex2var_pd(xy1, even, z1);
        of[2] = _mm512_permutex2var_pd(xy0, odd, z0), of[3] = _mm512_permutex2var_pd(xy1, odd, z1);
    }
#elif HWY_TARGET == HWY_AVX2
    Register of[4];

    HWY_INLINE explicit Rows(Triple<Lanes> const& in)
    {
        Tag const d;
        auto const zero = hn::Zero(d);
        auto const xy0 = hn::InterleaveLower(d, in.x.v, in.y.v), xy1 = hn::InterleaveUpper(d, in.x.v, in.y.v);
        auto const z0 = hn::InterleaveLower(d, in.z.v, zero), z1 = hn::InterleaveUpper(d, in.z.v, zero);
        of[0] = hn::ConcatLowerLower(d, z0, xy0), of[1] = hn::ConcatLowerLower(d, z1, xy1);
        of[2] = hn::ConcatUpperUpper(d, z0, xy0), of[3] = hn::ConcatUpperUpper(d, z1, xy1);
    }
#else
    alignas(64) double of[3][8];

    HWY_INLINE explicit Rows(Triple<Lanes> const& in)
    {
        store(in.x, of[0]), store(in.y, of[1]), store(in.z, of[2]);
    }
#endif
};

// Adds a force and a torque to each row of eight numbers (the fourth and the eighth stay), or subtracts them, one row
// after the other: rows may be the same.
template <bool Subtract>
HWY_INLINE void add_pulls(Addresses const& rows, Rows const& force, Rows const& torque)
{
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
    auto const add = [&](std::size_t lane, __m512d what) {
        __m512d const before = _mm512_load_pd(rows.at(lane));
        _mm512_store_pd(rows.at(lane), Subtract ? _mm512_sub_pd(before, what) : _mm512_add_pd(before, what));
    };
    for (std::size_t k = 0; k < 4; ++k)
        add(k, _mm512_insertf64x4(force.of[k], _mm512_castpd512_pd256(torque.of[k]), 1));
    for (std::size_t k = 0; k < 4; ++k) add(k + 4, _mm512_shuffle_f64x2(force.of[k], torque.of[k], 0xEE));
#elif HWY_TARGET == HWY_AVX2
    Tag const d;
    auto const add = [&](double* to, Register what) {
        auto const before = hn::Load(d, to);
        hn::Store(Subtract ? hn::Sub(before, what) : hn::Add(before, what), d, to);
    };
    for (std::size_t lane = 0; lane < width; ++lane) {
        add(rows.at(lane), force.of[lane]);
        add(rows.at(lane) + 4, torque.of[lane]);
    }
#else
    for (std::size_t lane = 0; lane < width; ++lane)
        for (std::size_t d = 0; d < 3; ++d) {
            rows.at(lane)[d] += Subtract ? -force.of[d][lane] : force.of[d][lane];
            rows.at(lane)[4 + d] += Subtract ? -torque.of[d][lane] : torque.of[d][lane];
        }
#endif
}
}
