// Between what lies eight to a row and eight vectors of it.
#ifndef FACET_TRANSPOSE_H
#define FACET_TRANSPOSE_H

// Of four vectors of two times four: columns for rows in each half.
static inline void transpose_halves(float8* a, float8* b, float8* c, float8* d) {
  const float8 p = (float8)(a->s0, b->s0, a->s1, b->s1, a->s4, b->s4, a->s5, b->s5);
  const float8 q = (float8)(a->s2, b->s2, a->s3, b->s3, a->s6, b->s6, a->s7, b->s7);
  const float8 r = (float8)(c->s0, d->s0, c->s1, d->s1, c->s4, d->s4, c->s5, d->s5);
  const float8 s = (float8)(c->s2, d->s2, c->s3, d->s3, c->s6, d->s6, c->s7, d->s7);
  *a = (float8)(p.s01, r.s01, p.s45, r.s45);
  *b = (float8)(p.s23, r.s23, p.s67, r.s67);
  *c = (float8)(q.s01, s.s01, q.s45, s.s45);
  *d = (float8)(q.s23, s.s23, q.s67, s.s67);
}

// Eight rows of eight, columns for rows.
static inline void transpose(float8 a[8]) {
  float8 b[8] = {(float8)(a[0].lo, a[4].lo), (float8)(a[1].lo, a[5].lo), (float8)(a[2].lo, a[6].lo),
                 (float8)(a[3].lo, a[7].lo), (float8)(a[0].hi, a[4].hi), (float8)(a[1].hi, a[5].hi),
                 (float8)(a[2].hi, a[6].hi), (float8)(a[3].hi, a[7].hi)};
  transpose_halves(&b[0], &b[1], &b[2], &b[3]);
  transpose_halves(&b[4], &b[5], &b[6], &b[7]);
  for (int i = 0; i < 8; ++i) a[i] = b[i];
}

#endif
