// A CPU's thread as a work-item: a large tile of consecutive keys, walked in order and written to runs, one
// for each digit.
//
// Memory is written by whole lines, gathered for each digit ("software write-combining": a store to a
// place of its own for each record would have the line read first, and more lines open than a core's
// caches and address translations hold).
#ifndef FACET_SERIAL_RUNS_H
#define FACET_SERIAL_RUNS_H
#include "sort_record.h"

#define DIGITS 2048u

// Work-item t's tile: from first_of(t) to, but not, first_of(t + 1).
static inline uint first_of(size_t t, uint tile, uint count) {
  return (uint)min((ulong)t * tile, (ulong)count);
}

// counts[tile * DIGITS + digit]: how many keys of the tile have the digit.
static inline void store_counts(const uint* own, __global uint* counts) {
  for (uint d = 0u; d < DIGITS; ++d) counts[get_global_id(0) * DIGITS + d] = own[d];
}

// Counts become the place of each tile's first key with each digit. One work-item.
static inline void scan_digits(__global uint* counts, uint tiles) {
  uint place[DIGITS];
  for (uint d = 0u; d < DIGITS; ++d) place[d] = 0u;
  for (uint t = 0u; t < tiles; ++t)
    for (uint d = 0u; d < DIGITS; ++d) place[d] += counts[t * DIGITS + d];
  uint sum = 0u;
  for (uint d = 0u; d < DIGITS; ++d) {
    const uint own = place[d];
    place[d] = sum;
    sum += own;
  }
  for (uint t = 0u; t < tiles; ++t)
    for (uint d = 0u; d < DIGITS; ++d) {
      const uint own = counts[t * DIGITS + d];
      counts[t * DIGITS + d] = place[d];
      place[d] += own;
    }
}

// A tile's runs of each digit: where they begin, and where the next record goes. Records not written yet
// wait in the digit's line, at their place modulo its length; what is before `begin` in a line of
// memory is another tile's.
typedef struct {
  uint begin[DIGITS], next[DIGITS];
} runs_type;

static inline void begin_runs(runs_type* runs, __global const uint* places, size_t tile) {
  for (uint d = 0u; d < DIGITS; ++d) runs->begin[d] = runs->next[d] = places[tile * DIGITS + d];
}

// The first of a run's places before `next` that is not written yet: at most `length`, a line, of them.
static inline uint unwritten(const runs_type* runs, uint digit, uint next, uint length) {
  return max(runs->begin[digit], (next - 1u) / length * length);
}

static inline void write_some(const record_type* line, uint from, uint to, __global record_type* out) {
  for (uint i = from; i < to; ++i) out[i] = line[i % LINE];
}

static inline void put_record(runs_type* runs, record_type (*lines)[LINE], uint digit, record_type r,
                              __global record_type* out) {
  const uint at = runs->next[digit]++;
  record_type* line = lines[digit];
  line[at % LINE] = r;
  if (at % LINE != LINE - 1u) return;
  const uint first = unwritten(runs, digit, at + 1u, LINE);
  if (first + LINE == at + 1u)
    write_line(line, out + first);
  else
    write_some(line, first, at + 1u, out);
}

static inline void end_runs(const runs_type* runs, record_type (*lines)[LINE], __global record_type* out) {
  for (uint d = 0u; d < DIGITS; ++d)
    write_some(lines[d], max(runs->begin[d], runs->next[d] / LINE * LINE), runs->next[d], out);
}

#endif
