// What differs from device to device, behind names; each has a portable form that is the default.
#ifndef FACET_DEVICE_H
#define FACET_DEVICE_H

// The larger, or the smaller, by component, where `bound` is never NaN; a NaN in `a` is dropped. The
// sign of a zero may be either: use only where it cannot reach a result (culling nodes). GPUs
// have one instruction for it; PoCL makes calls of fmax and fmin, and of a comparison one instruction.
#ifdef FACET_HARDWARE_MINMAX
static inline float4 cull_max(float4 a, float4 bound) { return fmax(a, bound); }
static inline float4 cull_min(float4 a, float4 bound) { return fmin(a, bound); }
#else
static inline float4 cull_max(float4 a, float4 bound) { return a > bound ? a : bound; }
static inline float4 cull_min(float4 a, float4 bound) { return a < bound ? a : bound; }
#endif

#endif
