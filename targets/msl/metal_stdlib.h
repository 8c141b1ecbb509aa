// Declarations of the types and functions of the Metal Shading Language that Burnish's texts use,
// for clang to check the texts against. There are no definitions, so nothing can be run.
//
// They follow Apple's published "Metal Shading Language Specification", and are stricter where it
// is lenient: a scalar is no vector unless a constructor says so, but in products and sums with one.
// Attributes in double brackets cannot be declared; `attributes.txt` lists them.

#pragma once

typedef unsigned int uint;
typedef unsigned long size_t;

#define vertex
#define fragment
#define kernel
#define constant const
#define device
#define threadgroup
#define thread

namespace metal {

template <typename T, int N> struct vec;

// --- operators -----------------------------------------------------------------------------------

template <typename V, typename T, int N> struct comparable {
    friend vec<bool, N> operator==(V, V);
    friend vec<bool, N> operator!=(V, V);
};

template <typename V, typename T, int N> struct arithmetic : comparable<V, T, N> {
    friend V operator-(V);
    friend V operator+(V, V);
    friend V operator-(V, V);
    friend V operator*(V, V);
    friend V operator/(V, V);
    friend V operator+(V, T);
    friend V operator-(V, T);
    friend V operator*(V, T);
    friend V operator/(V, T);
    friend V operator+(T, V);
    friend V operator-(T, V);
    friend V operator*(T, V);
    friend V operator/(T, V);
    friend V &operator+=(V &, V);
    friend V &operator*=(V &, V);
    friend V &operator+=(V &, T);
    friend V &operator*=(V &, T);
    friend vec<bool, N> operator<(V, V);
    friend vec<bool, N> operator<=(V, V);
    friend vec<bool, N> operator>(V, V);
    friend vec<bool, N> operator>=(V, V);
};

template <typename V, typename T, int N> struct whole : arithmetic<V, T, N> {
    friend V operator~(V);
    friend V operator%(V, V);
    friend V operator%(V, T);
    friend V operator%(T, V);
    friend V operator&(V, V);
    friend V operator|(V, V);
    friend V operator^(V, V);
    friend V operator<<(V, V);
    friend V operator>>(V, V);
    friend V operator<<(V, T);
    friend V operator>>(V, T);
};

template <typename V, typename T, int N> struct logical : comparable<V, T, N> {
    friend V operator!(V);
    friend V operator&&(V, V);
    friend V operator||(V, V);
};

template <typename V, typename T, int N> struct operators;
template <typename V, int N> struct operators<V, float, N> : arithmetic<V, float, N> {};
template <typename V, int N> struct operators<V, int, N> : whole<V, int, N> {};
template <typename V, int N> struct operators<V, uint, N> : whole<V, uint, N> {};
template <typename V, int N> struct operators<V, bool, N> : logical<V, bool, N> {};

// --- vectors -------------------------------------------------------------------------------------

template <typename V, typename I> struct lane;
template <typename T, int N, typename I> struct lane<vec<T, N>, I> {
    typedef T type;
};

// Several lanes of a vector, read together.
template <typename V> struct lanes {
    operator V() const;
    template <typename I> auto operator[](I) const -> typename lane<V, I>::type;
};

#define LANES_2(A, P) lanes<vec<T, 2>> A##P##x, A##P##y;
#define LANES_3(A, P) LANES_2(A, P) lanes<vec<T, 2>> A##P##z;
#define LANES_4(A, P) LANES_3(A, P) lanes<vec<T, 2>> A##P##w;
#define TRIPLES_2(A, B) lanes<vec<T, 3>> A##B##x, A##B##y;
#define TRIPLES_3(A, B) TRIPLES_2(A, B) lanes<vec<T, 3>> A##B##z;
#define TRIPLES_4(A, B) TRIPLES_3(A, B) lanes<vec<T, 3>> A##B##w;
#define QUADS_2(A, B, C) lanes<vec<T, 4>> A##B##C##x, A##B##C##y;
#define QUADS_3(A, B, C) QUADS_2(A, B, C) lanes<vec<T, 4>> A##B##C##z;
#define QUADS_4(A, B, C) QUADS_3(A, B, C) lanes<vec<T, 4>> A##B##C##w;

#define FROM_2(M, ...) M(__VA_ARGS__, x) M(__VA_ARGS__, y)
#define FROM_3(M, ...) FROM_2(M, __VA_ARGS__) M(__VA_ARGS__, z)
#define FROM_4(M, ...) FROM_3(M, __VA_ARGS__) M(__VA_ARGS__, w)
#define PAIRS_OF_2(A) lanes<vec<T, 2>> A##x, A##y; TRIPLES_2(A, x) TRIPLES_2(A, y) \
    QUADS_2(A, x, x) QUADS_2(A, x, y) QUADS_2(A, y, x) QUADS_2(A, y, y)
#define PAIRS_OF_3(A) lanes<vec<T, 2>> A##x, A##y, A##z; \
    TRIPLES_3(A, x) TRIPLES_3(A, y) TRIPLES_3(A, z) \
    FROM_3(QUADS_3, A, x) FROM_3(QUADS_3, A, y) FROM_3(QUADS_3, A, z)
#define PAIRS_OF_4(A) lanes<vec<T, 2>> A##x, A##y, A##z, A##w; \
    TRIPLES_4(A, x) TRIPLES_4(A, y) TRIPLES_4(A, z) TRIPLES_4(A, w) \
    FROM_4(QUADS_4, A, x) FROM_4(QUADS_4, A, y) FROM_4(QUADS_4, A, z) FROM_4(QUADS_4, A, w)
#define SWIZZLES_2 PAIRS_OF_2(x) PAIRS_OF_2(y)
#define SWIZZLES_3 PAIRS_OF_3(x) PAIRS_OF_3(y) PAIRS_OF_3(z)
#define SWIZZLES_4 PAIRS_OF_4(x) PAIRS_OF_4(y) PAIRS_OF_4(z) PAIRS_OF_4(w)

template <typename T> struct alignas(2 * sizeof(T)) vec<T, 2> : operators<vec<T, 2>, T, 2> {
    union {
        struct { T x, y; };
        SWIZZLES_2
    };
    vec();
    explicit vec(T);
    vec(T, T);
    template <typename U> explicit vec(vec<U, 2>);
    template <typename U> explicit vec(lanes<vec<U, 2>>);
    template <typename I> T &operator[](I);
    template <typename I> const T &operator[](I) const;
};

template <typename T> struct alignas(4 * sizeof(T)) vec<T, 3> : operators<vec<T, 3>, T, 3> {
    union {
        struct { T x, y, z; };
        SWIZZLES_3
    };
    vec();
    explicit vec(T);
    vec(T, T, T);
    vec(vec<T, 2>, T);
    vec(T, vec<T, 2>);
    template <typename U> explicit vec(vec<U, 3>);
    template <typename U> explicit vec(lanes<vec<U, 3>>);
    template <typename I> T &operator[](I);
    template <typename I> const T &operator[](I) const;
};

template <typename T> struct alignas(4 * sizeof(T)) vec<T, 4> : operators<vec<T, 4>, T, 4> {
    union {
        struct { T x, y, z, w; };
        SWIZZLES_4
    };
    vec();
    explicit vec(T);
    vec(T, T, T, T);
    vec(vec<T, 2>, T, T);
    vec(T, vec<T, 2>, T);
    vec(T, T, vec<T, 2>);
    vec(vec<T, 2>, vec<T, 2>);
    vec(vec<T, 3>, T);
    vec(T, vec<T, 3>);
    template <typename U> explicit vec(vec<U, 4>);
    template <typename U> explicit vec(lanes<vec<U, 4>>);
    template <typename I> T &operator[](I);
    template <typename I> const T &operator[](I) const;
};

// A vector of three lanes without padding or alignment of its own.
template <typename T> struct __packed {
    T x, y, z;
    operator vec<T, 3>() const;
    __packed &operator=(vec<T, 3>);
};

} // namespace metal

#define VECTORS(kind)                    \
    typedef metal::vec<kind, 2> kind##2; \
    typedef metal::vec<kind, 3> kind##3; \
    typedef metal::vec<kind, 4> kind##4;

VECTORS(float)
VECTORS(int)
VECTORS(uint)
VECTORS(bool)

typedef metal::__packed<float> packed_float3;
typedef metal::__packed<int> packed_int3;
typedef metal::__packed<uint> packed_uint3;

namespace metal {

// --- matrices: C columns of R lanes ----------------------------------------------------------------

template <int C, int R> struct matrix;

template <int C, int R> struct columns {
    typedef vec<float, R> column;
    column all[C];
    template <typename I> column &operator[](I);
    template <typename I> const column &operator[](I) const;
    friend matrix<C, R> operator+(matrix<C, R>, matrix<C, R>);
    friend matrix<C, R> operator-(matrix<C, R>, matrix<C, R>);
    friend matrix<C, R> operator*(matrix<C, R>, float);
    friend matrix<C, R> operator*(float, matrix<C, R>);
    friend vec<float, R> operator*(matrix<C, R>, vec<float, C>);
    friend vec<float, C> operator*(vec<float, R>, matrix<C, R>);
};

#define F float
template <> struct matrix<2, 2> : columns<2, 2> {
    matrix();
    matrix(column, column);
    matrix(F, F, F, F);
};
template <> struct matrix<3, 3> : columns<3, 3> {
    matrix();
    matrix(column, column, column);
    matrix(F, F, F, F, F, F, F, F, F);
};
template <> struct matrix<4, 4> : columns<4, 4> {
    matrix();
    matrix(column, column, column, column);
    matrix(F, F, F, F, F, F, F, F, F, F, F, F, F, F, F, F);
};
template <> struct matrix<2, 3> : columns<2, 3> {
    matrix();
    matrix(column, column);
};
template <> struct matrix<2, 4> : columns<2, 4> {
    matrix();
    matrix(column, column);
};
template <> struct matrix<3, 2> : columns<3, 2> {
    matrix();
    matrix(column, column, column);
};
template <> struct matrix<3, 4> : columns<3, 4> {
    matrix();
    matrix(column, column, column);
};
template <> struct matrix<4, 2> : columns<4, 2> {
    matrix();
    matrix(column, column, column, column);
};
template <> struct matrix<4, 3> : columns<4, 3> {
    matrix();
    matrix(column, column, column, column);
};
#undef F

template <int C, int R, int K> matrix<K, R> operator*(matrix<C, R>, matrix<K, C>);

} // namespace metal

typedef metal::matrix<2, 2> float2x2;
typedef metal::matrix<3, 3> float3x3;
typedef metal::matrix<4, 4> float4x4;
typedef metal::matrix<2, 3> float2x3;
typedef metal::matrix<2, 4> float2x4;
typedef metal::matrix<3, 2> float3x2;
typedef metal::matrix<3, 4> float3x4;
typedef metal::matrix<4, 2> float4x2;
typedef metal::matrix<4, 3> float4x3;

template <typename T, typename U> T as_type(U) { static_assert(sizeof(T) == sizeof(U), "size"); }
template <typename T, typename V> T as_type(metal::lanes<V>) {
    static_assert(sizeof(T) == sizeof(V), "size");
}

namespace metal {

template <int C, int R> matrix<R, C> transpose(matrix<C, R>);
float determinant(float2x2);
float determinant(float3x3);
float determinant(float4x4);

// --- functions -----------------------------------------------------------------------------------

#define OF_1(name, T) T name(T);
#define OF_2(name, T) T name(T, T);
#define OF_3(name, T) T name(T, T, T);
#define FLOATS(M, name) M(name, float) M(name, float2) M(name, float3) M(name, float4)
#define INTS(M, name) M(name, int) M(name, int2) M(name, int3) M(name, int4)
#define UINTS(M, name) M(name, uint) M(name, uint2) M(name, uint3) M(name, uint4)
#define NUMBERS(M, name) FLOATS(M, name) INTS(M, name) UINTS(M, name)

// What there is in two precisions, `metal::precise` and `metal::fast`, besides that of the compiler's
// options.
#define MATH                                                                                \
    FLOATS(OF_1, acos) FLOATS(OF_1, acosh) FLOATS(OF_1, asin) FLOATS(OF_1, asinh)           \
    FLOATS(OF_1, atan) FLOATS(OF_1, atanh) FLOATS(OF_2, atan2) FLOATS(OF_1, ceil)           \
    FLOATS(OF_1, cos) FLOATS(OF_1, cosh) FLOATS(OF_1, exp) FLOATS(OF_1, exp2)               \
    FLOATS(OF_1, floor) FLOATS(OF_2, fmod) FLOATS(OF_1, fract) FLOATS(OF_1, log)            \
    FLOATS(OF_1, log10) FLOATS(OF_1, log2) FLOATS(OF_2, pow) FLOATS(OF_1, rint)             \
    FLOATS(OF_1, round) FLOATS(OF_1, rsqrt) FLOATS(OF_1, sin) FLOATS(OF_1, sinh)            \
    FLOATS(OF_1, sqrt) FLOATS(OF_1, tan) FLOATS(OF_1, tanh) FLOATS(OF_1, trunc)

MATH
namespace precise { MATH }
namespace fast { MATH }

FLOATS(OF_1, saturate)
FLOATS(OF_1, sign)
FLOATS(OF_3, fma)
FLOATS(OF_3, mix)
FLOATS(OF_3, smoothstep)
FLOATS(OF_2, step)
FLOATS(OF_1, abs)
INTS(OF_1, abs)
NUMBERS(OF_2, min)
NUMBERS(OF_2, max)
NUMBERS(OF_3, clamp)
INTS(OF_1, popcount)
UINTS(OF_1, popcount)
INTS(OF_1, reverse_bits)
UINTS(OF_1, reverse_bits)
INTS(OF_1, clz)
UINTS(OF_1, clz)
INTS(OF_1, ctz)
UINTS(OF_1, ctz)

#define GEOMETRY(V)          \
    float dot(V, V);         \
    float length(V);         \
    float distance(V, V);    \
    V normalize(V);          \
    V reflect(V, V);         \
    V refract(V, V, float);  \
    V faceforward(V, V, V);
GEOMETRY(float2)
GEOMETRY(float3)
GEOMETRY(float4)
float3 cross(float3, float3);

#define CHOSEN(name, T, B) T name(T, T, B);
CHOSEN(select, float, bool)
CHOSEN(select, float2, bool2)
CHOSEN(select, float3, bool3)
CHOSEN(select, float4, bool4)

bool any(bool2);
bool any(bool3);
bool any(bool4);
bool all(bool2);
bool all(bool3);
bool all(bool4);

FLOATS(OF_1, dfdx)
FLOATS(OF_1, dfdy)
void discard_fragment();

// --- arrays --------------------------------------------------------------------------------------

template <typename T, size_t N> struct array {
    T elements[N];
    template <typename I> T &operator[](I);
    template <typename I> const T &operator[](I) const;
};

// --- textures ------------------------------------------------------------------------------------

struct sampler {};
enum class component { x, y, z, w };

struct level { explicit level(float); };
struct bias { explicit bias(float); };
struct gradient2d { gradient2d(float2, float2); };
struct gradient3d { gradient3d(float3, float3); };
struct gradientcube { gradientcube(float3, float3); };

enum class access { sample, write };

template <typename T, access = access::sample> struct texture2d;
template <typename T> struct texture2d<T, access::write> {
    void write(vec<T, 4>, uint2, uint = 0) const;
};
template <typename T> struct texture2d<T, access::sample> {
    vec<T, 4> sample(sampler, float2, int2 = int2(0)) const;
    vec<T, 4> sample(sampler, float2, bias, int2 = int2(0)) const;
    vec<T, 4> sample(sampler, float2, level, int2 = int2(0)) const;
    vec<T, 4> sample(sampler, float2, gradient2d, int2 = int2(0)) const;
    vec<T, 4> gather(sampler, float2, int2 = int2(0), component = component::x) const;
    vec<T, 4> read(uint2, uint = 0) const;
    uint get_width(uint = 0) const;
    uint get_height(uint = 0) const;
    uint get_num_mip_levels() const;
};

template <typename T> struct texture2d_array {
    vec<T, 4> sample(sampler, float2, uint, int2 = int2(0)) const;
    vec<T, 4> sample(sampler, float2, uint, bias, int2 = int2(0)) const;
    vec<T, 4> sample(sampler, float2, uint, level, int2 = int2(0)) const;
    vec<T, 4> sample(sampler, float2, uint, gradient2d, int2 = int2(0)) const;
    vec<T, 4> gather(sampler, float2, uint, int2 = int2(0), component = component::x) const;
    vec<T, 4> read(uint2, uint, uint = 0) const;
    uint get_width(uint = 0) const;
    uint get_height(uint = 0) const;
    uint get_array_size() const;
    uint get_num_mip_levels() const;
};

template <typename T> struct texture3d {
    vec<T, 4> sample(sampler, float3, int3 = int3(0)) const;
    vec<T, 4> sample(sampler, float3, bias, int3 = int3(0)) const;
    vec<T, 4> sample(sampler, float3, level, int3 = int3(0)) const;
    vec<T, 4> sample(sampler, float3, gradient3d, int3 = int3(0)) const;
    vec<T, 4> read(uint3, uint = 0) const;
    uint get_width(uint = 0) const;
    uint get_height(uint = 0) const;
    uint get_depth(uint = 0) const;
    uint get_num_mip_levels() const;
};

template <typename T> struct texturecube {
    vec<T, 4> sample(sampler, float3) const;
    vec<T, 4> sample(sampler, float3, bias) const;
    vec<T, 4> sample(sampler, float3, level) const;
    vec<T, 4> sample(sampler, float3, gradientcube) const;
    vec<T, 4> gather(sampler, float3, component = component::x) const;
    uint get_width(uint = 0) const;
    uint get_height(uint = 0) const;
    uint get_num_mip_levels() const;
};

template <typename T> struct texturecube_array {
    vec<T, 4> sample(sampler, float3, uint) const;
    vec<T, 4> sample(sampler, float3, uint, bias) const;
    vec<T, 4> sample(sampler, float3, uint, level) const;
    vec<T, 4> sample(sampler, float3, uint, gradientcube) const;
    vec<T, 4> gather(sampler, float3, uint, component = component::x) const;
    uint get_width(uint = 0) const;
    uint get_height(uint = 0) const;
    uint get_array_size() const;
    uint get_num_mip_levels() const;
};

template <typename T> struct depth2d {
    T sample(sampler, float2, int2 = int2(0)) const;
    T sample(sampler, float2, level, int2 = int2(0)) const;
    T sample_compare(sampler, float2, float, int2 = int2(0)) const;
    T sample_compare(sampler, float2, float, level, int2 = int2(0)) const;
    vec<T, 4> gather_compare(sampler, float2, float, int2 = int2(0)) const;
    T read(uint2, uint = 0) const;
    uint get_width(uint = 0) const;
    uint get_height(uint = 0) const;
    uint get_num_mip_levels() const;
};

template <typename T> struct depth2d_array {
    T sample(sampler, float2, uint, int2 = int2(0)) const;
    T sample(sampler, float2, uint, level, int2 = int2(0)) const;
    T sample_compare(sampler, float2, uint, float, int2 = int2(0)) const;
    T sample_compare(sampler, float2, uint, float, level, int2 = int2(0)) const;
    vec<T, 4> gather_compare(sampler, float2, uint, float, int2 = int2(0)) const;
    T read(uint2, uint, uint = 0) const;
    uint get_width(uint = 0) const;
    uint get_height(uint = 0) const;
    uint get_array_size() const;
    uint get_num_mip_levels() const;
};

template <typename T> struct depthcube {
    T sample(sampler, float3) const;
    T sample(sampler, float3, level) const;
    T sample_compare(sampler, float3, float) const;
    T sample_compare(sampler, float3, float, level) const;
    uint get_width(uint = 0) const;
    uint get_height(uint = 0) const;
    uint get_num_mip_levels() const;
};

template <typename T> struct depthcube_array {
    T sample(sampler, float3, uint) const;
    T sample(sampler, float3, uint, level) const;
    T sample_compare(sampler, float3, uint, float) const;
    T sample_compare(sampler, float3, uint, float, level) const;
    uint get_width(uint = 0) const;
    uint get_height(uint = 0) const;
    uint get_array_size() const;
    uint get_num_mip_levels() const;
};

// --- work groups --------------------------------------------------------------------------------

enum class mem_flags { mem_none, mem_device, mem_threadgroup };

void threadgroup_barrier(mem_flags);

// --- atomic operations --------------------------------------------------------------------------

enum memory_order { memory_order_relaxed };

template <typename T> struct atomic { T value; };
typedef atomic<int> atomic_int;
typedef atomic<uint> atomic_uint;

#define ATOMIC(name) \
    int atomic_fetch_##name##_explicit(device atomic_int*, int, memory_order); \
    uint atomic_fetch_##name##_explicit(device atomic_uint*, uint, memory_order);

ATOMIC(add)
ATOMIC(min)
ATOMIC(max)
ATOMIC(and)
ATOMIC(or)

} // namespace metal
