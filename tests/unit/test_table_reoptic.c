/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Tables for other optics from sums per material: against tables traced anew, partials against
 * differences, errors of sampled sums against the truth, and all that is refused.
 */
#include "gmat_spo_rules.h"
#include "model_files.h"
#include "srp_check.h"
#include "table_fixture.h"
#include "table_internal.h"

#include <string.h>

/* Moments are taken about a point off the models, so that every lever arm counts. */
static const srp_vec3 REFERENCE = {0.377, -1.213, 0.851};

/* ---- Scenes and tables of random optics ------------------------------------------------------ */

static srp_optics random_optics(uint64_t *state, bool one_sided) {
    double rho_s = random_unit(state), rho_d = (1.0 - rho_s) * random_unit(state);
    return (srp_optics){rho_s, rho_d, one_sided};
}

static srp_materials *no_materials(void) {
    srp_materials *materials;
    srp_error error;
    assert_ok(srp_materials_create(&materials, &error), error);
    return materials;
}

static void set_optics(srp_materials *materials, const char *name, srp_optics optics) {
    srp_error error;
    assert_ok(srp_materials_set(materials, name, optics, true, &error), error);
}

/* Random optics for all of a mesh; every second material has one side. */
static srp_materials *random_materials(const srp_mesh *mesh, uint64_t *state) {
    srp_materials *materials = no_materials();
    for (size_t m = 0; m < srp_mesh_material_count(mesh); ++m) {
        set_optics(materials, srp_mesh_material_name(mesh, m), random_optics(state, m % 2 == 0));
    }
    return materials;
}

static srp_scene *scene_of(const srp_mesh *mesh, const srp_materials *materials) {
    srp_scene *scene;
    srp_error error;
    assert_ok(srp_scene_from_mesh(mesh, materials, &scene, &error), error);
    return scene;
}

static srp_method_params off_origin(void) {
    srp_method_params params = fixture_params(1);
    params.reference = REFERENCE;
    return params;
}

static srp_table *trace(const srp_method *method, const srp_scene *scene,
                        const srp_method_params *params, srp_grid grid) {
    srp_prepared *prepared;
    srp_table *table;
    srp_error error;
    assert_ok(srp_method_prepare(method, scene, params, &prepared, &error), error);
    assert_ok(srp_table_create(prepared, grid, true, &table, &error), error);
    assert_ok(srp_table_describe(table, "a model", "srp table of old", srp_sunlight_default(),
                                 850.0, &error),
              error);
    assert_ok(srp_table_fill(table, prepared, NULL, &error), error);
    srp_prepared_release(prepared);
    return table;
}

static srp_table *reoptic(const srp_table *table, const srp_materials *materials, bool keep) {
    srp_table *out = NULL;
    srp_error error;
    assert_ok(srp_table_reoptic(table, materials, keep, &out, &error), error);
    return out;
}

/* Largest distance of f (over |f|) and of t (over |f| times `size`) between two tables. */
static void compare(const srp_table *got, const srp_table *want, double size, double *f_off,
                    double *t_off) {
    for (size_t k = 0; k < srp_grid_node_count(want->grid); ++k) {
        const srp_response *a = &got->nodes[k], *b = &want->nodes[k];
        /* Plates seen edge-on catch nothing. */
        double scale = srp_vec3_norm(b->f) > 0.0 ? srp_vec3_norm(b->f) : 1.0;
        ck_assert(got->filled[k] && want->filled[k]);
        *f_off = fmax(*f_off, srp_vec3_norm(srp_vec3_sub(a->f, b->f)) / scale);
        *t_off = fmax(*t_off, srp_vec3_norm(srp_vec3_sub(a->t, b->t)) / (scale * size));
        ck_assert(a->f_error == 0.0 && a->t_error == 0.0);
        assert_close(a->lit_area, b->lit_area, 1e-13, 0.0);
        assert_close(a->back_area, b->back_area, 1e-13, 1e-13);
    }
}

/* ---- Other optics are what a fresh trace gives ------------------------------------------------
 */

/* The last, of 27,052 triangles, in the long run only. */
static const char *const SHAPES[] = {"box-wing", "dish", "sun-shield", "l-corner", "gnss"};
enum { SHAPE_COUNT = sizeof SHAPES / sizeof SHAPES[0], OPTICS = 20 };

START_TEST(other_optics_equal_a_fresh_table) {
    model_file model = model_read(SHAPES[_i]);
    uint64_t random = 71 + (uint64_t)_i;
    srp_method_params params = off_origin();
    srp_grid grid = grid_of(60.0, 45.0);
    srp_materials *first = random_materials(model.mesh, &random);
    srp_scene *scene = scene_of(model.mesh, first);
    srp_table *table = trace(&srp_method_exact, scene, &params, grid), *last = NULL;
    double f_off = 0.0, t_off = 0.0, back = 0.0;
    for (int k = 0; k < OPTICS; ++k) {
        srp_materials *materials = random_materials(model.mesh, &random);
        srp_scene *other = scene_of(model.mesh, materials);
        srp_table *fresh = trace(&srp_method_exact, other, &params, grid);
        /* Each from the one before: that works again and again. */
        srp_table *got = reoptic(last != NULL ? last : table, materials, false);
        compare(got, fresh, srp_scene_radius(scene), &f_off, &t_off);
        ck_assert_str_eq(got->info.optics_hash, srp_scene_optics_hash(other));
        ck_assert_str_eq(got->info.traced_optics_hash, srp_scene_optics_hash(scene));
        srp_table_destroy(last);
        srp_table_destroy(fresh);
        srp_scene_destroy(other);
        srp_materials_destroy(materials);
        last = got;
    }
    for (size_t k = 0; k < srp_grid_node_count(grid); ++k) {
        back = fmax(back, table->nodes[k].back_area);
    }
    printf("%s: %d optics, %zu nodes, backs up to %.3g m^2: f off by %.2e, t by %.2e\n", SHAPES[_i],
           OPTICS, srp_grid_node_count(grid), back, f_off, t_off);
    ck_assert(f_off <= 1e-13);
    ck_assert(t_off <= 1e-13);
    srp_table_destroy(last);
    srp_table_destroy(table);
    srp_scene_destroy(scene);
    srp_materials_destroy(first);
    model_free(&model);
}
END_TEST

/* Of plates, which have no moment. */
START_TEST(plates_can_be_given_other_optics) {
    table_fixture fixture = fixture_create(&srp_method_nplate, NULL);
    const srp_plate plates[] = {{{0.0, 0.6, 0.8}, 2.0, {0.17, 0.29, false}},
                                {{0.0, 0.0, -1.0}, 3.0, {0.1, 0.7, true}}};
    srp_method_params params = fixture_params(1);
    srp_grid grid = grid_of(30.0, 30.0);
    srp_table *table = trace(&srp_method_nplate, fixture.scene, &params, grid);
    srp_scene *scene;
    srp_error error;
    assert_ok(srp_scene_from_plates(plates, 2, &scene, &error), error);
    srp_table *fresh = trace(&srp_method_nplate, scene, &params, grid);
    srp_materials *materials = no_materials();
    set_optics(materials, "plate 1", plates[0].optics);
    srp_table *got = reoptic(table, materials, false);
    ck_assert(!got->info.has_moment);
    ck_assert_str_eq(got->info.optics_hash, fresh->info.optics_hash);
    for (size_t k = 0; k < srp_grid_node_count(grid); ++k) {
        assert_vec3_close(got->nodes[k].f, fresh->nodes[k].f, 1e-14, 0.0);
    }
    srp_table_destroy(table);
    srp_table_destroy(fresh);
    srp_table_destroy(got);
    srp_materials_destroy(materials);
    srp_scene_destroy(scene);
    fixture_destroy(fixture);
}
END_TEST

/* ---- Partials ---------------------------------------------------------------------------------
 */

typedef struct response_pair {
    srp_vec3 f, t;
} response_pair;

/* What a fresh trace gives when one material has other shares. */
static response_pair ask(const model_file *model, const srp_materials *materials, const char *name,
                         srp_optics optics, srp_vec3 s) {
    srp_materials *changed = no_materials();
    for (size_t m = 0; m < srp_materials_count(materials); ++m) {
        srp_optics own = {0.0, 0.0, false};
        const char *each = srp_materials_name(materials, m);
        ck_assert(srp_materials_find(materials, each, &own));
        set_optics(changed, each, strcmp(each, name) == 0 ? optics : own);
    }
    srp_scene *scene = scene_of(model->mesh, changed);
    srp_method_params params = off_origin();
    srp_prepared *prepared;
    srp_response got;
    srp_error error;
    assert_ok(srp_method_prepare(&srp_method_exact, scene, &params, &prepared, &error), error);
    assert_ok(srp_prepared_respond(prepared, 1, &s, &got, NULL, &error), error);
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
    srp_materials_destroy(changed);
    return (response_pair){got.f, got.t};
}

static double slope_error(srp_vec3 high, srp_vec3 low, double step, srp_vec3 partial) {
    srp_vec3 slope = srp_vec3_scale(1.0 / (2.0 * step), srp_vec3_sub(high, low));
    return srp_vec3_norm(srp_vec3_sub(slope, partial));
}

enum { MATERIAL_ROOM = 16 };

/* Largest error, and largest partial, of all materials with the Sun at `s`. */
static void check_partials(const model_file *model, const srp_materials *materials,
                           const srp_prepared *prepared, srp_vec3 s, double *worst,
                           double *largest) {
    const double step = 1e-3;
    const srp_scene *scene = srp_prepared_scene(prepared);
    srp_basis basis[MATERIAL_ROOM];
    srp_response got;
    srp_error error;
    ck_assert_uint_lt(srp_scene_material_count(scene), MATERIAL_ROOM);
    assert_ok(srp_prepared_respond(prepared, 1, &s, &got, basis, &error), error);
    for (size_t m = 0; m < srp_scene_material_count(scene); ++m) {
        const char *name = srp_scene_material_name(scene, m);
        srp_optics up = srp_scene_material_optics(scene, m);
        srp_partials p;
        srp_basis_partials(&basis[m], s, &p);
        /* Well within the triangle of shares. */
        up.rho_s = 0.1 + 0.5 * up.rho_s;
        up.rho_d = 0.1 + 0.2 * up.rho_d;
        srp_optics down = up;
        up.rho_s += step;
        down.rho_s -= step;
        response_pair high = ask(model, materials, name, up, s);
        response_pair low = ask(model, materials, name, down, s);
        *worst = fmax(*worst, slope_error(high.f, low.f, step, p.f_rho_s));
        *worst = fmax(*worst, slope_error(high.t, low.t, step, p.t_rho_s));
        up.rho_s = down.rho_s;
        up.rho_d += step;
        down.rho_d -= step;
        high = ask(model, materials, name, up, s);
        low = ask(model, materials, name, down, s);
        *worst = fmax(*worst, slope_error(high.f, low.f, step, p.f_rho_d));
        *worst = fmax(*worst, slope_error(high.t, low.t, step, p.t_rho_d));
        *largest = fmax(*largest, fmax(srp_vec3_norm(p.f_rho_s), srp_vec3_norm(p.t_rho_d)));
    }
}

START_TEST(partials_are_central_differences) {
    model_file model = model_read(SHAPES[_i]);
    uint64_t random = 5 + (uint64_t)_i;
    srp_materials *materials = random_materials(model.mesh, &random);
    srp_scene *scene = scene_of(model.mesh, materials);
    srp_method_params params = off_origin();
    srp_prepared *prepared;
    srp_error error;
    assert_ok(srp_method_prepare(&srp_method_exact, scene, &params, &prepared, &error), error);
    double worst = 0.0, largest = 0.0;
    srp_vec3 s = random_direction(&random);
    check_partials(&model, materials, prepared, s, &worst, &largest);
    check_partials(&model, materials, prepared, srp_vec3_scale(-1.0, s), &worst, &largest);
    printf("%s: partials off by %.2e of up to %.3g\n", SHAPES[_i], worst, largest);
    ck_assert(largest > 0.1);
    ck_assert(worst <= 1e-6 * largest);
    srp_prepared_release(prepared);
    srp_scene_destroy(scene);
    srp_materials_destroy(materials);
    model_free(&model);
}
END_TEST

/* ---- Light that was reflected before ----------------------------------------------------------
 */

START_TEST(reflected_light_is_refused_or_kept) {
    model_file model = model_read("l-corner");
    srp_method_params params = off_origin();
    params.lattice.samples = 16;
    params.diffuse = 2;
    srp_grid grid = grid_of(60.0, 45.0);
    srp_materials *old = no_materials(), *new = no_materials();
    const char *name = srp_mesh_material_name(model.mesh, 0);
    set_optics(old, name, (srp_optics){0.31, 0.53, false});
    set_optics(new, name, (srp_optics){0.11, 0.07, false});
    srp_scene *scene = scene_of(model.mesh, old), *other = scene_of(model.mesh, new);
    srp_table *traced = trace(&srp_method_raytrace, scene, &params, grid), *untouched = NULL;
    srp_table *direct = trace(&srp_method_exact, other, &params, grid);
    srp_error error;
    ck_assert_int_eq(srp_table_reoptic(traced, new, false, &untouched, &error), SRP_UNSUPPORTED);
    ck_assert_ptr_null(untouched);
    ck_assert(strstr(error.message, "only its direct part") != NULL);

    srp_table *kept = reoptic(traced, new, true);
    ck_assert(kept->info.has_bounce && kept->info.bounce_kept);
    double bounced = 0.0;
    for (size_t k = 0; k < srp_grid_node_count(grid); ++k) {
        const srp_response *got = &kept->nodes[k], *before = &traced->nodes[k];
        ck_assert_mem_eq(&got->f_bounce, &before->f_bounce, sizeof got->f_bounce);
        ck_assert_mem_eq(&got->t_bounce, &before->t_bounce, sizeof got->t_bounce);
        ck_assert(got->f_error == before->f_error && got->unresolved == before->unresolved);
        assert_vec3_close(srp_vec3_sub(got->f, got->f_bounce), direct->nodes[k].f, 1e-13, 1e-15);
        assert_vec3_close(srp_vec3_sub(got->t, got->t_bounce), direct->nodes[k].t, 1e-13, 1e-14);
        bounced = fmax(bounced, srp_vec3_norm(got->f_bounce));
    }
    ck_assert(bounced > 0.05);
    /* And back: the numbers of the trace to the bit, but the table does not pass for it. */
    srp_table *back = reoptic(kept, old, true);
    ck_assert_mem_eq(back->nodes, traced->nodes, srp_grid_node_count(grid) * sizeof *back->nodes);
    ck_assert_str_eq(back->info.optics_hash, traced->info.optics_hash);
    ck_assert_str_eq(back->info.traced_optics_hash, traced->info.optics_hash);
    srp_table_destroy(back);
    srp_table_destroy(kept);
    srp_table_destroy(direct);
    srp_table_destroy(traced);
    srp_scene_destroy(scene);
    srp_scene_destroy(other);
    srp_materials_destroy(old);
    srp_materials_destroy(new);
    model_free(&model);
}
END_TEST

/* ---- Sampled sums ------------------------------------------------------------------------------
 */

static int by_size(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

enum { SAMPLED_ROOM = 20000 };

/* How much of it; main() asks for more on request. */
static int sampled_tables = 2;
static double sampled_az_step = 60.0, sampled_el_step = 30.0;

/* True error over estimated error at every node of tables that were sampled under optics of the
 * kind `old` and given others. */
static size_t sampled_ratios(const char *name, int old, double *ratio, double *growth) {
    model_file model = model_read(name);
    srp_grid grid = grid_of(sampled_az_step, sampled_el_step);
    srp_method_params params = off_origin();
    params.lattice.samples = 64;
    srp_scene *scene = model_scene(&model);
    srp_table *exact = trace(&srp_method_exact, scene, &params, grid);
    uint64_t random = 17;
    size_t count = 0, nodes = srp_grid_node_count(grid);
    for (int n = 0; n < sampled_tables; ++n) {
        const srp_optics alike[] = {{0.0, 0.0, false}, {0.2, 0.3, false}, {0.9, 0.05, false}};
        srp_materials *materials = no_materials();
        srp_scene *from = old < 3 ? model_scene_painted(&model, alike[old]) : NULL;
        srp_materials *before = no_materials();
        for (size_t m = 0; m < srp_mesh_material_count(model.mesh); ++m) {
            const char *each = srp_mesh_material_name(model.mesh, m);
            set_optics(before, each, random_optics(&random, false));
            set_optics(materials, each, random_optics(&random, false));
        }
        from = from != NULL ? from : scene_of(model.mesh, before);
        params.seed = (uint64_t)n;
        srp_table *sampled = trace(&srp_method_raycast, from, &params, grid);
        srp_table *truth = reoptic(exact, materials, false);
        srp_table *got = reoptic(sampled, materials, false);
        for (size_t k = 0; k < nodes; ++k) {
            const srp_response *a = &got->nodes[k], *b = &truth->nodes[k];
            ck_assert(a->f_error >= sampled->nodes[k].f_error && isfinite(a->t_error));
            ck_assert_uint_lt(count, SAMPLED_ROOM);
            growth[count] = a->f_error / sampled->nodes[k].f_error;
            ratio[count++] = srp_vec3_norm(srp_vec3_sub(a->f, b->f)) / a->f_error;
        }
        srp_table_destroy(sampled);
        srp_table_destroy(truth);
        srp_table_destroy(got);
        srp_scene_destroy(from);
        srp_materials_destroy(materials);
        srp_materials_destroy(before);
    }
    srp_table_destroy(exact);
    srp_scene_destroy(scene);
    model_free(&model);
    qsort(ratio, count, sizeof *ratio, by_size);
    qsort(growth, count, sizeof *growth, by_size);
    return count;
}

enum { SAMPLED_MODELS = 5 };

START_TEST(errors_of_sampled_sums_stay_honest) {
    static const char *const MODELS[SAMPLED_MODELS] = {"box-wing", "dish", "sun-shield",
                                                       "icosphere-320", "gnss"};
    static const char *const OLD[] = {"black", "grey", "mirrors", "random"};
    static double ratio[SAMPLED_ROOM], growth[SAMPLED_ROOM];
    const char *name = MODELS[_i / 4];
    size_t count = sampled_ratios(name, _i % 4, ratio, growth), below2 = 0, below3 = 0;
    for (size_t k = 0; k < count; ++k) {
        below2 += ratio[k] < 2.0;
        below3 += ratio[k] < 3.0;
    }
    printf("%-13s from %-7s: %zu nodes, errors x %.2f (median), below 2: %.1f %%, below 3: %.1f "
           "%%, median ratio %.2f, largest %.2f\n",
           name, OLD[_i % 4], count, growth[count / 2], 100.0 * (double)below2 / (double)count,
           100.0 * (double)below3 / (double)count, ratio[count / 2], ratio[count - 1]);
    ck_assert((double)below3 >= 0.97 * (double)count);
}
END_TEST

/* Nothing changes, nothing grows; and the tolerance is judged by the new numbers. */
START_TEST(notes_and_errors_follow_the_optics) {
    model_file model = model_read("cube");
    srp_method_params params = off_origin();
    params.lattice.samples = 32;
    const char *name = srp_mesh_material_name(model.mesh, 0);
    srp_materials *old = no_materials(), *new = no_materials(), *none = no_materials();
    set_optics(old, name, (srp_optics){0.95, 0.0, false});
    set_optics(new, name, (srp_optics){0.05, 0.0, false});
    srp_scene *scene = scene_of(model.mesh, old);
    srp_table *traced = trace(&srp_method_raycast, scene, &params, grid_of(30.0, 30.0));
    size_t count = srp_grid_node_count(traced->grid), missed = 0;
    /* A tolerance that all of its nodes meet. */
    double *tolerance = &traced->info.params.tolerance;
    *tolerance = 0.0;
    for (size_t k = 0; k < count; ++k) {
        const srp_response *node = &traced->nodes[k];
        *tolerance = fmax(*tolerance, 1.001 * node->f_error / srp_vec3_norm(node->f));
    }
    srp_table *same = reoptic(traced, none, false), *other = reoptic(traced, new, false);
    ck_assert_mem_eq(same->nodes, traced->nodes, count * sizeof *same->nodes);
    ck_assert_str_eq(same->info.optics_hash, traced->info.optics_hash);
    for (size_t k = 0; k < count; ++k) {
        const srp_response *got = &other->nodes[k], *before = &traced->nodes[k];
        bool flagged = (got->flags & SRP_RESPONSE_TOLERANCE_MISSED) != 0;
        ck_assert(flagged == (got->f_error > *tolerance * srp_vec3_norm(got->f)));
        ck_assert(got->f_error > before->f_error && got->samples == before->samples);
        assert_close(got->t_error / got->f_error, before->t_error / before->f_error, 1e-14, 0.0);
        missed += flagged && (before->flags & SRP_RESPONSE_TOLERANCE_MISSED) == 0;
    }
    ck_assert_uint_gt(missed, 0);
    srp_table_destroy(traced);
    srp_table_destroy(same);
    srp_table_destroy(other);
    srp_scene_destroy(scene);
    srp_materials_destroy(old);
    srp_materials_destroy(new);
    srp_materials_destroy(none);
    model_free(&model);
}
END_TEST

/* ---- What is refused, and what the files say ---------------------------------------------------
 */

static void assert_unsupported(const srp_table *table, const srp_materials *materials,
                               srp_status expected, const char *words) {
    srp_table *untouched = NULL;
    srp_error error;
    srp_status status = srp_table_reoptic(table, materials, false, &untouched, &error);
    ck_assert_msg(status == expected, "%s: status '%s'", words, srp_status_string(status));
    ck_assert_int_eq(error.status, expected);
    ck_assert_msg(strstr(error.message, words) != NULL, "'%s' lacks '%s'", error.message, words);
    ck_assert_ptr_null(untouched);
}

START_TEST(what_cannot_be_given_other_optics_is_refused) {
    model_file model = model_read("box-wing");
    srp_method_params params = off_origin();
    srp_grid grid = grid_of(90.0, 90.0);
    srp_scene *scene = model_scene(&model);
    srp_materials *materials = no_materials(), *one_sided = no_materials();
    srp_table *table = trace(&srp_method_exact, scene, &params, grid);
    set_optics(materials, "cells", (srp_optics){0.2, 0.1, false});
    set_optics(one_sided, "cells", (srp_optics){0.2, 0.1, true});
    assert_unsupported(table, one_sided, SRP_UNSUPPORTED, "'cells' has two sides");
    set_optics(materials, "Cells", (srp_optics){0.2, 0.1, false});
    assert_unsupported(table, materials, SRP_NOT_FOUND,
                       "no material 'Cells'; its materials are: 'bus', 'panel_back', 'cells', "
                       "'boom'");
    srp_table_destroy(table);

    /* Another window than the model needs. */
    params.lattice.kind = SRP_LATTICE_WINDOW;
    params.lattice.columns = params.lattice.rows = 64;
    memcpy(params.lattice.window, (double[]){-1.0, 1.0, -1.0, 1.0}, sizeof params.lattice.window);
    table = trace(&srp_method_raycast, scene, &params, grid);
    srp_materials *none = no_materials();
    assert_unsupported(table, none, SRP_UNSUPPORTED, "outside the sampled window");
    srp_table_destroy(table);

    /* Without sums. */
    srp_prepared *prepared;
    srp_error error;
    assert_ok(srp_method_prepare(&srp_method_exact, scene, &params, &prepared, &error), error);
    assert_ok(srp_table_create(prepared, grid, false, &table, &error), error);
    assert_unsupported(table, none, SRP_UNSUPPORTED, "make it anew with them");
    srp_prepared_release(prepared);
    srp_table_destroy(table);
    srp_materials_destroy(materials);
    srp_materials_destroy(one_sided);
    srp_materials_destroy(none);
    srp_scene_destroy(scene);
    model_free(&model);
}
END_TEST

/* Nodes that are not there stay so, and nobody fills them with something else. */
START_TEST(a_partial_table_stays_partial) {
    table_fixture fixture = fixture_create(&noise_method, NULL);
    srp_table *table = noise_table(&fixture, grid_of(90.0, 45.0), true), *filled = NULL;
    table->filled[3] = 0;
    table->filled_count -= 1;
    srp_materials *none = no_materials();
    srp_table *got = reoptic(table, none, true);
    ck_assert_uint_eq(got->filled_count, table->filled_count);
    ck_assert(!got->filled[3] && got->filled[4]);
    srp_error error;
    ck_assert_int_eq(srp_table_fill(got, fixture.prepared, NULL, &error), SRP_MISMATCH);
    ck_assert(strstr(error.message, "other optics than it was traced with") != NULL);
    /* A table whose optics no hash was ever stored of. */
    assert_ok(srp_table_set_text(&table->info.optics_hash, "", 0, &error), error);
    filled = reoptic(table, none, true);
    ck_assert_str_eq(filled->info.traced_optics_hash, got->info.traced_optics_hash);
    srp_table_destroy(filled);
    srp_table_destroy(got);
    srp_table_destroy(table);
    srp_materials_destroy(none);
    fixture_destroy(fixture);
}
END_TEST

START_TEST(files_tell_where_the_numbers_are_from) {
    table_fixture fixture = fixture_create(&noise_method, NULL);
    srp_table *table = noise_table(&fixture, grid_of(90.0, 45.0), true), *back = NULL;
    srp_materials *materials = no_materials();
    set_optics(materials, "plate 2", (srp_optics){0.25, 0.5, true});
    srp_table *got = reoptic(table, materials, true);
    ck_assert_str_eq(got->info.command_line, "");
    ck_assert_str_eq(got->info.traced_command_line, table->info.command_line);
    ck_assert_str_eq(got->info.traced_optics_hash, table->info.optics_hash);
    ck_assert_str_ne(got->info.optics_hash, table->info.optics_hash);
    ck_assert_str_eq(got->info.title, table->info.title);
    ck_assert(got->material_optics[1].rho_d == 0.5 && got->material_optics[1].one_sided);
    ck_assert(got->material_optics[0].rho_s == 0.3);
    srp_error error;
    assert_ok(srp_table_write(got, &srp_table_format_netcdf, "scratch_reoptic.nc", &error), error);
    assert_ok(srp_table_read(&srp_table_format_netcdf, "scratch_reoptic.nc", &back, &error), error);
    assert_same_table(back, got);
    remove("scratch_reoptic.nc");
    const srp_table_format *texts[] = {&srp_table_format_spo, &srp_table_format_txt};
    for (int k = 0; k < 2; ++k) {
        size_t size;
        assert_ok(srp_table_write(got, texts[k], "scratch_reoptic.text", &error), error);
        char *text = read_bytes("scratch_reoptic.text", &size);
        ck_assert_ptr_nonnull(strstr(text, got->info.traced_optics_hash));
        ck_assert_ptr_nonnull(strstr(text, "as traced, not of these optics"));
        if (k == 0) {
            ck_assert_msg(gmat_spo_broken_rule(text) == NULL, "%s", gmat_spo_broken_rule(text));
        }
        free(text);
        remove("scratch_reoptic.text");
    }
    srp_table_destroy(back);
    srp_table_destroy(got);
    srp_table_destroy(table);
    srp_materials_destroy(materials);
    fixture_destroy(fixture);
}
END_TEST

/* With "long" also the largest model, and the errors of sampled sums over more nodes: the figures
 * of docs/theory.md. */
int main(int argc, char **argv) {
    bool is_long = argc > 1 && strcmp(argv[1], "long") == 0;
    int left_out = is_long ? 0 : 1;
    if (is_long) {
        sampled_tables = 6;
        sampled_az_step = 20.0;
        sampled_el_step = 15.0;
    }
    Suite *suite = suite_create("table_reoptic");
    TCase *tcase = tcase_create("reoptic");
    tcase_set_timeout(tcase, 600.0);
    tcase_add_loop_test(tcase, other_optics_equal_a_fresh_table, 0, SHAPE_COUNT - left_out);
    tcase_add_test(tcase, plates_can_be_given_other_optics);
    tcase_add_loop_test(tcase, partials_are_central_differences, 0, SHAPE_COUNT - left_out);
    tcase_add_test(tcase, reflected_light_is_refused_or_kept);
    tcase_add_test(tcase, notes_and_errors_follow_the_optics);
    tcase_add_test(tcase, what_cannot_be_given_other_optics_is_refused);
    tcase_add_test(tcase, a_partial_table_stays_partial);
    tcase_add_test(tcase, files_tell_where_the_numbers_are_from);
    suite_add_tcase(suite, tcase);
    TCase *sampled = tcase_create("sampled");
    tcase_set_timeout(sampled, 600.0);
    tcase_add_loop_test(sampled, errors_of_sampled_sums_stay_honest, 0,
                        4 * (SAMPLED_MODELS - left_out));
    suite_add_tcase(suite, sampled);
    return run_suite(suite);
}
