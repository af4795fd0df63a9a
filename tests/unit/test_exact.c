/* SPDX-License-Identifier: Apache-2.0 */
/* Exact visibility: closed forms, surfaces that touch, cut and coincide, and random scenes against
 * an oracle that finds the visible parts another way (visibility_oracle.h). */
#include "model_files.h"
#include "prepared.h"
#include "scene_internal.h"
#include "shapes.h"
#include "srp_check.h"
#include "visibility_oracle.h"

#include <srp/method.h>

#include <string.h>

#define PI 3.14159265358979323846

static const srp_vec3 REFERENCE = {0.13, -0.21, 0.34};
static const srp_optics OPTICS = {0.37, 0.28, false};

static srp_prepared *prepare(const srp_scene *scene, int threads) {
    srp_method_params params = srp_method_params_default();
    params.threads = threads;
    params.reference = REFERENCE;
    return prepare_with(&srp_method_exact, scene, &params);
}

static srp_response respond(const srp_prepared *prepared, srp_vec3 s, srp_basis *basis) {
    srp_response response;
    srp_error error;
    assert_ok(srp_prepared_respond(prepared, 1, &s, &response, basis, &error), error);
    return response;
}

static srp_response respond_scene(const srp_scene *scene, srp_vec3 s) {
    srp_prepared *prepared = prepare(scene, 1);
    srp_response response = respond(prepared, s, NULL);
    srp_prepared_release(prepared);
    return response;
}

/* The facet formula, docs/theory.md: "The force on one facet". */
static srp_vec3 facet_force(srp_vec3 n, double area, srp_optics optics, srp_vec3 s) {
    double c = srp_vec3_dot(n, s);
    if (c <= 0.0) {
        return srp_vec3_make(0, 0, 0);
    }
    srp_vec3 f = srp_vec3_scale(-(1.0 - optics.rho_s) * area * c, s);
    return srp_vec3_add_scaled(f, -2.0 * (optics.rho_s * c + optics.rho_d / 3.0) * area * c, n);
}

/* ---- closed forms ---- */

START_TEST(cube_is_six_plates) {
    srp_optics optics = {0.5, 0.1, false};
    srp_scene *scene = shape_scene(
        shape_box(srp_vec3_make(-1, -1, -1), srp_vec3_make(1, 1, 1), "surface"), optics);
    srp_prepared *prepared = prepare(scene, 1);
    uint64_t seed = 11;
    for (int i = 0; i < 1000; ++i) {
        srp_vec3 s = random_direction(&seed), want = {0, 0, 0};
        for (int axis = 0; axis < 6; ++axis) {
            double sign = axis & 1 ? 1.0 : -1.0;
            srp_vec3 n = srp_vec3_make(axis / 2 == 0 ? sign : 0, axis / 2 == 1 ? sign : 0,
                                       axis / 2 == 2 ? sign : 0);
            want = srp_vec3_add(want, facet_force(n, 4.0, optics, s));
        }
        srp_response response = respond(prepared, s, NULL);
        assert_vec3_close(response.f, want, 1e-14, 0.0);
        assert_close(response.lit_area, 4.0 * (fabs(s.x) + fabs(s.y) + fabs(s.z)), 1e-14, 0.0);
        assert_close(response.f_error, 0.0, 0.0, 0.0);
    }
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
}
END_TEST

START_TEST(special_directions_of_a_cube) {
    srp_scene *scene = shape_scene(
        shape_box(srp_vec3_make(-1, -1, -1), srp_vec3_make(1, 1, 1), "surface"), OPTICS);
    for (int axis = 0; axis < 6; ++axis) {
        double sign = axis & 1 ? 1.0 : -1.0;
        srp_vec3 s = srp_vec3_make(axis / 2 == 0 ? sign : 0, axis / 2 == 1 ? sign : 0,
                                   axis / 2 == 2 ? sign : 0);
        srp_response response = respond_scene(scene, s);
        assert_vec3_close(response.f, facet_force(s, 4.0, OPTICS, s), 1e-15, 0.0);
        /* Light through the centre of the cube: no moment about it. */
        srp_vec3 lever = srp_vec3_scale(-1.0, REFERENCE);
        assert_vec3_close(response.t, srp_vec3_cross(lever, response.f), 1e-14, 1e-15);
    }
    srp_scene_destroy(scene);
}
END_TEST

/* ---- surfaces that touch, coincide, cut ---- */

static const srp_vec3 SQUARE[4] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

/* A unit square in z = `height`, shifted by `x`, wound upwards or downwards. */
static srp_mesh *square(double x, double height, bool up, const char *material) {
    srp_vec3 v[4];
    for (int i = 0; i < 4; ++i) {
        v[i] = srp_vec3_make(SQUARE[i].x + x, SQUARE[i].y, height);
    }
    const srp_triangle t_up[2] = {{{0, 1, 2}}, {{0, 2, 3}}};
    const srp_triangle t_down[2] = {{{0, 2, 1}}, {{0, 3, 2}}};
    return shape_mesh(v, 4, up ? t_up : t_down, 2, material);
}

static void assert_lit(srp_mesh *mesh, srp_vec3 s, double lit) {
    srp_scene *scene = shape_scene(mesh, OPTICS);
    s = srp_vec3_scale(1.0 / srp_vec3_norm(s), s);
    assert_close(respond_scene(scene, s).lit_area, lit, 1e-14, 1e-15);
    srp_scene_destroy(scene);
}

START_TEST(coincident_faces_count_once) {
    srp_vec3 s = srp_vec3_make(0.36, 0.48, 0.8), below = srp_vec3_make(0.36, 0.48, -0.8);
    for (int up = 0; up < 4; ++up) {
        srp_mesh *mesh = square(0, 0.3, up & 1, "a");
        shape_join(mesh, square(0, 0.3, up & 2, "b"));
        assert_lit(mesh, s, 0.8);
        mesh = square(0, 0.3, up & 1, "a");
        shape_join(mesh, square(0, 0.3, up & 2, "b"));
        assert_lit(mesh, below, 0.8);
        /* overlapping by 0.6 */
        mesh = square(0, 0.3, up & 1, "a");
        shape_join(mesh, square(0.4, 0.3, up & 2, "b"));
        assert_lit(mesh, s, 1.4 * 0.8);
    }
}
END_TEST

/* Of coincident faces the one whose outside is lit counts, then the one that comes first. */
START_TEST(coincident_faces_have_an_order) {
    srp_vec3 s = srp_vec3_make(0, 0, 1);
    for (int up = 0; up < 4; ++up) {
        srp_mesh *mesh = square(0, 0.3, up & 1, "a");
        shape_join(mesh, square(0, 0.3, up & 2, "b"));
        srp_scene *scene = shape_scene(mesh, OPTICS);
        srp_prepared *prepared = prepare(scene, 1);
        srp_basis basis[3];
        respond(prepared, s, basis);
        int first = up == 2 ? 1 : 0; /* the first looks down, the second up */
        assert_close(basis[first].a, 1.0, 1e-15, 0.0);
        assert_close(basis[1 - first].a, 0.0, 0.0, 0.0);
        srp_prepared_release(prepared);
        srp_scene_destroy(scene);
    }
}
END_TEST

/* A box that stands on an open foil, seen from the side of the foil's back and front. */
START_TEST(box_on_a_plate) {
    for (int up = 0; up < 2; ++up) {
        srp_mesh *mesh = square(0, 0.0, up, "foil");
        shape_join(mesh,
                   shape_box(srp_vec3_make(0.25, 0.25, 0), srp_vec3_make(0.75, 0.75, 0.5), "box"));
        srp_scene *scene = shape_scene(mesh, OPTICS);
        srp_prepared *prepared = prepare(scene, 1);
        srp_basis basis[3];
        srp_response above = respond(prepared, srp_vec3_make(0, 0, 1), basis);
        assert_close(above.lit_area, 1.0, 1e-15, 0.0);
        assert_close(basis[0].a, 0.75, 1e-15, 0.0);
        assert_close(basis[1].a, 0.25, 1e-15, 0.0);
        srp_response below = respond(prepared, srp_vec3_make(0, 0, -1), basis);
        assert_close(below.lit_area, 1.0, 1e-15, 0.0);
        /* Its bottom faces the Sun; the foil, wound upwards, shows its back and steps behind. */
        assert_close(basis[1].a, up ? 0.25 : 0.0, 1e-15, 0.0);
        srp_prepared_release(prepared);
        srp_scene_destroy(scene);
    }
}
END_TEST

/* Two unit squares that cross at right angles along their middle, lit along the bisector. */
START_TEST(crossing_plates) {
    srp_vec3 a[4] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    srp_vec3 b[4] = {{0, -1, -1}, {0, -1, 1}, {0, 1, 1}, {0, 1, -1}};
    const srp_triangle t[2] = {{{0, 1, 2}}, {{0, 2, 3}}};
    srp_mesh *mesh = shape_mesh(a, 4, t, 2, "a");
    shape_join(mesh, shape_mesh(b, 4, t, 2, "b"));
    srp_scene *scene = shape_scene(mesh, OPTICS);
    srp_prepared *prepared = prepare(scene, 1);
    srp_basis basis[3];
    double h = sqrt(0.5);
    srp_response response = respond(prepared, srp_vec3_make(h, 0, h), basis);
    assert_close(response.lit_area, 2.0 * 2.0 * h, 1e-14, 0.0);
    assert_close(basis[0].a, 2.0 * h, 1e-14, 0.0);
    assert_close(basis[1].a, 2.0 * h, 1e-14, 0.0);
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
}
END_TEST

START_TEST(one_sided_backs_absorb) {
    srp_optics one_sided = {0.37, 0.28, true};
    srp_scene *scene = shape_scene(square(0, 0.3, false, "foil"), one_sided);
    srp_response response = respond_scene(scene, srp_vec3_make(0, 0, 1));
    assert_close(response.back_area, 1.0, 1e-15, 0.0);
    assert_vec3_close(response.f, srp_vec3_make(0, 0, -1), 1e-15, 0.0);
    response = respond_scene(scene, srp_vec3_make(0, 0, -1));
    assert_close(response.back_area, 0.0, 0.0, 0.0);
    assert_vec3_close(response.f,
                      facet_force(srp_vec3_make(0, 0, -1), 1.0, OPTICS, srp_vec3_make(0, 0, -1)),
                      1e-15, 0.0);
    srp_scene_destroy(scene);
}
END_TEST

/* A horizontal panel of 4 m x 4 m and 40 x 40 small squares above it, each casting its shadow on
 * it: the way by which long lists of occluders are divided. */
START_TEST(many_small_shadows_on_one_panel) {
    enum { SIDE = 40, SQUARES = SIDE * SIDE };
    static srp_vec3 v[4 * SQUARES];
    static srp_triangle t[2 * SQUARES];
    const double pitch = 0.08, edge = 0.05, above = 0.3;
    for (uint32_t i = 0; i < SQUARES; ++i) {
        double x = pitch * (i % SIDE) - 1.6, y = pitch * (i / SIDE) - 1.6;
        for (int k = 0; k < 4; ++k) {
            v[4 * i + (uint32_t)k] =
                srp_vec3_make(x + edge * SQUARE[k].x, y + edge * SQUARE[k].y, above);
        }
        t[2 * i] = (srp_triangle){{4 * i, 4 * i + 1, 4 * i + 2}};
        t[2 * i + 1] = (srp_triangle){{4 * i, 4 * i + 2, 4 * i + 3}};
    }
    const srp_vec3 panel[4] = {{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}};
    const srp_triangle halves[2] = {{{0, 1, 2}}, {{0, 2, 3}}};
    srp_mesh *mesh = shape_mesh(panel, 4, halves, 2, "panel");
    shape_join(mesh, shape_mesh(v, 4 * SQUARES, t, 2 * SQUARES, "squares"));
    srp_scene *scene = shape_scene(mesh, OPTICS);
    srp_prepared *prepared = prepare(scene, 1);
    double squares = edge * edge * SQUARES;
    for (int i = 0; i < 5; ++i) {
        /* The shadows move by up to 0.3 and stay on the panel. */
        double tilt = 0.17 * i, az = 0.9 * i;
        srp_vec3 s = srp_vec3_make(sin(tilt) * cos(az), sin(tilt) * sin(az), cos(tilt));
        srp_basis basis[3];
        respond(prepared, s, basis);
        assert_close(basis[1].a, squares * s.z, 1e-12, 0.0);
        assert_close(basis[0].a, (16.0 - squares) * s.z, 1e-12, 0.0);
    }
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
}
END_TEST

/* A panel behind a ring: what is seen through the hole has a hundred corners, more than one piece
 * may have. */
START_TEST(round_hole) {
    enum { SIDES = 100 };
    srp_vec3 v[2 * SIDES];
    srp_triangle t[2 * SIDES];
    const double inner = 0.7;
    for (uint32_t i = 0; i < SIDES; ++i) {
        double a = 2.0 * PI * i / SIDES;
        uint32_t next = (i + 1) % SIDES;
        v[i] = srp_vec3_make(inner * cos(a), inner * sin(a), 0.25);
        v[SIDES + i] = srp_vec3_make(2.0 * cos(a), 2.0 * sin(a), 0.25);
        t[2 * i] = (srp_triangle){{i, SIDES + i, SIDES + next}};
        t[2 * i + 1] = (srp_triangle){{i, SIDES + next, next}};
    }
    const srp_vec3 panel[4] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    const srp_triangle halves[2] = {{{0, 1, 2}}, {{0, 2, 3}}};
    srp_mesh *mesh = shape_mesh(panel, 4, halves, 2, "panel");
    shape_join(mesh, shape_mesh(v, 2 * SIDES, t, 2 * SIDES, "ring"));
    srp_scene *scene = shape_scene(mesh, OPTICS);
    srp_prepared *prepared = prepare(scene, 1);
    double hole = 0.5 * SIDES * inner * inner * sin(2.0 * PI / SIDES);
    double ring = 0.5 * SIDES * 4.0 * sin(2.0 * PI / SIDES) - hole;
    srp_vec3 s = srp_vec3_make(0.36, 0.48, 0.8);
    srp_basis basis[3];
    respond(prepared, s, basis);
    assert_close(basis[1].a, 0.8 * ring, 1e-13, 0.0);
    assert_close(basis[0].a, 0.8 * hole, 1e-13, 0.0);
    /* Seen through the hole: its centre, moved down the light to the panel. */
    srp_vec3 centre = srp_vec3_make(-0.25 * 0.36 / 0.8, -0.25 * 0.48 / 0.8, 0.0);
    srp_vec3 lever = srp_vec3_sub(centre, REFERENCE);
    assert_vec3_close(basis[0].ra, srp_vec3_scale(0.8 * hole, lever), 1e-12, 1e-13);
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
}
END_TEST

/* Three boxes that touch face to face, turned about: coordinates that were equal no longer are. */
START_TEST(touching_boxes_turned) {
    srp_mesh *mesh = shape_box(srp_vec3_make(0, 0, 0), srp_vec3_make(1, 1, 1), "a");
    shape_join(mesh, shape_box(srp_vec3_make(1, 0, 0), srp_vec3_make(2, 1, 1), "b"));
    shape_join(mesh, shape_box(srp_vec3_make(0.5, 0.25, 1), srp_vec3_make(1.5, 0.75, 2), "c"));
    model_file model = {mesh, NULL};
    srp_error error;
    assert_ok(srp_materials_create(&model.materials, &error), error);
    for (size_t i = 0; i < 3; ++i) {
        assert_ok(srp_materials_set(model.materials, srp_mesh_material_name(mesh, i), OPTICS, false,
                                    &error),
                  error);
    }
    srp_scene *scene = model_scene(&model);
    uint64_t seed = 71;
    for (int i = 0; i < 300; ++i) {
        srp_vec3 s = random_direction(&seed);
        turn t = turn_random(&seed);
        srp_scene *turned = model_scene_turned(&model, &t);
        srp_vec3 s_turned = turn_apply(&t, s);
        srp_response want = respond_scene(scene, s), got = respond_scene(turned, s_turned);
        assert_vec3_close(got.f, turn_apply(&t, want.f), 1e-13, 0.0);
        assert_close(got.lit_area, want.lit_area, 1e-13, 0.0);
        srp_scene_destroy(turned);
    }
    srp_scene_destroy(scene);
    model_free(&model);
}
END_TEST

/* ---- against the oracle ---- */

typedef struct soup {
    int triangles_min, triangles_max;
    bool pooled;   /* corners drawn from few: shared edges, shared corners, folds, duplicates */
    bool latticed; /* corners on integers: coplanar, touching, edge-on */
    bool special;  /* Sun along an axis */
    bool thin;     /* some needles */
} soup;

enum { SOUP_MAX = 64, SOUP_MATERIALS = 3 };

static double between(uint64_t *seed, double low, double high) {
    return low + (high - low) * random_unit(seed);
}

static int below(uint64_t *seed, int count) {
    return (int)(random_unit(seed) * count);
}

static srp_scene *soup_scene(const soup *kind, uint64_t *seed) {
    static const char *const names[SOUP_MATERIALS] = {"a", "b", "c"};
    int n = kind->triangles_min + below(seed, kind->triangles_max - kind->triangles_min + 1);
    int corners = kind->pooled ? 4 + below(seed, n) : 3 * n;
    srp_vec3 v[3 * SOUP_MAX];
    for (int i = 0; i < corners; ++i) {
        v[i] = srp_vec3_make(between(seed, -1, 1), between(seed, -1, 1), between(seed, -1, 1));
        if (kind->latticed) {
            v[i] = srp_vec3_make(floor(2.5 * v[i].x + 0.5), floor(2.5 * v[i].y + 0.5),
                                 floor(1.5 * v[i].z + 0.5));
        }
        if (kind->thin && !kind->pooled && i % 9 == 8) {
            v[i] = srp_vec3_add_scaled(v[i - 1], 1e-7, v[i]);
        }
    }
    srp_triangle t[SOUP_MAX];
    uint32_t material[SOUP_MAX];
    for (int i = 0; i < n; ++i) {
        for (int k = 0; k < 3; ++k) {
            t[i].v[k] = (uint32_t)(kind->pooled ? below(seed, corners) : 3 * i + k);
        }
        material[i] = (uint32_t)below(seed, SOUP_MATERIALS);
    }
    /* One that has an area for certain. */
    v[0] = srp_vec3_make(0, 0, 0);
    v[1] = srp_vec3_make(1, 0, 0);
    v[2] = srp_vec3_make(0, 1, 1);
    t[0] = (srp_triangle){{0, 1, 2}};
    srp_mesh *mesh = NULL;
    srp_materials *materials = NULL;
    srp_scene *scene = NULL;
    srp_error error;
    assert_ok(srp_mesh_create(v, (size_t)corners, t, (size_t)n, material, names, SOUP_MATERIALS,
                              &mesh, &error),
              error);
    assert_ok(srp_materials_create(&materials, &error), error);
    for (int i = 0; i < SOUP_MATERIALS; ++i) {
        srp_optics optics = {0.2, 0.1 * i, i == 1};
        assert_ok(srp_materials_set(materials, names[i], optics, false, &error), error);
    }
    assert_ok(srp_scene_from_mesh(mesh, materials, &scene, &error), error);
    srp_materials_destroy(materials);
    srp_mesh_destroy(mesh);
    return scene;
}

static double basis_distance(const srp_basis *a, const srp_basis *b) {
    double d = fabs(a->a - b->a);
    d = fmax(d, srp_vec3_norm(srp_vec3_sub(a->b, b->b)));
    d = fmax(d, srp_vec3_norm(srp_vec3_sub(a->c, b->c)));
    d = fmax(d, srp_vec3_norm(srp_vec3_sub(a->ra, b->ra)));
    d = fmax(d, srp_vec3_norm(srp_vec3_sub(a->rb, b->rb)));
    return fmax(d, srp_vec3_norm(srp_vec3_sub(a->rc, b->rc)));
}

static srp_vec3 soup_direction(const soup *kind, uint64_t *seed) {
    srp_vec3 s = random_direction(seed);
    if (kind->special) {
        int axis = below(seed, 3);
        double sign = below(seed, 2) ? 1.0 : -1.0;
        s = srp_vec3_make(axis == 0 ? sign : 0, axis == 1 ? sign : 0, axis == 2 ? sign : 0);
    }
    return s;
}

static void check_soups(const soup *kind, int count, uint64_t first) {
    for (int i = 0; i < count; ++i) {
        uint64_t seed = first + (uint64_t)i;
        srp_scene *scene = soup_scene(kind, &seed);
        srp_vec3 s = soup_direction(kind, &seed);
        srp_prepared *prepared = prepare(scene, 1);
        srp_basis got[SOUP_MATERIALS + 1], want[SOUP_MATERIALS + 1];
        respond(prepared, s, got);
        oracle_strips(scene, s, REFERENCE, want);
        for (int m = 0; m <= SOUP_MATERIALS; ++m) {
            double off = basis_distance(&got[m], &want[m]) / (scene->radius * scene->radius);
            ck_assert_msg(off <= 1e-12, "seed %d, material %d: off by %.3g of the size", i, m, off);
        }
        srp_prepared_release(prepared);
        srp_scene_destroy(scene);
    }
}

START_TEST(soups_of_separate_triangles) {
    soup small = {3, 12, false, false, false, false}, large = {40, 60, false, false, false, false};
    check_soups(&small, 600, 1000);
    check_soups(&large, 2, 2000);
}
END_TEST

START_TEST(soups_with_shared_corners) {
    soup small = {3, 14, true, false, false, false}, large = {40, 60, true, false, false, false};
    check_soups(&small, 1000, 3000);
    check_soups(&large, 4, 4000);
}
END_TEST

START_TEST(soups_with_needles) {
    soup kind = {3, 12, false, false, false, true};
    check_soups(&kind, 300, 5000);
}
END_TEST

START_TEST(soups_on_a_lattice) {
    soup apart = {3, 12, false, true, false, false}, shared = {3, 16, true, true, false, false};
    check_soups(&apart, 300, 6000);
    check_soups(&shared, 1000, 7000);
}
END_TEST

START_TEST(soups_on_a_lattice_seen_along_it) {
    soup apart = {3, 14, false, true, true, false}, shared = {3, 20, true, true, true, false};
    check_soups(&apart, 600, 8000);
    check_soups(&shared, 1500, 9000);
}
END_TEST

/* Largest difference of the sums of any material, relative to the area that stops light. */
static double off_by(const srp_scene *scene, const srp_basis *got, const srp_basis *want) {
    double off = 0.0, lit = 0.0;
    for (size_t m = 0; m <= scene->material_count; ++m) {
        off = fmax(off, basis_distance(&got[m], &want[m]));
        lit += want[m].a;
    }
    return off / (lit * fmax(1.0, scene->radius));
}

enum { MODEL_MATERIALS = 16 };

static double off_from_strips(const srp_scene *scene, srp_vec3 s) {
    srp_prepared *prepared = prepare(scene, 1);
    srp_basis got[MODEL_MATERIALS], want[MODEL_MATERIALS];
    respond(prepared, s, got);
    oracle_strips(scene, s, REFERENCE, want);
    srp_prepared_release(prepared);
    return off_by(scene, got, want);
}

/* Small models against strips, which are exact; large ones against lines, which converge. */
START_TEST(models_agree_with_the_oracle) {
    model_file model = model_read(MODEL_NAMES[_i]);
    srp_scene *scene = model_scene(&model);
    ck_assert_uint_lt(scene->material_count, MODEL_MATERIALS);
    uint64_t seed = 500 + (uint64_t)_i;
    if (scene->facet_count <= 80) {
        for (int i = 0; i < 4; ++i) {
            double off = off_from_strips(scene, random_direction(&seed));
            printf("%s: off the strips by %.1e\n", MODEL_NAMES[_i], off);
            ck_assert(off < 1e-12);
        }
    } else {
        srp_prepared *prepared = prepare(scene, 1);
        srp_basis got[MODEL_MATERIALS], want[MODEL_MATERIALS];
        srp_vec3 s = random_direction(&seed);
        respond(prepared, s, got);
        double off[2];
        for (int k = 0; k < 2; ++k) {
            oracle_lines(scene, s, REFERENCE, k == 0 ? 150 : 1200, want);
            off[k] = off_by(scene, got, want);
        }
        printf("%s: off 150 lines by %.1e, 1,200 by %.1e\n", MODEL_NAMES[_i], off[0], off[1]);
        ck_assert(off[1] < 1e-4 && off[1] < off[0] / 8.0);
        srp_prepared_release(prepared);
    }
    srp_scene_destroy(scene);
    model_free(&model);
}
END_TEST

/* Poles, el = 0, diagonals: edges lie over edges and faces are edge-on. */
START_TEST(special_directions_of_a_box_wing) {
    model_file model = model_read("box-wing");
    srp_scene *scene = model_scene(&model);
    for (int i = 0; i < 27; ++i) {
        srp_vec3 s = srp_vec3_make(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
        if (i == 13) {
            continue;
        }
        s = srp_vec3_scale(1.0 / srp_vec3_norm(s), s);
        double off = off_from_strips(scene, s);
        ck_assert_msg(off < 1e-12, "direction %d: off by %.3g", i, off);
    }
    srp_scene_destroy(scene);
    model_free(&model);
}
END_TEST

/* The Sun a little above and below the plane of a panel, down to rounding. */
START_TEST(nearly_edge_on) {
    model_file model = model_read("box-wing");
    srp_scene *scene = model_scene(&model);
    for (int k = 1; k <= 17; ++k) {
        for (int sign = -1; sign <= 1; sign += 2) {
            double tilt = sign * pow(10.0, -k);
            srp_vec3 s = srp_vec3_make(sin(tilt), 0.6 * cos(tilt), 0.8 * cos(tilt));
            double off = off_from_strips(scene, s);
            ck_assert_msg(off < 1e-12, "tilt %g: off by %.3g", tilt, off);
        }
    }
    srp_scene_destroy(scene);
    model_free(&model);
}
END_TEST

/* Tolerances are relative to the mesh: in units of a power of two the same bits come out. */
START_TEST(size_does_not_matter) {
    const soup kind = {20, 40, true, true, false, false};
    for (int i = 0; i < 40; ++i) {
        uint64_t seed = 900 + (uint64_t)i;
        srp_scene *scene = soup_scene(&kind, &seed);
        srp_vec3 s = random_direction(&seed);
        double lit = respond_scene(scene, s).lit_area;
        for (int power = -24; power <= 48; power += 72) { /* smaller, then larger */
            double unit = ldexp(1.0, power);
            for (size_t k = 0; k < scene->vertex_count; ++k) {
                scene->vertices[k] = srp_vec3_scale(unit, scene->vertices[k]);
            }
            for (size_t k = 0; k < scene->facet_count; ++k) {
                scene->facets[k].area *= unit * unit;
            }
            scene->centre = srp_vec3_scale(unit, scene->centre);
            scene->radius *= unit;
            lit *= unit * unit;
            assert_close(respond_scene(scene, s).lit_area, lit, 0.0, 0.0);
        }
        srp_scene_destroy(scene);
    }
}
END_TEST

/* ---- the same bits however it is asked ---- */

START_TEST(direction_alone_decides) {
    enum { COUNT = 40 };
    model_file model = model_read("dish");
    srp_scene *scene = model_scene(&model);
    srp_prepared *one = prepare(scene, 1), *many = prepare(scene, 5);
    static srp_vec3 s[COUNT];
    static srp_response forward[COUNT], backward[COUNT];
    srp_error error;
    uint64_t seed = 81;
    for (int i = 0; i < COUNT; ++i) {
        s[i] = random_direction(&seed);
    }
    assert_ok(srp_prepared_respond(many, COUNT, s, forward, NULL, &error), error);
    for (int i = COUNT; i-- > 0;) {
        backward[i] = respond(one, s[i], NULL);
    }
    ck_assert_mem_eq(forward, backward, sizeof forward);
    srp_prepared_release(one);
    srp_prepared_release(many);
    srp_scene_destroy(scene);
    model_free(&model);
}
END_TEST

/* ---- what it refuses ---- */

START_TEST(plates_are_refused) {
    const srp_plate plate = {{0, 0, 1}, 1.0, {0.2, 0.3, false}};
    srp_method_params params = srp_method_params_default();
    srp_scene *scene = NULL;
    srp_prepared *prepared = NULL;
    srp_error error;
    assert_ok(srp_scene_from_plates(&plate, 1, &scene, &error), error);
    ck_assert_int_eq(srp_method_prepare(&srp_method_exact, scene, &params, &prepared, &error),
                     SRP_UNSUPPORTED);
    ck_assert_ptr_null(prepared);
    srp_scene_destroy(scene);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("exact");
    TCase *forms = tcase_create("closed forms");
    tcase_add_test(forms, cube_is_six_plates);
    tcase_add_test(forms, special_directions_of_a_cube);
    tcase_add_test(forms, plates_are_refused);
    suite_add_tcase(suite, forms);
    TCase *touching = tcase_create("touching");
    tcase_add_test(touching, coincident_faces_count_once);
    tcase_add_test(touching, coincident_faces_have_an_order);
    tcase_add_test(touching, box_on_a_plate);
    tcase_add_test(touching, crossing_plates);
    tcase_add_test(touching, one_sided_backs_absorb);
    tcase_add_test(touching, many_small_shadows_on_one_panel);
    tcase_add_test(touching, round_hole);
    tcase_add_test(touching, touching_boxes_turned);
    tcase_add_test(touching, direction_alone_decides);
    tcase_add_test(touching, size_does_not_matter);
    tcase_set_timeout(touching, 120);
    suite_add_tcase(suite, touching);
    TCase *oracle = tcase_create("oracle");
    tcase_set_timeout(oracle, 300);
    tcase_add_test(oracle, soups_of_separate_triangles);
    tcase_add_test(oracle, soups_with_shared_corners);
    tcase_add_test(oracle, soups_with_needles);
    tcase_add_test(oracle, soups_on_a_lattice);
    tcase_add_test(oracle, soups_on_a_lattice_seen_along_it);
    tcase_add_test(oracle, special_directions_of_a_box_wing);
    tcase_add_test(oracle, nearly_edge_on);
    tcase_add_loop_test(oracle, models_agree_with_the_oracle, 0, (int)MODEL_COUNT);
    suite_add_tcase(suite, oracle);
    return run_suite(suite);
}
