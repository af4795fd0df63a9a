/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Every constructor, reader and method meets the end of memory at each of its allocations in turn:
 * it must answer SRP_NO_MEMORY, leave its out parameter alone and give back all that it took.
 */
#include "bvh.h"
#include "failing_alloc.h"
#include "shapes.h"
#include "srp_check.h"

#include <srp/cache.h>
#include <srp/demand.h>
#include <srp/interp.h>
#include <srp/method.h>
#include <srp/scene.h>
#include <srp/spad.h>
#include <srp/table.h>

#include <string.h>

/* What there is before memory runs out. */
static srp_mesh *box, *corner;
static srp_materials *materials, *gold_alone;
static srp_scene *scene;
static srp_prepared *prepared; /* raycast on scene */
static srp_table *filled;
static const char NOT_TOUCHED[] = "";

static char obj_text[20000];
static char plates_text[4000];
static const char MTL_TEXT[] = "newmtl gold\nrho_s 0.25\nrho_d 0.5\nnewmtl b\nKd 0.5\n"
                               "newmtl c\nnewmtl d\nnewmtl e\nnewmtl f\nnewmtl g\nnewmtl h\n"
                               "newmtl i\nnewmtl j\n";

static void write_texts(void) {
    /* Enough of everything that each list has to grow. */
    size_t used = 0;
    for (int i = 0; i < 200; ++i) {
        used += (size_t)snprintf(obj_text + used, sizeof obj_text - used,
                                 "mtllib l%d.mtl\nv %d 0 0\nv %d 1 0\nv %d 1.5 1\nv %d 0.25 1\n"
                                 "usemtl m%d\nf -4 -3 -2 -1\n",
                                 i, i, i, i, i, i / 2);
    }
    used = (size_t)snprintf(plates_text, sizeof plates_text, "40\n");
    for (int i = 0; i < 40; ++i) {
        used += (size_t)snprintf(plates_text + used, sizeof plates_text - used,
                                 "1 2 %d 0.5 0.25 0.5\n", i);
    }
}

static srp_method_params small_params(void) {
    srp_method_params params = srp_method_params_default();
    params.threads = 1;
    params.lattice.samples = 32;
    params.diffuse = 2;
    return params;
}

static void set_up_table(void) {
    srp_error error;
    srp_grid grid;
    srp_method_params params = small_params();
    assert_ok(srp_method_prepare(&srp_method_raycast, scene, &params, &prepared, &error), error);
    assert_ok(srp_grid_from_steps(90.0, 90.0, &grid, &error), error);
    assert_ok(srp_table_create(prepared, grid, true, &filled, &error), error);
    assert_ok(
        srp_table_describe(filled, "title", "", srp_table_get_info(filled)->light, 850.0, &error),
        error);
    assert_ok(srp_table_fill(filled, prepared, NULL, &error), error);
}

static void set_up(void) {
    srp_error error;
    const srp_vec3 v[] = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 4}};
    const srp_triangle t[] = {{{0, 1, 2}}, {{0, 3, 1}}};
    write_texts();
    box = shape_box(srp_vec3_make(-1, -1.5, -2), srp_vec3_make(1.25, 1, 3), "gold");
    corner = shape_mesh(v, 4, t, 2, "silver");
    assert_ok(srp_materials_create(&materials, &error), error);
    assert_ok(srp_materials_set(materials, "gold", (srp_optics){0.5, 0.25, false}, false, &error),
              error);
    assert_ok(srp_materials_create(&gold_alone, &error), error);
    assert_ok(srp_materials_set(gold_alone, "gold", (srp_optics){0.1, 0.2, false}, true, &error),
              error);
    srp_mesh *both = shape_box(srp_vec3_make(-1, -1.5, -2), srp_vec3_make(1.25, 1, 3), "gold");
    shape_join(both, shape_box(srp_vec3_make(2, -1.5, -2), srp_vec3_make(2.25, 4, 3), "silver"));
    shape_join(both, shape_mesh(v, 4, t, 2, "cells"));
    scene = shape_scene(both, (srp_optics){0.5, 0.25, false});
    set_up_table();
}

/* ---- What is tried: each creates something, gives it back, and returns the status ---------- */

static srp_status try_mesh_create(srp_error *error) {
    srp_mesh *mesh = (srp_mesh *)NOT_TOUCHED;
    const char *names[] = {"a", "b", "c"};
    const uint32_t material[] = {2, 0};
    srp_status status = srp_mesh_create(srp_mesh_vertices(corner), 4, srp_mesh_triangles(corner), 2,
                                        material, names, 3, &mesh, error);
    if (status == SRP_OK) {
        srp_mesh_destroy(mesh);
    }
    return status == SRP_OK || mesh == (srp_mesh *)NOT_TOUCHED ? status : SRP_MISMATCH;
}

static srp_status try_parse_obj(srp_error *error) {
    srp_mesh *mesh = (srp_mesh *)NOT_TOUCHED;
    srp_status status =
        srp_mesh_parse_obj(obj_text, strlen(obj_text), "f", NULL, NULL, &mesh, error);
    if (status == SRP_OK) {
        srp_mesh_destroy(mesh);
    }
    return status == SRP_OK || mesh == (srp_mesh *)NOT_TOUCHED ? status : SRP_MISMATCH;
}

/* The mesh that is appended to stays as it was. */
static srp_status try_mesh_append(srp_error *error) {
    srp_mesh *mesh = NULL;
    srp_status status =
        srp_mesh_parse_obj(obj_text, strlen(obj_text), "f", NULL, NULL, &mesh, error);
    if (status != SRP_OK) {
        return status;
    }
    size_t triangles = srp_mesh_triangle_count(mesh), names = srp_mesh_material_count(mesh);
    status = srp_mesh_append(mesh, box, error);
    bool same =
        srp_mesh_triangle_count(mesh) == triangles && srp_mesh_material_count(mesh) == names;
    srp_mesh_destroy(mesh);
    return status == SRP_OK || same ? status : SRP_MISMATCH;
}

static srp_status try_material_areas(srp_error *error) {
    double area[1]; /* the box has one material */
    return srp_mesh_material_areas(box, area, error);
}

static srp_status try_mesh_inspect(srp_error *error) {
    srp_mesh_report report;
    return srp_mesh_inspect(box, &report, error);
}

static srp_status try_materials(srp_error *error) {
    srp_materials *list = NULL;
    srp_status status = srp_materials_create(&list, error);
    for (int i = 0; status == SRP_OK && i < 20; ++i) {
        char name[8];
        snprintf(name, sizeof name, "m%d", i);
        status = srp_materials_set(list, name, (srp_optics){0.5, 0.25, false}, false, error);
        if (status == SRP_OK && srp_materials_count(list) != (size_t)i + 1) {
            status = SRP_MISMATCH;
        }
    }
    srp_materials_destroy(list);
    return status;
}

static srp_status try_parse_mtl(srp_error *error) {
    srp_materials *list = NULL;
    srp_status status = srp_materials_create(&list, error);
    if (status == SRP_OK) {
        status = srp_materials_set(list, "gold", (srp_optics){0.75, 0.25, false}, false, error);
    }
    if (status == SRP_OK) {
        status = srp_materials_parse_mtl(list, MTL_TEXT, strlen(MTL_TEXT), "f", NULL, error);
        srp_optics gold = {0};
        bool found = srp_materials_find(list, "gold", &gold);
        bool same = found && gold.rho_s == 0.75 && srp_materials_count(list) == 1;
        status = status == SRP_OK || same ? status : SRP_MISMATCH;
    }
    srp_materials_destroy(list);
    return status;
}

static srp_status try_parse_plates(srp_error *error) {
    srp_plate *plates = (srp_plate *)NOT_TOUCHED;
    size_t count = 77;
    srp_status status =
        srp_plates_parse(plates_text, strlen(plates_text), "f", &plates, &count, error);
    if (status == SRP_OK) {
        srp_plates_free(plates);
    }
    return status == SRP_OK || count == 77 ? status : SRP_MISMATCH;
}

static srp_status scene_done(srp_status status, srp_scene *made) {
    if (status == SRP_OK) {
        srp_scene_destroy(made);
    }
    return status == SRP_OK || made == (srp_scene *)NOT_TOUCHED ? status : SRP_MISMATCH;
}

static srp_status try_scene_from_mesh(srp_error *error) {
    srp_scene *made = (srp_scene *)NOT_TOUCHED;
    srp_status status = srp_scene_from_mesh(box, materials, &made, error);
    return scene_done(status, made);
}

static srp_status try_scene_from_plates(srp_error *error) {
    srp_scene *made = (srp_scene *)NOT_TOUCHED;
    const srp_plate plates[] = {{{1, 0, 0}, 2.5, {0.5, 0.25, false}},
                                {{0, 1, 0}, 1.5, {0.25, 0.25, false}}};
    srp_status status = srp_scene_from_plates(plates, 2, &made, error);
    return scene_done(status, made);
}

static srp_status try_scene_from_sphere(srp_error *error) {
    srp_scene *made = (srp_scene *)NOT_TOUCHED;
    srp_status status = srp_scene_from_sphere(1.5, 20.0, &made, error);
    return scene_done(status, made);
}

static srp_status try_scene_read_obj(srp_error *error) {
    srp_scene *made = (srp_scene *)NOT_TOUCHED;
    const char *paths[] = {SRP_MODELS_DIR "/cube.obj", SRP_MODELS_DIR "/l-corner.obj"};
    srp_status status = srp_scene_read_obj(paths, 2, NULL, materials, NULL, &made, error);
    return scene_done(status, made);
}

static srp_status try_read_plates(srp_error *error) {
    srp_plate *plates = NULL;
    size_t count;
    srp_status status = srp_plates_read(SRP_MODELS_DIR "/cube.plates", &plates, &count, error);
    if (status == SRP_OK) {
        srp_plates_free(plates);
    }
    return status;
}

/* Prepares a method and asks it twice: the second time its scratch memory is warm. */
static srp_status try_method(const srp_method *method, const srp_scene *on, srp_error *error) {
    srp_prepared *made = (srp_prepared *)NOT_TOUCHED;
    srp_method_params params = small_params();
    srp_status status = srp_method_prepare(method, on, &params, &made, error);
    if (status != SRP_OK) {
        return made == (srp_prepared *)NOT_TOUCHED ? status : SRP_MISMATCH;
    }
    const srp_vec3 s[] = {{0.6, 0.0, 0.8}, {0.0, -0.6, 0.8}, {0.48, 0.6, 0.64}};
    srp_response responses[3];
    srp_basis sums[12];
    for (int pass = 0; status == SRP_OK && pass < 2; ++pass) {
        status = srp_prepared_respond(made, 3, s, responses, sums, error);
    }
    srp_prepared_release(made);
    return status;
}

#define TRY_METHOD(name)                                                                           \
    static srp_status try_##name(srp_error *error) {                                               \
        return try_method(&srp_method_##name, scene, error);                                       \
    }
TRY_METHOD(exact)
TRY_METHOD(raycast)
TRY_METHOD(raytrace)

static srp_status try_nplate(srp_error *error) {
    srp_scene *made = NULL;
    const srp_plate plates[] = {{{1, 0, 0}, 2.5, {0.5, 0.25, false}}};
    srp_status status = srp_scene_from_plates(plates, 1, &made, error);
    if (status == SRP_OK) {
        status = try_method(&srp_method_nplate, made, error);
        srp_scene_destroy(made);
    }
    return status;
}

/* ---- Tables ------------------------------------------------------------------------------- */

static srp_status try_table_fill(srp_error *error) {
    srp_table *table = (srp_table *)NOT_TOUCHED;
    srp_sunlight light = srp_table_get_info(filled)->light;
    srp_status status = srp_table_create(prepared, srp_table_grid(filled), true, &table, error);
    if (status != SRP_OK) {
        return table == (srp_table *)NOT_TOUCHED ? status : SRP_MISMATCH;
    }
    status = srp_table_describe(table, "title", "srp table", light, 850.0, error);
    if (status == SRP_OK) {
        status = srp_table_fill(table, prepared, NULL, error);
    }
    srp_table_destroy(table);
    return status;
}

static srp_status try_table_reoptic(srp_error *error) {
    srp_table *table = (srp_table *)NOT_TOUCHED, *again = (srp_table *)NOT_TOUCHED;
    srp_status status = srp_table_reoptic(filled, gold_alone, false, &table, error);
    if (status != SRP_OK) {
        return table == (srp_table *)NOT_TOUCHED ? status : SRP_MISMATCH;
    }
    status = srp_table_reoptic(table, gold_alone, false, &again, error);
    if (status == SRP_OK) {
        srp_table_destroy(again);
    }
    srp_table_destroy(table);
    return status == SRP_OK || again == (srp_table *)NOT_TOUCHED ? status : SRP_MISMATCH;
}

/* There and back through a file. */
static srp_status try_format(const srp_table_format *format, srp_error *error) {
    char path[64];
    snprintf(path, sizeof path, "test_alloc_failure%s", format->ending);
    srp_table *table = (srp_table *)NOT_TOUCHED;
    srp_status status = srp_table_write(filled, format, path, error);
    if (status == SRP_OK) {
        status = srp_table_read(format, path, &table, error);
    }
    if (status == SRP_OK) {
        srp_table_destroy(table);
    }
    return status == SRP_OK || table == (srp_table *)NOT_TOUCHED ? status : SRP_MISMATCH;
}

#define TRY_FORMAT(name)                                                                           \
    static srp_status try_##name(srp_error *error) {                                               \
        return try_format(&srp_table_format_##name, error);                                        \
    }
TRY_FORMAT(netcdf)
TRY_FORMAT(spo)
TRY_FORMAT(txt)

static srp_status try_interp(srp_error *error) {
    srp_interp *interp = (srp_interp *)NOT_TOUCHED;
    srp_status status = srp_interp_create(&srp_interp_spline, filled, &interp, error);
    if (status == SRP_OK) {
        srp_interp_destroy(interp);
    }
    return status == SRP_OK || interp == (srp_interp *)NOT_TOUCHED ? status : SRP_MISMATCH;
}

/* Made, asked in two cells, the second one twice. */
static srp_status ask_on_demand(const srp_prepared *fresh, srp_error *error) {
    srp_demand *demand = (srp_demand *)NOT_TOUCHED;
    srp_interp *interp = (srp_interp *)NOT_TOUCHED;
    const srp_grid grid = {9, 5};
    const srp_vec3 s[] = {{0.6, 0.0, 0.8}, {0.0, -0.6, 0.8}, {0.0, -0.6, 0.8}};
    srp_status status = srp_demand_create(fresh, grid, NULL, &demand, error);
    if (status != SRP_OK) {
        return demand == (srp_demand *)NOT_TOUCHED ? status : SRP_MISMATCH;
    }
    status = srp_interp_create_on_demand(&srp_interp_bicubic, demand, &interp, error);
    if (status != SRP_OK) {
        status = interp == (srp_interp *)NOT_TOUCHED ? status : SRP_MISMATCH;
        srp_demand_destroy(demand);
        return status;
    }
    for (int k = 0; status == SRP_OK && k < 3; ++k) {
        srp_vec3 f;
        status = srp_interp_eval(interp, s[k], &f, NULL, NULL, error);
    }
    srp_interp_destroy(interp);
    srp_demand_destroy(demand);
    return status;
}

/* With a method of its own, which keeps scratch memory. */
static srp_status try_demand(srp_error *error) {
    srp_prepared *fresh = NULL;
    srp_method_params params = small_params();
    srp_status status = srp_method_prepare(&srp_method_raycast, scene, &params, &fresh, error);
    if (status == SRP_OK) {
        status = ask_on_demand(fresh, error);
        srp_prepared_release(fresh);
    }
    return status;
}

static srp_status try_cache(srp_error *error) {
    srp_cache *cache = (srp_cache *)NOT_TOUCHED;
    srp_cache_params params = srp_cache_params_default();
    srp_cache_entry *entries = (srp_cache_entry *)NOT_TOUCHED;
    size_t count = 77;
    params.directory = "test_alloc_failure.cache";
    srp_status status = srp_cache_open(&params, NULL, &cache, error);
    if (status != SRP_OK) {
        return cache == (srp_cache *)NOT_TOUCHED ? status : SRP_MISMATCH;
    }
    status = srp_cache_exchange(cache, prepared, filled, NULL, error);
    if (status == SRP_OK) {
        status = srp_cache_list(cache, &entries, &count, error);
    }
    if (status == SRP_OK) {
        srp_cache_entries_free(entries);
    } else if (entries != (srp_cache_entry *)NOT_TOUCHED || count != 77) {
        status = SRP_MISMATCH;
    }
    srp_cache_close(cache);
    return status;
}

static srp_status try_spad(srp_error *error) {
    srp_spad *spad = (srp_spad *)NOT_TOUCHED;
    srp_status status = srp_spad_create(filled, false, &spad, error);
    if (status == SRP_OK) {
        srp_spad_destroy(spad);
    }
    return status == SRP_OK || spad == (srp_spad *)NOT_TOUCHED ? status : SRP_MISMATCH;
}

static srp_status try_bvh(srp_error *error) {
    srp_bvh *bvh = (srp_bvh *)NOT_TOUCHED;
    srp_status status = srp_bvh_create(scene, 2, &bvh, error);
    if (status == SRP_OK) {
        srp_bvh_destroy(bvh);
    }
    return status == SRP_OK || bvh == (srp_bvh *)NOT_TOUCHED ? status : SRP_MISMATCH;
}

/* ---- The loop ------------------------------------------------------------------------------ */

static const struct {
    const char *name;
    srp_status (*run)(srp_error *error);
} TRIES[] = {
    {"mesh_create", try_mesh_create},
    {"parse_obj", try_parse_obj},
    {"mesh_append", try_mesh_append},
    {"mesh_inspect", try_mesh_inspect},
    {"mesh_material_areas", try_material_areas},
    {"materials", try_materials},
    {"parse_mtl", try_parse_mtl},
    {"parse_plates", try_parse_plates},
    {"read_plates", try_read_plates},
    {"scene_from_mesh", try_scene_from_mesh},
    {"scene_from_plates", try_scene_from_plates},
    {"scene_from_sphere", try_scene_from_sphere},
    {"scene_read_obj", try_scene_read_obj},
    {"nplate", try_nplate},
    {"exact", try_exact},
    {"raycast", try_raycast},
    {"bvh", try_bvh},
    {"raytrace", try_raytrace},
    {"table_fill", try_table_fill},
    {"table_reoptic", try_table_reoptic},
    {"interp", try_interp},
    {"spad", try_spad},
    {"demand", try_demand},
    {"cache", try_cache},
    {"netcdf", try_netcdf},
    {"spo", try_spo},
    {"txt", try_txt},
};

static srp_status run_try(void *user, srp_error *error) {
    const int *which = user;
    return TRIES[*which].run(error);
}

START_TEST(every_allocation_may_fail) {
    failing_alloc_exhaust(TRIES[_i].name, run_try, &_i);
}
END_TEST

/* What is ready needs no memory. */
START_TEST(lookups_in_cells_that_are_ready_allocate_nothing) {
    srp_demand *demand = NULL;
    srp_interp *interp = NULL;
    srp_interp_jacobian slopes;
    srp_vec3 s = {0.0, -0.6, 0.8}, f, t;
    srp_error error;
    assert_ok(srp_demand_create(prepared, (srp_grid){9, 5}, NULL, &demand, &error), error);
    assert_ok(srp_interp_create_on_demand(&srp_interp_bicubic, demand, &interp, &error), error);
    assert_ok(srp_interp_eval(interp, s, &f, &t, &slopes, &error), error);
    failing_alloc_arm(0);
    srp_status status = srp_interp_eval(interp, s, &f, &t, &slopes, &error);
    const srp_demand_node node = {0, 0};
    srp_status again = srp_demand_need(demand, 1, &node, &error);
    ck_assert(!failing_alloc_disarm());
    ck_assert_int_eq(status, SRP_OK);
    ck_assert_int_eq(again, SRP_OK);
    srp_interp_destroy(interp);
    srp_demand_destroy(demand);
}
END_TEST

static int warnings;

static void count_warning(void *user, const srp_error *what) {
    (void)user;
    (void)what;
    ++warnings;
}

/* Without memory for the cache a table on demand goes on without it, and says so once. */
START_TEST(a_cache_without_memory_stops_nobody) {
    const srp_log log = {count_warning, NULL};
    srp_cache_params params = srp_cache_params_default();
    srp_cache *cache = NULL;
    srp_error error;
    long n = 0;
    params.directory = "test_alloc_failure.cache";
    params.flush_nodes = 1;
    params.flush_share = INFINITY;
    assert_ok(srp_cache_open(&params, &log, &cache, &error), error);
    for (bool failed = true; failed; ++n) {
        srp_demand *demand = NULL;
        const srp_demand_node node = {(uint32_t)(n % 8), 2};
        long before = failing_alloc_held();
        warnings = 0;
        failing_alloc_arm(n);
        srp_status made = srp_demand_create(prepared, (srp_grid){9, 5}, cache, &demand, &error);
        srp_status status = made == SRP_OK ? srp_demand_need(demand, 1, &node, &error) : made;
        if (made == SRP_OK) {
            srp_demand_destroy(demand);
        }
        failed = failing_alloc_disarm();
        long leaked = failing_alloc_held() - before;
        ck_assert_msg(leaked == 0, "allocation %ld fails, %ld blocks leak", n, leaked);
        ck_assert_msg(status == SRP_OK || (failed && status == SRP_NO_MEMORY), "%ld: %s", n,
                      error.message);
        ck_assert_int_eq(warnings, failed && status == SRP_OK);
        ck_assert_int_lt(n, 10000);
    }
    printf("cache behind a table on demand: %ld allocations\n", n - 1);
    ck_assert_int_gt(n, 10);
    srp_cache_close(cache);
}
END_TEST

int main(void) {
    Suite *suite = suite_create("alloc_failure");
    TCase *tcase = tcase_create("alloc_failure");
    tcase_add_unchecked_fixture(tcase, set_up, NULL);
    tcase_add_loop_test(tcase, every_allocation_may_fail, 0, sizeof TRIES / sizeof *TRIES);
    tcase_add_test(tcase, lookups_in_cells_that_are_ready_allocate_nothing);
    tcase_add_test(tcase, a_cache_without_memory_stops_nobody);
    suite_add_tcase(suite, tcase);
    return run_suite(suite);
}
