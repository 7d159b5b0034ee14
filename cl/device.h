// What differs from device to device, behind names; each has a portable form that is the default.
#ifndef FACET_DEVICE_H
#define FACET_DEVICE_H

// The larger, or the smaller, by component, where `bound` is never NaN; a NaN in `a` is dropped. The
// sign of a zero may be either: use only where it cannot reach a result. GPUs
// have one instruction for it; PoCL makes calls of fmax and fmin, and of a comparison one instruction.
#ifdef FACET_HARDWARE_MINMAX
#define FACET_CULL_MAX(a, bound) fmax(a, bound)
#define FACET_CULL_MIN(a, bound) fmin(a, bound)
#else
#define FACET_CULL_MAX(a, bound) ((a) > (bound) ? (a) : (bound))
#define FACET_CULL_MIN(a, bound) ((a) < (bound) ? (a) : (bound))
#endif
static inline float cull_max1(float a, float bound) { return FACET_CULL_MAX(a, bound); }
static inline float cull_min1(float a, float bound) { return FACET_CULL_MIN(a, bound); }
static inline float3 cull_max3(float3 a, float3 bound) { return FACET_CULL_MAX(a, bound); }
static inline float3 cull_min3(float3 a, float3 bound) { return FACET_CULL_MIN(a, bound); }
static inline float4 cull_max(float4 a, float4 bound) { return FACET_CULL_MAX(a, bound); }
static inline float4 cull_min(float4 a, float4 bound) { return FACET_CULL_MIN(a, bound); }

#endif
