/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A split is right when its triangles are wound like the polygon and their edges cancel to its rim:
 * the number of triangles over a point is then the polygon's winding number there, 1 inside and 0
 * outside of one that does not cross itself.
 */
#include "polygon.h"
#include "srp_check.h"

#include <string.h>

enum { MOST = 400 };

typedef struct shape {
    size_t count;
    srp_vec3 vertices[MOST];
    srp_corner corners[MOST];
    srp_triangle triangles[MOST];
} shape;

/* How often the edge from a to b is passed, less how often from b to a. */
static int passes(const shape *s, uint32_t a, uint32_t b) {
    int n = 0;
    for (size_t i = 0; i + 2 < s->count; ++i) {
        for (int k = 0; k < 3; ++k) {
            uint32_t from = s->triangles[i].v[k], to = s->triangles[i].v[(k + 1) % 3];
            n += from == a && to == b;
            n -= from == b && to == a;
        }
    }
    return n;
}

static srp_vec3 twice_area(const shape *s, const srp_triangle *t) {
    srp_vec3 a = s->vertices[t->v[0]];
    return srp_vec3_cross(srp_vec3_sub(s->vertices[t->v[1]], a),
                          srp_vec3_sub(s->vertices[t->v[2]], a));
}

/* Splits and checks; `normal` is that of the polygon's plane, 0 when it is not flat. */
static void check_split(shape *s, srp_vec3 normal, double area) {
    for (size_t i = 0; i < s->count; ++i) {
        s->corners[i].vertex = (uint32_t)i;
    }
    memset(s->triangles, 0xff, sizeof s->triangles);
    ck_assert_uint_eq(srp_polygon_split(s->vertices, s->corners, s->count, s->triangles),
                      SRP_POLYGON_FLAWLESS);
    double sum = 0.0;
    for (size_t i = 0; i + 2 < s->count; ++i) {
        srp_vec3 n = twice_area(s, &s->triangles[i]);
        double along = srp_vec3_dot(n, normal);
        ck_assert_msg(along > 0.0, "triangle %zu of %zu is wound backwards (%g)", i, s->count - 2,
                      along);
        sum += 0.5 * along;
    }
    assert_close(sum, area, 1e-12, 0.0);
    for (uint32_t i = 0; i < s->count; ++i) {
        ck_assert_int_eq(passes(s, i, (uint32_t)((i + 1) % s->count)), 1);
    }
    ck_assert_uint_eq(s->triangles[s->count - 2].v[0], UINT32_MAX);
}

/* A random frame: w is the polygon's normal. */
static void random_frame(uint64_t *state, srp_vec3 *u, srp_vec3 *v, srp_vec3 *w) {
    *w = random_direction(state);
    *u = srp_vec3_cross(*w, random_direction(state));
    *u = srp_vec3_scale(1.0 / srp_vec3_norm(*u), *u);
    *v = srp_vec3_cross(*w, *u);
}

static double planar_area(const double (*xy)[2], size_t count) {
    double sum = 0.0;
    for (size_t i = 0; i < count; ++i) {
        size_t j = (i + 1) % count;
        sum += 0.5 * (xy[i][0] * xy[j][1] - xy[i][1] * xy[j][0]);
    }
    return sum;
}

/* Splits a plane polygon at every starting corner, both as it is and turned over, in a random
 * plane. */
static void check_planar(const double (*xy)[2], size_t count) {
    static shape s;
    uint64_t state = count;
    double area = planar_area(xy, count);
    for (size_t start = 0; start < count; ++start) {
        srp_vec3 u, v, w, origin = {12.75, -3.5, 7.125};
        random_frame(&state, &u, &v, &w);
        s.count = count;
        for (size_t i = 0; i < count; ++i) {
            const double *p = xy[(start + i) % count];
            s.vertices[i] = srp_vec3_add_scaled(srp_vec3_add_scaled(origin, p[0], u), p[1], v);
        }
        check_split(&s, w, area);
        for (size_t i = 0; i < count / 2; ++i) {
            srp_vec3 keep = s.vertices[i];
            s.vertices[i] = s.vertices[count - 1 - i];
            s.vertices[count - 1 - i] = keep;
        }
        check_split(&s, srp_vec3_scale(-1.0, w), area);
    }
}

#define CHECK_PLANAR(...)                                                                          \
    do {                                                                                           \
        const double xy_[][2] = {__VA_ARGS__};                                                     \
        check_planar(xy_, sizeof xy_ / sizeof *xy_);                                               \
    } while (0)

START_TEST(small_polygons) {
    CHECK_PLANAR({0, 0}, {3.25, 0.5}, {1, 2.75});
    CHECK_PLANAR({0, 0}, {3.25, 0.5}, {3, 2.5}, {0.25, 2});
    /* Concave: a fan about the wrong corner covers what is outside. */
    CHECK_PLANAR({0, 0}, {4, 0}, {1, 1}, {0, 4});
    CHECK_PLANAR({0, 0}, {4, 0}, {4, 1.5}, {1.25, 1.5}, {1.25, 5}, {0, 5});
    CHECK_PLANAR({0, 0}, {5, 0}, {5, 3}, {4, 3}, {4, 1}, {3, 1}, {3, 3}, {2, 3}, {2, 1}, {1, 1},
                 {1, 3}, {0, 3});
}
END_TEST

/* Corners in the middle of an edge are needed by the neighbour on the other side. */
START_TEST(corners_on_a_line_are_kept) {
    static const double apex[][2] = {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {0.5, 2}};
    static const double square[][2] = {{0, 0}, {1, 0}, {2, 0}, {2, 1},
                                       {2, 2}, {1, 2}, {0, 2}, {0, 1}};
    static shape s;
    for (int axis = 0; axis < 3; ++axis) {
        for (int which = 0; which < 2; ++which) {
            const double(*xy)[2] = which ? square : apex;
            s.count = which ? 8 : 5;
            for (size_t i = 0; i < s.count; ++i) {
                double p[3] = {0.0, 0.0, 0.0};
                p[(axis + 1) % 3] = xy[i][0];
                p[(axis + 2) % 3] = xy[i][1];
                s.vertices[i] = srp_vec3_make(p[0], p[1], p[2]);
            }
            srp_vec3 normal = {axis == 0, axis == 1, axis == 2};
            check_split(&s, normal, which ? 4.0 : 3.0);
        }
    }
}
END_TEST

START_TEST(random_stars) {
    uint64_t state = 20481;
    for (int round = 0; round < 300; ++round) {
        double xy[40][2];
        size_t count = 4 + (size_t)(random_unit(&state) * 36);
        for (size_t i = 0; i < count; ++i) {
            double angle =
                2.0 * 3.14159265358979 * ((double)i + 0.8 * random_unit(&state)) / (double)count;
            double radius = 0.05 + random_unit(&state);
            xy[i][0] = radius * cos(angle);
            xy[i][1] = radius * sin(angle);
        }
        check_planar((const double(*)[2])xy, count);
    }
}
END_TEST

/* Few ears at a time, and corners near foreign edges: there and back along a spiral. */
START_TEST(spiral) {
    enum { HALF = 60 };
    double xy[2 * HALF][2];
    for (int i = 0; i < HALF; ++i) {
        double angle = 0.35 * i, radius = 1.0 + 0.1 * i;
        xy[i][0] = radius * cos(angle);
        xy[i][1] = radius * sin(angle);
        xy[2 * HALF - 1 - i][0] = (radius - 0.4) * cos(angle);
        xy[2 * HALF - 1 - i][1] = (radius - 0.4) * sin(angle);
    }
    /* Outward arm first is counter-clockwise; the area tells. */
    ck_assert(planar_area((const double(*)[2])xy, 2 * HALF) > 0.0);
    check_planar((const double(*)[2])xy, 2 * HALF);
}
END_TEST

/* A square with a square hole, cut open along one edge that is passed both ways. */
START_TEST(hole_with_a_cut) {
    static shape s;
    static const double xy[][2] = {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0},
                                   {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}};
    s.count = 10;
    for (size_t start = 0; start < 10; ++start) {
        for (size_t i = 0; i < 10; ++i) {
            const double *p = xy[(start + i) % 10];
            s.vertices[i] = srp_vec3_make(p[0], p[1], 0.5);
        }
        check_split(&s, srp_vec3_make(0, 0, 1), 12.0);
    }
}
END_TEST

/* Far from the origin and very small or large: nothing is absolute. */
START_TEST(size_and_place_do_not_matter) {
    static shape s;
    static const double dart[][2] = {{0, 0}, {4, 0}, {1, 1}, {0, 4}};
    const double scales[] = {1e-60, 1e-9, 1.0, 1e9, 1e60};
    for (int k = 0; k < 5; ++k) {
        s.count = 4;
        for (size_t i = 0; i < 4; ++i) {
            s.vertices[i] =
                srp_vec3_make(scales[k] * dart[i][0], scales[k] * dart[i][1], scales[k] * 1024.0);
        }
        check_split(&s, srp_vec3_make(0, 0, 1), 4.0 * scales[k] * scales[k]);
    }
}
END_TEST

static unsigned flaws_of(const srp_vec3 *vertices, size_t count) {
    srp_corner corners[16];
    srp_triangle triangles[16];
    for (size_t i = 0; i < count; ++i) {
        corners[i].vertex = (uint32_t)i;
    }
    return srp_polygon_split(vertices, corners, count, triangles);
}

START_TEST(flaws_are_told) {
    const srp_vec3 line[] = {{0, 0, 0}, {1, 2, 3}, {2, 4, 6}, {3, 6, 9}};
    ck_assert_uint_eq(flaws_of(line, 3), SRP_POLYGON_NO_AREA);
    ck_assert_uint_eq(flaws_of(line, 4), SRP_POLYGON_NO_AREA);
    const srp_vec3 point[] = {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}};
    ck_assert_uint_eq(flaws_of(point, 3), SRP_POLYGON_NO_AREA);
    const srp_vec3 bow[] = {{0, 0, 0}, {4, 0, 0}, {1, 2, 0}, {1, -1, 0}};
    ck_assert_uint_eq(flaws_of(bow, 4), SRP_POLYGON_CROSSES);
    srp_vec3 pentagram[5];
    for (int i = 0; i < 5; ++i) {
        double angle = 4.0 * 3.14159265358979 * i / 5.0;
        pentagram[i] = srp_vec3_make(cos(angle), sin(angle), 1.0);
    }
    ck_assert_uint_eq(flaws_of(pentagram, 5), SRP_POLYGON_CROSSES);
    srp_vec3 bent[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0.05}, {0, 1, 0}};
    ck_assert_uint_eq(flaws_of(bent, 4), SRP_POLYGON_NOT_FLAT);
    bent[2].z = 0.001;
    ck_assert_uint_eq(flaws_of(bent, 4), SRP_POLYGON_FLAWLESS);
    /* Overflowing products are no area, not a crash. */
    const srp_vec3 vast[] = {{0, 0, 0}, {1e200, 0, 0}, {1e200, 1e200, 0}, {0, 1e200, 0}};
    ck_assert_uint_ne(flaws_of(vast, 4), SRP_POLYGON_FLAWLESS);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("polygon");
    TCase *tcase = tcase_create("polygon");
    tcase_add_test(tcase, small_polygons);
    tcase_add_test(tcase, corners_on_a_line_are_kept);
    tcase_add_test(tcase, random_stars);
    tcase_add_test(tcase, spiral);
    tcase_add_test(tcase, hole_with_a_cut);
    tcase_add_test(tcase, size_and_place_do_not_matter);
    tcase_add_test(tcase, flaws_are_told);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
