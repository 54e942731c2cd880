/* Medians as networks of least and greatest, once for all ports. Included after the includer has said what a value is
 * (one byte, or a vector of them):
 *
 *     typedef ... median_value;
 *     static inline median_value median_least(median_value a, median_value b);
 *     static inline median_value median_greatest(median_value a, median_value b);
 *
 * A network is right when it is right for values that are 0 or 1 (Knuth, The Art of Computer Programming, 5.3.4); the
 * test of the kernels goes through all of these. What a network computes in vain, compilers leave out.
 */
#ifndef IRIS_KERNEL_MEDIAN_H
#define IRIS_KERNEL_MEDIAN_H

static inline void sort2(median_value *low, median_value *high)
{
    median_value least = median_least(*low, *high);
    *high = median_greatest(*low, *high);
    *low = least;
}

static inline void sort3(median_value v[3])
{
    sort2(&v[0], &v[1]);
    sort2(&v[1], &v[2]);
    sort2(&v[0], &v[1]);
}

static inline void sort5(median_value v[5])
{
    sort2(&v[0], &v[1]);
    sort2(&v[3], &v[4]);
    sort2(&v[2], &v[4]);
    sort2(&v[2], &v[3]);
    sort2(&v[0], &v[3]);
    sort2(&v[0], &v[2]);
    sort2(&v[1], &v[4]);
    sort2(&v[1], &v[3]);
    sort2(&v[1], &v[2]);
}

/* Of three columns that are sorted from above to below: the median of the greatest of the lows, the median of the middles,
 * and the least of the highs. */
static inline median_value median9_sorted(const median_value a[3], const median_value b[3],
                                          const median_value c[3])
{
    median_value middles[3] = {a[1], b[1], c[1]};
    sort3(middles);
    median_value three[3] = {median_greatest(median_greatest(a[0], b[0]), c[0]), middles[1],
                             median_least(median_least(a[2], b[2]), c[2])};
    sort3(three);
    return three[1];
}

/* Of three columns, which are sorted first. */
static inline median_value median9(median_value a[3], median_value b[3], median_value c[3])
{
    sort3(a);
    sort3(b);
    sort3(c);
    return median9_sorted(a, b, c);
}

/* Of five columns that are sorted from above to below: rank[r] are their values of rank r. With each rank sorted too,
 * twelve of the 25 have too many certainly above or below them to be the median. Of the other thirteen, and what is
 * known of their order, it is the middle one. */
static inline median_value median25(median_value rank[5][5])
{
    sort5(rank[0]);
    sort5(rank[1]);
    sort5(rank[2]);
    sort5(rank[3]);
    sort5(rank[4]);
    median_value a1 = rank[0][3], a2 = rank[0][4], b1 = rank[1][2], b2 = rank[1][3], b3 = rank[1][4];
    median_value c1 = rank[2][1], c2 = rank[2][2], c3 = rank[2][3];
    median_value d1 = rank[3][0], d2 = rank[3][1], d3 = rank[3][2], e1 = rank[4][0], e2 = rank[4][1];
    sort2(&b2, &d3);
    sort2(&b3, &c1);
    sort2(&c1, &d1);
    sort2(&b1, &e2);
    sort2(&a1, &d2);
    sort2(&a2, &e2);
    sort2(&a2, &b3);
    sort2(&b1, &d2);
    sort2(&b2, &c1);
    sort2(&c3, &d2);
    sort2(&c3, &e1);
    sort2(&c3, &d1);
    sort2(&b3, &c2);
    sort2(&c2, &c3);
    sort2(&b3, &e1);
    sort2(&b3, &c1);
    sort2(&c1, &c2);
    sort2(&c2, &c3);
    sort2(&c2, &e1);
    return c2;
}

#endif
