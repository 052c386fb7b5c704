// SIMD vectors of two doubles or four floats. Every lane gives the same result as scalar arithmetic.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "regionmesh/vec3.h"

namespace regionmesh {

using Double2 = double __attribute__((vector_size(16)));
using Float4 = float __attribute__((vector_size(16)));
using Mask2 = decltype(Double2{} < Double2{});  // result of a comparison: all bits of a lane are set, or none
using Mask4 = decltype(Float4{} < Float4{});

using Lane4 = std::int32_t __attribute__((vector_size(16)));
using Unsigned4 = std::uint32_t __attribute__((vector_size(16)));

/// Loads from any address.
template <class Lanes>
Lanes load(const void* from) {
    Lanes lanes;
    std::memcpy(&lanes, from, sizeof(lanes));
    return lanes;
}

/// Columns of the four as rows.
template <class Lanes>
std::array<Lanes, 4> transposed(Lanes a, Lanes b, Lanes c, Lanes d) {
    const Lanes low_ab = __builtin_shufflevector(a, b, 0, 4, 1, 5), high_ab = __builtin_shufflevector(a, b, 2, 6, 3, 7);
    const Lanes low_cd = __builtin_shufflevector(c, d, 0, 4, 1, 5), high_cd = __builtin_shufflevector(c, d, 2, 6, 3, 7);
    return {__builtin_shufflevector(low_ab, low_cd, 0, 1, 4, 5), __builtin_shufflevector(low_ab, low_cd, 2, 3, 6, 7),
            __builtin_shufflevector(high_ab, high_cd, 0, 1, 4, 5),
            __builtin_shufflevector(high_ab, high_cd, 2, 3, 6, 7)};
}

inline Double2 both(double x) { return Double2{x, x}; }
inline Float4 all_four(float x) { return Float4{x, x, x, x}; }

/// Bit n is set if lane n is.
inline unsigned bits_of(Mask2 mask) {
#if defined(__SSE2__)
    return static_cast<unsigned>(_mm_movemask_pd(reinterpret_cast<__m128d>(mask)));
#else
    return (mask[0] != 0 ? 1u : 0u) | (mask[1] != 0 ? 2u : 0u);
#endif
}
inline unsigned bits_of(Mask4 mask) {
#if defined(__SSE2__)
    return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(mask)));
#else
    unsigned bits = 0;
    for (int n = 0; n < 4; ++n) bits |= (mask[n] != 0 ? 1u : 0u) << n;
    return bits;
#endif
}

inline Double2 square_root(Double2 x) {
#if defined(__SSE2__)
    return _mm_sqrt_pd(x);
#else
    return Double2{std::sqrt(x[0]), std::sqrt(x[1])};
#endif
}

inline Float4 square_root(Float4 x) {
#if defined(__SSE2__)
    return _mm_sqrt_ps(x);
#else
    return Float4{std::sqrt(x[0]), std::sqrt(x[1]), std::sqrt(x[2]), std::sqrt(x[3])};
#endif
}

inline double square_root(double x) { return std::sqrt(x); }

/// Lane by lane a < b ? a : b, and a < b ? b : a.
inline double least(double a, double b) { return a < b ? a : b; }
inline double greatest(double a, double b) { return a < b ? b : a; }
#if defined(__SSE2__)
inline Double2 least(Double2 a, Double2 b) { return _mm_min_pd(a, b); }
inline Double2 greatest(Double2 a, Double2 b) { return _mm_max_pd(b, a); }
inline Float4 least(Float4 a, Float4 b) { return _mm_min_ps(a, b); }
inline Float4 greatest(Float4 a, Float4 b) { return _mm_max_ps(b, a); }
#else
template <class T>
T least(T a, T b) {
    return a < b ? a : b;
}
template <class T>
T greatest(T a, T b) {
    return a < b ? b : a;
}
#endif

/// Several points or vectors, one per lane.
template <class T>
struct Lanes3 {
    T x{}, y{}, z{};

    void put(int lane, Vec3 p) { x[lane] = p.x, y[lane] = p.y, z[lane] = p.z; }
    Vec3 operator[](int lane) const { return {x[lane], y[lane], z[lane]}; }
};

template <class T>
Lanes3<T> operator-(const Lanes3<T>& a, const Lanes3<T>& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
T dot(const Lanes3<T>& a, const Lanes3<T>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
Lanes3<T> cross(const Lanes3<T>& a, const Lanes3<T>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Lanes3<Double2> side_by_side(Vec3 p, Vec3 q) {
    return {Double2{p.x, q.x}, Double2{p.y, q.y}, Double2{p.z, q.z}};
}
inline Lanes3<Double2> both(Vec3 p) { return {both(p.x), both(p.y), both(p.z)}; }

}  // namespace regionmesh
