// What differs from device to device, behind names; each has a portable form that is the default.
#ifndef FACET_DEVICE_H
#define FACET_DEVICE_H

// The larger and the smaller of two numbers of which `bound` is never NaN; a NaN in `a` is dropped.
// The sign of a zero may be either: use only where it cannot reach a result (culling nodes).
// GPUs have one instruction for it; PoCL turns fmin and fmax into calls that cost six times the
// comparison (measured on shadow rays).
#ifdef FACET_HARDWARE_MINMAX
#define FACET_CULL_MAX(a, bound) fmax(a, bound)
#define FACET_CULL_MIN(a, bound) fmin(a, bound)
#else
#define FACET_CULL_MAX(a, bound) ((a) > (bound) ? (a) : (bound))
#define FACET_CULL_MIN(a, bound) ((a) < (bound) ? (a) : (bound))
#endif

#endif
