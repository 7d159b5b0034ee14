// Between what lies eight to a row and eight vectors of it.
#ifndef FACET_TRANSPOSE_H
#define FACET_TRANSPOSE_H

// Eight rows of eight, columns for rows.
static inline void transpose(float8 a[8]) {
  const float8 b0 = (float8)(a[0].even, a[1].even), b4 = (float8)(a[0].odd, a[1].odd);
  const float8 b1 = (float8)(a[2].even, a[3].even), b5 = (float8)(a[2].odd, a[3].odd);
  const float8 b2 = (float8)(a[4].even, a[5].even), b6 = (float8)(a[4].odd, a[5].odd);
  const float8 b3 = (float8)(a[6].even, a[7].even), b7 = (float8)(a[6].odd, a[7].odd);
  const float8 c0 = (float8)(b0.even, b1.even), c4 = (float8)(b0.odd, b1.odd);
  const float8 c1 = (float8)(b2.even, b3.even), c5 = (float8)(b2.odd, b3.odd);
  const float8 c2 = (float8)(b4.even, b5.even), c6 = (float8)(b4.odd, b5.odd);
  const float8 c3 = (float8)(b6.even, b7.even), c7 = (float8)(b6.odd, b7.odd);
  a[0] = (float8)(c0.even, c1.even), a[4] = (float8)(c0.odd, c1.odd);
  a[1] = (float8)(c2.even, c3.even), a[5] = (float8)(c2.odd, c3.odd);
  a[2] = (float8)(c4.even, c5.even), a[6] = (float8)(c4.odd, c5.odd);
  a[3] = (float8)(c6.even, c7.even), a[7] = (float8)(c6.odd, c7.odd);
}

#endif
